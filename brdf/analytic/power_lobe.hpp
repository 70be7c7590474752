#pragma once
/// The lobe cos^n(alpha) about an axis: its powers, density and draws, shared by the models of Phong's kind.
///
///     p(w) = (n + 1) / (2 pi) cos^n(alpha) per solid angle, alpha < 90 degrees from the axis, integrates to 1
///     w:  cos(alpha) = u^(1 / (n + 1)), azimuth 2 pi v      Lafortune and Willems 1994, "Using the modified Phong
///                                                           reflectance model for physically based rendering"
///
/// cos^n with a large n needs cos to more digits than 1 - 1e-16 has: it is taken from 1 - cos(alpha), the half squared
/// length of the difference of unit vectors, where that is the smaller of both. sin^2(alpha) of a draw is
/// -expm1(2 log(u) / (n + 1)).

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/brdf.hpp"
#include "brdf/geometry/frame.hpp"

namespace sklar::brdf::power_lobe {

/// Ends values and densities that have none where both directions graze.
inline constexpr double kLargest = 1e200;

/// cosine^exponent; 0 below 0. @param versine 1 - cosine, to its own digits. @param exponent at least 0.
[[nodiscard]] inline double power(double cosine, double versine, double exponent) {
  if (!(cosine > 0)) return 0;
  return versine < 0.5 ? std::exp(exponent * std::log1p(-versine)) : std::pow(cosine, exponent);
}

/// cos^exponent of the angle between unit vectors. The same to the last bit when they change places.
[[nodiscard]] inline double power(const Vec3& axis, const Vec3& w, double exponent) {
  return power(axis.dot(w), 0.5 * (axis - w).squaredNorm(), exponent);
}

/// cos^exponent of the angle between wi and wo turned by half a turn about z. The same when they change places.
[[nodiscard]] inline double mirrored_power(const Vec3& wo, const Vec3& wi, double exponent) {
  return power(Vec3(-wo.x(), -wo.y(), wo.z()), wi, exponent);
}

/// cos^exponent(theta_h) of the half vector along sum = wi + wo. @param length |sum|.
[[nodiscard]] inline double half_power(const Vec3& sum, double length, double exponent) {
  const double across = sum.x() * sum.x() + sum.y() * sum.y();
  return power(sum.z() / length, across / length / (length + sum.z()), exponent);
}

/// p of a direction whose cos^exponent is `value`.
[[nodiscard]] inline double density(double value, double exponent) {
  return 0.5 * std::numbers::inv_pi * (exponent + 1) * value;
}

/// A draw from p. @param axis unit. @param uniforms in (0,1].
[[nodiscard]] inline Vec3 direction(const Vec3& axis, double exponent, const Vec2& uniforms) {
  const double log_cosine = std::log(uniforms.x()) / (exponent + 1);
  const double sine = std::sqrt(-std::expm1(2 * log_cosine));
  const double phi = 2 * std::numbers::pi * uniforms.y();
  return Frame(axis).to_world({sine * std::cos(phi), sine * std::sin(phi), std::exp(log_cosine)});
}

}  // namespace sklar::brdf::power_lobe
