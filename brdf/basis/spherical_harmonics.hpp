#pragma once
/// Spherical harmonics in both directions.
///
///     f_r(wi, wo) cos_i = sum_m cos(m dphi) sum_jk C_mjk P_j^m(cos_i) P_k^m(cos_o),   j, k >= m
///
/// Westin, Arvo and Torrance 1992, "Predicting Reflectance Functions from Complex Surfaces": the matrix of
/// f_r cos_i over real spherical harmonics of wi and wo, of which isotropy leaves pairs of one m; also Sillion, Arvo,
/// Westin and Greenberg 1991, "A Global Illumination Solution for General Reflectance Distributions". P are the
/// associated Legendre functions with the norm of the harmonics on the whole sphere; up to order L there are
/// (L + 1)(L + 2)(2 L + 3) / 6 of C.
///
/// Fitted to f_r cos_i in linear space over the hemispheres (fit_series). Can be negative, and is not reciprocal. f_r
/// divides by max(cos_i, cos 89 deg). The order ends at 30, 62 KB, where an evaluation takes some 20 microseconds.

#include "brdf/basis/azimuthal_series.hpp"
#include "brdf/basis/info.hpp"

namespace sklar::brdf {

class SphericalHarmonics final : public Brdf {
 public:
  /// @param f_cos the series of f_r cos_i over wi and wo.
  explicit SphericalHarmonics(AzimuthalSeries f_cos) : f_cos_(std::move(f_cos)) {}

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return {.reciprocal = false, .non_negative = false}; }

  /// The coefficients, and one for the order.
  [[nodiscard]] std::size_t bytes() const override { return f_cos_.shape().bytes(); }

  /// P_j^m, orthonormal over the sphere together with sqrt(2) cos(m phi), or 1 for m = 0.
  [[nodiscard]] static RadialFunctions radial();

 private:
  AzimuthalSeries f_cos_;
};

namespace basis::spherical_harmonics {

[[nodiscard]] BasisInfo info();

}  // namespace basis::spherical_harmonics
}  // namespace sklar::brdf
