#pragma once
/// The normalised Blinn-Phong model, a power of the half vector's cosine without geometry or Fresnel term.
///
///     f_r = diffuse / pi + specular N cos^n(theta_h)               lobe: Blinn 1977, "Models of Light Reflection for
///     N = (n + 2) (n + 4) / (8 pi (2^(-n/2) + n))                  Computer Synthesized Pictures"
///
/// N makes the lobe's albedo `specular` at normal incidence, where theta_i = 2 theta_h: the integral of
/// cos^n(t) cos(2 t) 2 sin(2 t) 2 pi over t in (0, pi/4) is 1 / N. It falls from there (n = 5: 1, 0.85, 0.51, 0.19 at
/// theta_o = 0, 30, 60, 90 degrees), so that no more is reflected than arrives where diffuse + specular <= 1; toward
/// cos^2(theta_o) for large n. Draws: theta_h with density (n + 1) / (2 pi) cos^n(theta_h), so that
///     pdf(wi) = (n + 1) / (2 pi) cos^n(theta_h) / (4 (h.wi)) = (n + 1) / (4 pi |wi + wo|) cos^n(theta_h),
/// less those below the horizon. It has no bound where both directions graze opposite each other and ends at
/// power_lobe::kLargest, which takes cosines below 1e-195.

#include "brdf/analytic/check.hpp"
#include "brdf/analytic/info.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/power_lobe.hpp"
#include "brdf/analytic/sum.hpp"

namespace sklar::brdf {

class BlinnPhongLobe final : public Brdf {
 public:
  static constexpr Interval kSpecular{0, 1};
  static constexpr Interval kExponent{0, 1e6};

  /// @param specular albedo at normal incidence, each channel in [0,1]. @param exponent n in [0,1e6].
  /// @throws std::domain_error otherwise.
  BlinnPhongLobe(const Rgb& specular, double exponent) : specular_(specular), exponent_(exponent) {
    require_inside("BlinnPhongLobe", "specular", kSpecular, specular);
    require_inside("BlinnPhongLobe", "exponent", kExponent, exponent);
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
    const Vec3 sum = wi + wo;
    const double length = std::hypot(sum.x(), sum.y(), sum.z());
    const double norm =
        (exponent_ + 2) * (exponent_ + 4) / (8 * std::numbers::pi * (std::exp2(-0.5 * exponent_) + exponent_));
    return specular_ * (norm * power_lobe::half_power(sum, length, exponent_));
  }

  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return 0;
    const Vec3 sum = wi + wo;
    const double length = std::hypot(sum.x(), sum.y(), sum.z());
    const double of_half = power_lobe::density(power_lobe::half_power(sum, length, exponent_), exponent_);
    return std::min(of_half / (2 * length), power_lobe::kLargest);
  }

  [[nodiscard]] Traits traits() const override { return {.albedo_bound = specular_.maxCoeff()}; }
  [[nodiscard]] std::size_t bytes() const override { return sizeof specular_ + sizeof exponent_; }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override {
    const Vec3 half = power_lobe::direction(Vec3::UnitZ(), exponent_, uniforms);
    return 2 * wo.dot(half) * half - wo;
  }

 private:
  Rgb specular_;
  double exponent_;
};

namespace analytic::blinn_phong {

inline AnalyticInfo info() {
  return {.name = "blinn_phong",
          .title = "Blinn-Phong (normalised)",
          .source = "Blinn 1977; Phong 1975",
          .parameters = {{"diffuse", Lambert::kAlbedo, 0.2, true},
                         {"specular", BlinnPhongLobe::kSpecular, 0.2, true},
                         {"exponent", BlinnPhongLobe::kExponent, 200, false, SearchScale::logarithmic}},
          .examples = {{0, 0, 0, 0.2, 0.5, 1, 5000}, {0.3, 0.2, 0.1, 0.1, 0.1, 0.1, 100}, {0.5, 0.5, 0, 0.5, 0, 1, 2}},
          .make_unchecked = [](const AnalyticValues& v) {
            const Rgb specular = rgb_at(v, 3);
            return with_diffuse(rgb_at(v, 0), std::make_shared<const BlinnPhongLobe>(specular, v[6]), specular);
          }};
}

}  // namespace analytic::blinn_phong
}  // namespace sklar::brdf
