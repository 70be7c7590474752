#pragma once
/// Reflectance of a smooth dielectric for unpolarised light, after Cook and Torrance 1982, "A Reflectance Model for
/// Computer Graphics", section on the spectral composition of the reflected light:
///
///     F = 1/2 ((g - c) / (g + c))^2 (1 + ((c (g + c) - 1) / (c (g - c) + 1))^2),
///     c = cos(theta_d), g^2 = n^2 + c^2 - 1, n = (1 + r) / (1 - r), r = sqrt(F at normal incidence)
///
/// With both c and g times 1 - r nothing is infinite at r = 1, and G - C = 4 r / (G + C) does not cancel at r = 0:
///     C = (1 - r) c,    G = sqrt(4 r + C^2)

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// @param root_f0 r, each channel in [0,1]. @param cosine of theta_d, in (0,1] to rounding. @return each channel in
/// [0,1] to rounding; 0 for r = 0, 1 for r = 1, r^2 for cosine = 1.
[[nodiscard]] inline Rgb dielectric_fresnel(const Rgb& root_f0, double cosine) {
  const Rgb rest = 1 - root_f0;
  const Rgb c = rest * cosine;
  const Rgb sum = (4 * root_f0 + c.square()).sqrt() + c;
  const Rgb difference = 4 * root_f0 / sum;
  const Rgb parallel = (cosine * sum - rest) / (cosine * difference + rest);
  return 0.5 * (difference / sum).square() * (1 + parallel.square());
}

}  // namespace sklar::brdf
