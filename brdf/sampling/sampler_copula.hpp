#pragma once
/// The Ali-Mikhail-Haq copula as samplers take it: its density, conditional distribution and the inverse of that are
/// algebraic, so that a draw costs a square root. C(u, v) = u v / (1 - theta (1 - u) (1 - v)); Nelsen 2006, eq. 4.2.3.
///
/// Written in 1 - u, of the polar margin, and a z that is 1 - v where dependence is positive, v where it is reflected:
/// Kendall's tau is in [-0.18, 1/3], reflected in [-1/3, 0.18]. theta is kept to kDependenceRange, within which the
/// density is at least 0.05.

#include <cmath>

namespace sklar::brdf::sampler_copula {

inline constexpr double kLowestDependence = -0.9;
inline constexpr double kHighestDependence = 0.95;

/// P(U <= u | V = v). @param rest 1 - u; both are given, so that a small u keeps its digits.
template <class Real>
[[nodiscard]] Real conditional(Real theta, Real u, Real rest, Real z) {
  const Real d = 1 - theta * rest * z;
  return u * (1 - theta * rest) / (d * d);
}

/// Density at (u, v) given U <= top: density / conditional at top, in one division. @param rest_top 1 - top.
template <class Real>
[[nodiscard]] Real truncated_density(Real theta, Real rest, Real top, Real rest_top, Real z) {
  const Real product = rest * z;
  const Real d = 1 - theta * product, d_top = 1 - theta * rest_top * z;
  const Real height = 1 + theta * (1 - 2 * rest - 2 * z + product) + theta * theta * product;
  return height * (d_top * d_top) / (d * d * d * top * (1 - theta * rest_top));
}

/// The u at which conditional is p: (theta - p b^2) w^2 - (1 + theta - 2 p b) w + 1 - p = 0 for w = 1 - u, b = theta z.
[[nodiscard]] inline double conditional_inverse(double theta, double z, double p) {
  const double b = theta * z, a = theta - p * b * b, half = (1 + theta - 2 * p * b) / 2;
  return 1 - (1 - p) / (half + std::sqrt(std::max(half * half - a * (1 - p), 0.0)));
}

/// conditional_inverse of p times conditional at top, without a division for the latter.
[[nodiscard]] inline double truncated_inverse(double theta, double top, double z, double p) {
  const double b = theta * z, d = 1 - b * (1 - top), whole = d * d;
  const double level = p * top * (1 - theta * (1 - top)), rest = whole - level;
  const double a = theta * whole - level * b * b, half = ((1 + theta) * whole - 2 * level * b) / 2;
  return 1 - rest / (half + std::sqrt(std::max(half * half - a * rest, 0.0)));
}

}  // namespace sklar::brdf::sampler_copula
