#pragma once
/// Neumann's stretched Phong model of metals.
///
///     f_r = specular (n + 1) / (2 pi) cos^n(alpha) / max(cos_i, cos_o), alpha between wi and the mirror direction of
///     wo
///
/// Neumann, Neumann and Szirmay-Kalos 1999, "Compact Metallic Reflectance Models", Computer Graphics Forum 18(3). Where
/// the modified Phong lobe darkens with theta_o as its cosine does, the division keeps the albedo, as a metal does: it
/// tends to `specular` at every theta_o for large n. With the factor (n + 1) / (2 pi) no more is reflected than
/// arrives: draws follow (n + 1) / (2 pi) cos^n(alpha), and f cos_i / pdf = specular cos_i / max(cos_i, cos_o) <=
/// specular. Draws below the horizon are lost. f_r has no bound where both directions graze opposite each other and
/// ends at power_lobe::kLargest, which takes cosines below 1e-194.

#include <algorithm>

#include "brdf/analytic/check.hpp"
#include "brdf/analytic/info.hpp"
#include "brdf/analytic/power_lobe.hpp"

namespace sklar::brdf {

class Neumann final : public Brdf {
 public:
  static constexpr Interval kSpecular{0, 1};
  static constexpr Interval kExponent{0, 1e6};

  /// @param specular albedo of the smooth metal, each channel in [0,1]. @param exponent n in [0,1e6].
  /// @throws std::domain_error otherwise.
  Neumann(const Rgb& specular, double exponent) : specular_(specular), exponent_(exponent) {
    require_inside("Neumann", "specular", kSpecular, specular);
    require_inside("Neumann", "exponent", kExponent, exponent);
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
    return specular_ * std::min(pdf(wo, wi) / std::max(wi.z(), wo.z()), power_lobe::kLargest);
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

namespace analytic::neumann {

inline AnalyticInfo info() {
  return {
      .name = "neumann",
      .title = "Neumann (stretched Phong)",
      .source = "Neumann, Neumann and Szirmay-Kalos 1999, Compact Metallic Reflectance Models",
      .parameters = {{"specular", Neumann::kSpecular, 0.5, true},
                     {"exponent", Neumann::kExponent, 100, false, SearchScale::logarithmic}},
      .examples = {{0.95, 0.7, 0.3, 1000}, {0.2, 0.5, 1, 50}, {1, 1, 0, 1}},
      .make_unchecked = [](const AnalyticValues& v) { return std::make_shared<const Neumann>(rgb_at(v, 0), v[3]); }};
}

}  // namespace analytic::neumann
}  // namespace sklar::brdf
