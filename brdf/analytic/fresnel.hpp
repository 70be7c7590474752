#pragma once
/// Fresnel reflectance: of a smooth dielectric for unpolarised light, and Schlick's approximation of any.
///
/// The dielectric, after Cook and Torrance 1982, "A Reflectance Model for
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

/// F = f0 + (1 - f0) (1 - cos(theta_d))^5, Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering";
/// the same to the last bit when wi and wo change places. @param f0 reflectance at normal incidence, each channel in
/// [0,1].
/// @param wo, wi unit. @param length |wi + wo|, from which 1 - cos(theta_d) = |wi - wo|^2 / 4 / (1 + length / 2) does
/// not cancel.
[[nodiscard]] inline Rgb schlick_fresnel(const Rgb& f0, const Vec3& wo, const Vec3& wi, double length) {
  const double versine = 0.25 * (wi - wo).squaredNorm() / (1 + 0.5 * length);
  const double square = versine * versine;
  return f0 + (1 - f0) * (square * square * versine);
}

/// The mean of schlick_fresnel over the cosine hemisphere of theta_d.
[[nodiscard]] inline Rgb mean_schlick_fresnel(const Rgb& f0) {
  return f0 + (1 - f0) / 21;
}

}  // namespace sklar::brdf
