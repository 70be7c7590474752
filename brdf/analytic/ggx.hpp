#pragma once
/// Isotropic GGX microfacet reflection.
///
///     f_r = F(theta_d) D(h) G2(wi, wo) / (4 cos_i cos_o)
///     D(h) = alpha^2 / (pi (cos^2(theta_h) (alpha^2 - 1) + 1)^2)                     Walter et al. 2007, eq. 33
///     G2 / (4 cos_i cos_o) = 1 / (2 (cos_o l(cos_i) + cos_i l(cos_o)))               Heitz 2014, eq. 99,
///     height-correlated l(c) = sqrt(alpha^2 + (1 - alpha^2) c^2) F = f0 + (1 - f0) (1 - cos(theta_d))^5 Schlick 1994
///
/// Single scattering only: energy that facets reflect onto each other is lost, so that the albedo is at most 1 and
/// falls with alpha. Sampling follows the visible normals of wo by spherical caps (Dupuy and Benyoub 2023); with G1(wo)
/// = 2 cos_o / (cos_o + l(cos_o)),
///     pdf(wi) = G1(wo) D(h) / (4 cos_o) = D(h) / (2 (cos_o + l(cos_o))),
/// which integrates to 1 less the share of draws below the horizon.
///
/// With a = wi + wo and d = wi - wo: D uses (a_x^2 + a_y^2) and a_z^2 instead of cos^2(theta_h) - 1, which cancels for
/// small alpha; 1 - cos(theta_d) = |d|^2 / 4 / (1 + |a|/2). Both are the same to the last bit when wi and wo change
/// places.

#include "brdf/brdf.hpp"

namespace sklar::brdf {

class Ggx final : public Brdf {
 public:
  /// @param f0 reflectance at normal incidence, each channel in [0,1]. @param alpha roughness in [1e-6,1].
  /// @throws std::domain_error otherwise.
  Ggx(const Rgb& f0, double alpha);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return {.albedo_bound = 1.0}; }
  [[nodiscard]] std::size_t bytes() const override { return sizeof f0_ + sizeof alpha_; }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override;

 private:
  [[nodiscard]] double normals(const Vec3& sum) const;     ///< D of the half vector along wi + wo
  [[nodiscard]] double slope_length(double cosine) const;  ///< l

  Rgb f0_;
  double alpha_;
};

}  // namespace sklar::brdf
