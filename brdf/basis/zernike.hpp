#pragma once
/// Surface scattering modes: reciprocal products of Zernike functions on the hemispheres.
///
///     f_r(wi, wo) = sum_m cos(m dphi) sum_jk C_mjk Z_j^m(wi) Z_k^m(wo),   C_mjk = C_mkj,   j, k = m, m + 2, ...
///
/// Koenderink, van Doorn and Stavridi 1996, "Bidirectional Reflection Distribution Function expressed in terms of
/// surface scattering modes", ECCV; Koenderink and van Doorn 1998, "Phenomenological description of bidirectional
/// surface reflection", JOSA A 15. The map r = sqrt(2) sin(theta / 2) of equal areas takes the hemisphere to the unit
/// disk, on which Zernike's polynomials are orthogonal:  Z_n^m = sqrt((n + 1) / (pi (1 + [m = 0]))) R_n^m(r).
/// The isotropic reciprocal modes number 1, 2, 5, 8, 14 up to orders 0 to 4, and 55 up to order 8.
///
/// Fitted to f_r in linear space over the hemispheres (fit_series). Can be negative. The order ends at 60, 62 KB, where
/// an evaluation takes some 20 microseconds.

#include "brdf/basis/azimuthal_series.hpp"
#include "brdf/basis/info.hpp"

namespace sklar::brdf {

class Zernike final : public Brdf {
 public:
  /// @param f_r a symmetric series. @throws std::invalid_argument if it is not.
  explicit Zernike(AzimuthalSeries f_r);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return {.non_negative = false}; }

  /// The coefficients, and one for the order.
  [[nodiscard]] std::size_t bytes() const override { return f_r_.shape().bytes(); }

  /// Z_n^m, n = m, m + 2, ...: with cos(m phi) orthonormal over the hemisphere.
  [[nodiscard]] static RadialFunctions radial();

 private:
  AzimuthalSeries f_r_;
};

namespace basis::zernike {

[[nodiscard]] BasisInfo info();

}  // namespace basis::zernike
}  // namespace sklar::brdf
