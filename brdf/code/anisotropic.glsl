// f_r of an anisotropic surface: a sum of components, the log of each a tensor spline in the distance of the half vector
// from an axis, in a metric of its own, and in the difference angle, plus terms that are linear in their coefficients.

// Bernstein polynomials, 0 to the degree asked for.
struct sklar_Polynomials {
  float at[7];
};

// 1, r cos 2 phi, r sin 2 phi, r^2 cos 4 phi, r^2 sin 4 phi.
struct sklar_Harmonics {
  float at[5];
};

struct sklar_Terms {
  float density[sklar_shared_room];
  float colours[sklar_colour_count];
};

sklar_Polynomials sklar_bernstein(float x, int degree) {
  float y = 1.0 - x;
  sklar_Polynomials p;
  p.at[0] = 1.0;
  for (int n = 1; n <= degree; ++n) {
    p.at[n] = x * p.at[n - 1];
    for (int i = n - 1; i >= 1; --i) p.at[i] = x * p.at[i - 1] + y * p.at[i];
    p.at[0] = y * p.at[0];
  }
  return p;
}

// phi is the azimuth of w, r the square of the length of its projection over `divisor`.
sklar_Harmonics sklar_harmonics(vec3 w, float divisor) {
  float cosine = (w.x * w.x - w.y * w.y) / divisor, sine = 2.0 * w.x * w.y / divisor;
  sklar_Harmonics harmonics;
  harmonics.at[0] = 1.0;
  harmonics.at[1] = cosine;
  harmonics.at[2] = sine;
  harmonics.at[3] = cosine * cosine - sine * sine;
  harmonics.at[4] = 2.0 * cosine * sine;
  return harmonics;
}

// s / (1 + s), s^4 = q / h_z^2, of a squared distance q from an axis.
float sklar_half_coordinate(float q, float h_z) {
  float s = sqrt(sqrt(q));
  return s / (s + sqrt(h_z));
}

float sklar_difference_coordinate(vec3 wo, vec3 wi) {
  vec3 sum = wi + wo, gap = wi - wo;
  return max(0.0, 1.0 - sqrt(0.25 * dot(sum, sum) / (1.0 + 0.5 * sqrt(dot(gap, gap)))));
}

sklar_Polynomials sklar_masking_polynomials(vec3 w) {
  return sklar_bernstein(1.2 * w.z / (w.z + 0.2), sklar_masking);
}

// h: the half vector; difference: sklar_difference_coordinate.
sklar_Terms sklar_terms(vec3 wo, vec3 wi, vec3 h, float difference) {
  sklar_Terms terms;
  vec3 gap = wi - wo;
  float sin2_h = h.x * h.x + h.y * h.y, sin2_d = 0.25 * dot(gap, gap);
  float at_half = sklar_half_coordinate(30.0 * sin2_h, h.z);
  int n = 0;

  sklar_Polynomials across = sklar_bernstein(0.25 * gap.z * gap.z / (sin2_h * sin2_d + sklar_pole), sklar_azimuth);
  sklar_Polynomials along = sklar_bernstein(difference, sklar_azimuth_difference);
  for (int i = 1; i <= sklar_azimuth; ++i) {
    for (int j = 0; j <= sklar_azimuth_difference; ++j) {
      terms.density[n] = across.at[i] * along.at[j];
      ++n;
    }
  }

  sklar_Polynomials of_wi = sklar_masking_polynomials(wi), of_wo = sklar_masking_polynomials(wo);
  sklar_Harmonics at_wi = sklar_harmonics(wi, 1.0), at_wo = sklar_harmonics(wo, 1.0);
  for (int m = 0; m <= 2 * sklar_masking_harmonics; ++m) {
    int last = m > 0 ? sklar_masking : sklar_masking - 1;
    for (int i = 0; i <= last; ++i) {
      terms.density[n] = 0.5 * (at_wi.at[m] * of_wi.at[i] + at_wo.at[m] * of_wo.at[i]);
      ++n;
    }
  }

  sklar_Harmonics at_h = sklar_harmonics(h, sin2_h + 1e-3);
  across = sklar_bernstein(at_half, sklar_half_harmonics_degree);
  for (int m = 1; m <= 2 * sklar_half_harmonics; ++m) {
    for (int j = 0; j <= sklar_half_harmonics_degree; ++j) {
      terms.density[n] = at_h.at[m] * across.at[j];
      ++n;
    }
  }

  across = sklar_bernstein(at_half, sklar_colour_half);
  along = sklar_bernstein(difference, sklar_colour_difference);
  for (int i = 0; i <= sklar_colour_half; ++i) {
    for (int j = 0; j <= sklar_colour_difference; ++j) {
      terms.colours[i * (sklar_colour_difference + 1) + j] = across.at[i] * along.at[j];
    }
  }
  return terms;
}

// The squared distance of a half vector from the axis of a component.
float sklar_distance(int k, vec3 h) {
  int metric = sklar_metric + 5 * k;
  float x = h.x - sklar_value(metric + 3) * h.z, y = h.y - sklar_value(metric + 4) * h.z;
  return sklar_value(metric) * x * x + 2.0 * sklar_value(metric + 1) * x * y + sklar_value(metric + 2) * y * y +
         1e-6 * h.z * h.z;
}

// The sum of the terms of a colour times their coefficients, which begin at `row`.
float sklar_colour(sklar_Terms terms, int row) {
  float sum = 0.0;
  for (int n = 0; n < sklar_colour_count; ++n) sum += sklar_value(row + n) * terms.colours[n];
  return sum;
}

// f_r in 1/sr, red green blue. wo, wi: unit, in the frame of the surface (z = normal), both pointing away from it; 0
// where either is not above the horizon.
vec3 sklar_eval(vec3 wo, vec3 wi) {
  vec3 sum = vec3(0.0, 0.0, 0.0);
  if (!(wo.z > 0.0 && wi.z > 0.0)) return sum;
  vec3 h = wi + wo;
  h = (1.0 / sqrt(dot(h, h))) * h;
  float difference = sklar_difference_coordinate(wo, wi);
  sklar_Terms terms = sklar_terms(wo, wi, h, difference);
  sklar_Spline along = sklar_spline(difference, sklar_difference);
  for (int k = 0; k < sklar_components; ++k) {
    sklar_Spline across = sklar_spline(sklar_half_coordinate(sklar_distance(k, h), h.z), sklar_half);
    float green = sklar_tensor(sklar_shape + k * sklar_half * sklar_difference, sklar_half, across, along);
    int row = sklar_shared + k * sklar_shared_count;
    for (int n = 0; n < sklar_shared_count; ++n) green += sklar_value(row + n) * terms.density[n];
    float red = green + sklar_colour(terms, sklar_red + k * sklar_colour_count);
    float blue = green + sklar_colour(terms, sklar_blue + k * sklar_colour_count);
    sum += vec3(exp(red), exp(green), exp(blue));
  }
  return sum;
}
