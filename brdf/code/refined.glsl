// f_r of an isotropic surface: a sum of components, each the product of a density of two warped half/difference
// angles, of one of the azimuth and, where the model has it, of a copula, with colours of its own. Reads its numbers
// through float sklar_value(int i) only.

// Where a pair of directions stands: among the coefficients of the densities, among the nodes of the lattice, and at
// the two nodes of the half angle among the coefficients of the colours.
struct sklar_Place {
  sklar_Spline shape_half;
  sklar_Spline shape_difference;
  sklar_Spline colour_low;
  sklar_Spline colour_high;
  sklar_Between half_node;
  sklar_Between difference_node;
  sklar_Between azimuth_node;
  float azimuth;
};

// The half angle, the difference angle and the azimuth, each as a number in [0,1], algebraic in the components. With
// h the half vector, v = 1 - cos(theta_h), w the width: (v (1 + w) / (v + w))^(1/4), 1 - sqrt(1 - sin(theta_d)),
// cos(phi_d)^2.
vec3 sklar_coordinates(vec3 wo, vec3 wi) {
  vec3 sum = wi + wo, gap = wi - wo;
  float level2 = sum.x * sum.x + sum.y * sum.y, length2 = level2 + sum.z * sum.z;
  float sin2_d = 0.25 * dot(gap, gap);
  float versed = level2 * (1.0 + sklar_width) / (level2 + sklar_width * (length2 + sqrt(length2) * sum.z));
  float at_half = sqrt(sqrt(versed));
  float at_difference = 1.0 - sqrt(0.25 * length2 / (1.0 + sqrt(sin2_d)));
  float at_azimuth = 0.25 * gap.z * gap.z * length2 / (level2 * sin2_d + sklar_pole * length2);
  return vec3(clamp((at_half - sklar_half_low) / (sklar_half_high - sklar_half_low), 0.0, 1.0),
              clamp((at_difference - sklar_difference_low) / (sklar_difference_high - sklar_difference_low), 0.0, 1.0),
              at_azimuth);
}

sklar_Place sklar_place(vec3 at) {
  sklar_Place place;
  place.shape_half = sklar_spline(at.x, sklar_half);
  place.shape_difference = sklar_spline(at.y, sklar_difference);
  place.half_node = sklar_between(at.x * float(sklar_half_nodes - 1), sklar_half_nodes - 1);
  place.difference_node = sklar_between(at.y * float(sklar_difference_nodes - 1), sklar_difference_nodes - 1);
  place.azimuth_node = sklar_between(at.z * float(sklar_azimuth_nodes - 1), sklar_azimuth_nodes - 1);
  float node = float(place.half_node.low);
  place.colour_low = sklar_spline(node / float(sklar_half_nodes - 1), sklar_colour_half);
  place.colour_high = sklar_spline((node + 1.0) / float(sklar_half_nodes - 1), sklar_colour_half);
  place.azimuth = at.z;
  return place;
}

float sklar_log_shape(int k, sklar_Place at) {
  int table = sklar_shape + k * sklar_difference * sklar_half;
  return sklar_tensor(table, sklar_half, at.shape_half, at.shape_difference);
}

// A polynomial without constant term.
float sklar_log_azimuth(int k, sklar_Place at) {
  int row = sklar_powers + (k * sklar_difference_nodes + at.difference_node.low) * sklar_degree;
  float sum = 0.0;
  for (int m = sklar_degree - 1; m >= 0; --m) {
    float power = mix(sklar_value(row + m), sklar_value(row + sklar_degree + m), at.difference_node.share);
    sum = sum * (at.azimuth - 0.5) + power;
  }
  return sum * at.azimuth;
}

// Red (channel 0) or blue (channel 1) over green.
float sklar_colour(int k, int channel, sklar_Place at) {
  int row = sklar_colours +
            ((k * sklar_difference_nodes + at.difference_node.low) * 2 + channel) * sklar_colour_half;
  int next = row + 2 * sklar_colour_half;
  float here = mix(exp(sklar_sum(at.colour_low, row)), exp(sklar_sum(at.colour_high, row)), at.half_node.share);
  float there = mix(exp(sklar_sum(at.colour_low, next)), exp(sklar_sum(at.colour_high, next)), at.half_node.share);
  return mix(here, there, at.difference_node.share);
}

float sklar_along_azimuth(int row, sklar_Place at) {
  int i = row + at.azimuth_node.low;
  return mix(sklar_value(i), sklar_value(i + 1), at.azimuth_node.share);
}

// Those with a copula come first.
float sklar_log_copula(int k, sklar_Place at) {
  if (k >= sklar_coupled) return 0.0;
  int plane = k * sklar_difference_nodes + at.difference_node.low;
  int row = sklar_copulas + (plane * sklar_half_nodes + at.half_node.low) * sklar_azimuth_nodes;
  int next = row + sklar_half_nodes * sklar_azimuth_nodes;
  float here = mix(sklar_along_azimuth(row, at), sklar_along_azimuth(row + sklar_azimuth_nodes, at),
                   at.half_node.share);
  float there = mix(sklar_along_azimuth(next, at), sklar_along_azimuth(next + sklar_azimuth_nodes, at),
                    at.half_node.share);
  return mix(here, there, at.difference_node.share);
}

// f_r in 1/sr, red green blue. wo, wi: unit, in the frame of the surface (z = normal), both pointing away from it; 0
// where either is not above the horizon.
vec3 sklar_eval(vec3 wo, vec3 wi) {
  vec3 sum = vec3(0.0, 0.0, 0.0);
  if (!(wo.z > 0.0 && wi.z > 0.0)) return sum;
  sklar_Place at = sklar_place(sklar_coordinates(wo, wi));
  for (int k = 0; k < sklar_components; ++k) {
    float green = exp(sklar_log_shape(k, at) + sklar_log_azimuth(k, at) + sklar_log_copula(k, at));
    sum += green * vec3(sklar_colour(k, 0, at), 1.0, sklar_colour(k, 1, at));
  }
  return sum;
}
