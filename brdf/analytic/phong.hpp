#pragma once
/// The modified Phong model: reciprocal, and no more reflected than arrives where diffuse + specular <= 1.
///
///     f_r = diffuse / pi + specular (n + 2) / (2 pi) cos^n(alpha), alpha between wi and the mirror direction of wo
///
/// Lafortune and Willems 1994, "Using the modified Phong reflectance model for physically based rendering" (Report CW
/// 197); with other names for its values Lewis 1994, "Making Shaders More Physically Plausible", Computer Graphics
/// Forum 13(2). Phong 1975 has cos^n(alpha) as radiance, without the factor cos(theta_i) that f_r brings with it, and
/// therefore divides by it, which is not reciprocal.
///
/// The lobe's albedo is `specular` at normal incidence, where cos(alpha) = cos(theta_i), and falls from there, since
/// the lobe and max(0, cos(theta_i)) both fall with the angle from their axes. Draws follow cos^n(alpha) about the
/// mirror direction; those below the horizon are lost.

#include "brdf/analytic/check.hpp"
#include "brdf/analytic/info.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/power_lobe.hpp"
#include "brdf/analytic/sum.hpp"

namespace sklar::brdf {

class PhongLobe final : public Brdf {
 public:
  static constexpr Interval kSpecular{0, 1};
  static constexpr Interval kExponent{0, 1e6};

  /// @param specular albedo at normal incidence, each channel in [0,1]. @param exponent n in [0,1e6].
  /// @throws std::domain_error otherwise.
  PhongLobe(const Rgb& specular, double exponent) : specular_(specular), exponent_(exponent) {
    require_inside("PhongLobe", "specular", kSpecular, specular);
    require_inside("PhongLobe", "exponent", kExponent, exponent);
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
    const double norm = 0.5 * std::numbers::inv_pi * (exponent_ + 2);
    return specular_ * (norm * power_lobe::mirrored_power(wo, wi, exponent_));
  }

  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return 0;
    return power_lobe::density(power_lobe::mirrored_power(wo, wi, exponent_), exponent_);
  }

  [[nodiscard]] Traits traits() const override { return {.albedo_bound = specular_.maxCoeff()}; }
  [[nodiscard]] std::size_t bytes() const override { return sizeof specular_ + sizeof exponent_; }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override {
    return power_lobe::direction({-wo.x(), -wo.y(), wo.z()}, exponent_, uniforms);
  }

 private:
  Rgb specular_;
  double exponent_;
};

namespace analytic::phong {

inline AnalyticInfo info() {
  return {
      .name = "phong",
      .title = "Phong (modified)",
      .source = "Lafortune and Willems 1994; Lewis 1994; Phong 1975",
      .parameters = {{"diffuse", Lambert::kAlbedo, 0.2, true},
                     {"specular", PhongLobe::kSpecular, 0.2, true},
                     {"exponent", PhongLobe::kExponent, 50, false, SearchScale::logarithmic}},
      .examples = {{0, 0, 0, 0.2, 0.5, 1, 2000}, {0.3, 0.2, 0.1, 0.1, 0.1, 0.1, 50}, {0.5, 0.5, 0.5, 0.5, 0, 0.2, 1}},
      .make_unchecked = [](const AnalyticValues& v) {
        const Rgb specular = rgb_at(v, 3);
        return with_diffuse(rgb_at(v, 0), std::make_shared<const PhongLobe>(specular, v[6]), specular);
      }};
}

}  // namespace analytic::phong
}  // namespace sklar::brdf
