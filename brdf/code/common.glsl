// What the models have in common. Numbers are read through float sklar_value(int i) only.

// An interval of an axis, and the place in it.
struct sklar_Between {
  int low;
  float share;
};

// The four coefficients of a cubic spline that act at a place: the first of them and their weights.
struct sklar_Spline {
  int first;
  vec4 weights;
};

sklar_Between sklar_between(float position, int intervals) {
  sklar_Between at;
  at.low = int(clamp(position, 0.0, float(intervals - 1)));
  at.share = position - float(at.low);
  return at;
}

sklar_Spline sklar_spline(float x, int count) {
  sklar_Between at = sklar_between(x * float(count - 3), count - 3);
  float t = at.share, s = 1.0 - t;
  sklar_Spline spline;
  spline.first = at.low;
  spline.weights = vec4(s * s * s, t * t * (3.0 * t - 6.0) + 4.0, s * s * (3.0 * s - 6.0) + 4.0, t * t * t) / 6.0;
  return spline;
}

// The sum over the coefficients of a row that begins at `row`.
float sklar_sum(sklar_Spline at, int row) {
  int i = row + at.first;
  return dot(at.weights, vec4(sklar_value(i), sklar_value(i + 1), sklar_value(i + 2), sklar_value(i + 3)));
}

// The sum over the coefficients of a table whose rows have `columns` coefficients.
float sklar_tensor(int table, int columns, sklar_Spline across, sklar_Spline along) {
  int row = table + along.first * columns;
  return dot(along.weights, vec4(sklar_sum(across, row), sklar_sum(across, row + columns),
                                 sklar_sum(across, row + 2 * columns), sklar_sum(across, row + 3 * columns)));
}
