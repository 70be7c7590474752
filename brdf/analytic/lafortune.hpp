#pragma once
/// Lafortune's model: a diffuse term and up to three generalised cosine lobes.
///
///     f_r = diffuse / pi + sum of specular (n + 2) / (2 pi) max(0, C_x wi_x wo_x + C_y wi_y wo_y + C_z wi_z wo_z)^n
///
/// Lafortune, Foo, Torrance and Greenberg 1997, "Non-Linear Approximation of Reflectance Functions", the section on the
/// generalised cosine lobe, in the frame of the surface, where the matrix of the lobe is diagonal. There the scale of a
/// lobe may be that of its C; here it is `specular`, and each C is in [-1,1], since C^n overflows for a large n. C =
/// (-1, -1, 1) is the modified Phong lobe, C_x = C_y > 0 reflects back where light came from, C_z < |C_x| makes the
/// peak flatter than the mirror direction, C_x != C_y is anisotropic.
///
/// With the axis (C_x wo_x, C_y wo_y, C_z wo_z), of length l <= 1, a lobe is specular (n + 2) / (2 pi) l^n cos^n about
/// it: its albedo is at most that of a Phong lobe, `specular`. Draws follow cos^n about the axis, about the normal
/// where l is 0; those below the horizon are lost. Rounding of the sum leaves a relative error of n times 1e-16 or so.

#include "brdf/analytic/check.hpp"
#include "brdf/analytic/info.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/power_lobe.hpp"
#include "brdf/analytic/sum.hpp"

namespace sklar::brdf {

class LafortuneLobe final : public Brdf {
 public:
  static constexpr Interval kSpecular{0, 1};
  static constexpr Interval kDirection{-1, 1};
  static constexpr Interval kExponent{0, 1e4};

  /// @param specular each channel in [0,1]. @param direction C_x, C_y, C_z, each in [-1,1]. @param exponent n in
  /// [0,1e4]. @throws std::domain_error otherwise.
  LafortuneLobe(const Rgb& specular, const Vec3& direction, double exponent)
      : specular_(specular), direction_(direction), exponent_(exponent) {
    require_inside("LafortuneLobe", "specular", kSpecular, specular);
    require_inside("LafortuneLobe", "direction", kDirection, direction.array());
    require_inside("LafortuneLobe", "exponent", kExponent, exponent);
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
    const double cosine = direction_.dot(wi.cwiseProduct(wo));
    if (!(cosine > 0)) return Rgb::Zero();
    const double norm = 0.5 * std::numbers::inv_pi * (exponent_ + 2);
    return specular_ * (norm * std::pow(cosine, exponent_));
  }

  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return 0;
    return power_lobe::density(power_lobe::power(axis(wo), wi, exponent_), exponent_);
  }

  [[nodiscard]] Traits traits() const override {
    return {.isotropic = direction_.x() == direction_.y() || (specular_ == 0).all(),
            .albedo_bound = specular_.maxCoeff()};
  }
  [[nodiscard]] std::size_t bytes() const override { return sizeof specular_ + sizeof direction_ + sizeof exponent_; }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override {
    return power_lobe::direction(axis(wo), exponent_, uniforms);
  }

 private:
  [[nodiscard]] Vec3 axis(const Vec3& wo) const {
    const Vec3 along = direction_.cwiseProduct(wo);
    return (along.array() == 0).all() ? Vec3(Vec3::UnitZ()) : along.stableNormalized();
  }

  Rgb specular_;
  Vec3 direction_;
  double exponent_;
};

namespace analytic::lafortune {

/// Lobes of the model, and numbers of each.
inline constexpr int kLobes = 3;
inline constexpr int kLobeValues = 7;  // specular, C, exponent

/// The lobes whose specular is not 0, the first in any case; draws follow each in proportion to its specular.
inline BrdfPtr lobes(const AnalyticValues& v) {
  BrdfPtr all;
  double strength = 0;
  for (int n = 0; n < kLobes; ++n) {
    const auto at = static_cast<std::size_t>(3 + kLobeValues * n);
    const Rgb specular = rgb_at(v, at);
    auto lobe = std::make_shared<const LafortuneLobe>(specular, Vec3(v[at + 3], v[at + 4], v[at + 5]), v[at + 6]);
    if (all && specular.mean() == 0) continue;
    const double before = strength;
    strength += specular.mean();
    all = before > 0 ? std::make_shared<const Sum>(std::move(all), std::move(lobe), before / strength) : BrdfPtr(lobe);
  }
  return all;
}

inline AnalyticInfo info() {
  std::vector<AnalyticParameter> parameters = {{"diffuse", Lambert::kAlbedo, 0.2, true}};
  for (int n = 1; n <= kLobes; ++n) {
    const std::string number = "_" + std::to_string(n);
    parameters.push_back({"specular" + number, LafortuneLobe::kSpecular, n == 1 ? 0.2 : 0.0, true});
    parameters.push_back({"c_x" + number, LafortuneLobe::kDirection, -1});
    parameters.push_back({"c_y" + number, LafortuneLobe::kDirection, -1, false, SearchScale::linear, "c_x" + number});
    parameters.push_back({"c_z" + number, LafortuneLobe::kDirection, 1});
    parameters.push_back({"exponent" + number, LafortuneLobe::kExponent, 20, false, SearchScale::logarithmic});
  }
  // One lobe; a forward, an off-specular and a retro-reflecting one; an anisotropic one beside a forward one.
  return {
      .name = "lafortune",
      .title = "Lafortune",
      .source = "Lafortune, Foo, Torrance and Greenberg 1997",
      .parameters = parameters,
      .examples = {{0, 0, 0, 0.2, 0.5, 1, -1, -1, 1, 2000, 0, 0, 0, -1, -1, 1, 20, 0, 0, 0, -1, -1, 1, 20},
                   {0.1, 0.2, 0.3, 0.2, 0.2, 0.2, -0.98, -0.98, 0.95, 100, 0.1, 0.1,
                    0.2, -1,  -1,  0.7, 20,  0.3, 0.1,   0.1,   0.9,  0.9, 0.8, 5},
                   {0.2, 0, 0, 0.3, 0.3, 0.3, -1, -0.8, 0.9, 30, 0, 0, 0, -1, -1, 1, 0, 0, 0.1, 0.2, -1, -1, 1, 300}},
      .make_unchecked = [](const AnalyticValues& v) {
        const Rgb specular = rgb_at(v, 3) + rgb_at(v, 3 + kLobeValues) + rgb_at(v, 3 + 2 * kLobeValues);
        return with_diffuse(rgb_at(v, 0), lobes(v), specular);
      }};
}

}  // namespace analytic::lafortune
}  // namespace sklar::brdf
