#pragma once
/// Draws wi given wo nearly as f_r cos(theta_i) is distributed, for any reflectance.
///
/// Given theta_o a mixture of six densities, each the product of two margins, of a polar coordinate and of an azimuth
/// folded at the plane of incidence: the mixture is the copula. Two components are over wi itself, four over the half
/// vector, dwi = 4 (wo.h) dwh, in the coordinates of half_disk.hpp, in which the horizon is the unit circle: no draw is
/// lost below it, and the density integrates to 1. A component is chosen, and each margin inverted, a quadratic. A
/// share kCosineShare of the draws follows the cosine, so that
///     pdf >= kCosineShare cos(theta_i) / pi
/// wherever light can go: the weight f_r cos / pdf is at most pi / kCosineShare times f_r.
///
/// What is followed is the luminance of f_r cos(theta_i), both sides of the plane of incidence averaged; for an
/// anisotropic reflectance also the mean over phi_o. The density is exact in any case: how well it fits f_r decides
/// only the variance.

#include "brdf/brdf.hpp"
#include "brdf/sampling/sampler_kernel.hpp"

namespace sklar::brdf {

/// Immutable, thread-safe, no allocation in the calls.
class ConditionalSampler {
 public:
  static constexpr double kCosineShare = kSamplerCosineShare;

  /// Fits the tables, on all threads of oneTBB and with the same result for any number of them: 0.2 s and
  /// 160,000 evaluations of f_r (eight times as many for an anisotropic one).
  explicit ConditionalSampler(const Brdf& brdf);

  /// @param wo unit. @param uniforms in (0,1): one for the component and its azimuth, one for the polar coordinate; wi
  /// is continuous in both but where the component changes. @return unit, above the horizon up to rounding; for a wo
  /// that is not above the horizon a draw from the cosine hemisphere.
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const {
    return sampler_direction(tables_, wo, uniforms);
  }

  /// Density of these draws per solid angle of wi, computed in single precision: relative error 1e-5. 0 where either
  /// direction is not above the horizon. Continuous in both directions.
  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const { return sampler_pdf(tables_, wo, wi); }

  /// The direction and its density, the same to the last bit as by two calls.
  [[nodiscard]] Draw draw(const Vec3& wo, const Vec2& uniforms) const { return sampler_draw(tables_, wo, uniforms); }

  /// The same row by row, into wi and pdf of `out`.
  void draw(const DirectionsRef& wo, const UniformsRef& uniforms, Samples& out) const {
    sampler_draw_rows(tables_, wo, uniforms, out);
  }

  /// Of the tables; below 16 KB whatever the reflectance.
  [[nodiscard]] std::size_t bytes() const { return tables_.bytes(); }

  [[nodiscard]] const SamplerTables& tables() const { return tables_; }

 private:
  SamplerTables tables_;
};

}  // namespace sklar::brdf
