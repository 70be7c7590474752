#pragma once
/// A lobe on the halfway vector disk over a diffuse base: f_r cos(theta_i) is a density of wi by construction.
///
/// Edwards, Boulos, Johnson, Shirley, Ashikhmin, Stark and Wyman 2006, "The Halfway Vector Disk for BRDF Modeling":
/// given wo, half vectors that lead above the horizon are projected to a unit disk, and a density on the disk, divided
/// by cos(theta_i), is a reflectance whose albedo is 1 at every angle. As published such a model is not reciprocal.
/// Here the disk is that of geometry/half_disk.hpp, their scaling projection with the mirror direction moved to the
/// middle by a Moebius map, and the density on it, which is our choice, is
///     p(m) = (n + 1) / pi (1 - |m|^2)^n,
///     f_r = diffuse / pi + specular p(m) (d^2 m / dwi) / cos(theta_i).
/// n is at least 1, so that f_r stays finite at the horizon. The albedo is diffuse + specular, to rounding.

#include "brdf/analytic/check.hpp"
#include "brdf/analytic/info.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/power_lobe.hpp"
#include "brdf/analytic/sum.hpp"
#include "brdf/geometry/half_disk.hpp"

namespace sklar::brdf {

class HalfwayDiskLobe final : public Brdf {
 public:
  static constexpr Interval kSpecular{0, 1};
  static constexpr Interval kExponent{1, 1e6};

  /// @param specular albedo of the lobe, each channel in [0,1]. @param exponent n in [1,1e6].
  /// @throws std::domain_error otherwise.
  HalfwayDiskLobe(const Rgb& specular, double exponent) : specular_(specular), exponent_(exponent) {
    require_inside("HalfwayDiskLobe", "specular", kSpecular, specular);
    require_inside("HalfwayDiskLobe", "exponent", kExponent, exponent);
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
    return specular_ * std::min(density(wo, wi) / wi.z(), power_lobe::kLargest);
  }

  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return 0;
    return density(wo, wi);
  }

  [[nodiscard]] Traits traits() const override {
    return {.reciprocal = (specular_ == 0).all(), .albedo_bound = specular_.maxCoeff()};
  }
  [[nodiscard]] std::size_t bytes() const override { return sizeof specular_ + sizeof exponent_; }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override {
    const Outgoing given(wo);
    const double log_rest = std::log(uniforms.x()) / (exponent_ + 1), square = -std::expm1(log_rest);
    const double radius = std::sqrt(square), psi = 2 * std::numbers::pi * uniforms.y();
    const LocalDirection wi =
        from_disk(given, radius * std::cos(psi), radius * std::sin(psi), square, std::exp(log_rest));
    return {wi.along * given.along.x() - wi.across * given.along.y(),
            wi.along * given.along.y() + wi.across * given.along.x(), wi.up};
  }

 private:
  /// p(m) d^2 m / dwi.
  [[nodiscard]] double density(const Vec3& wo, const Vec3& wi) const {
    const HalfDisk half(Outgoing(wo), wo, wi);
    const double height = power_lobe::power(half.rest, half.square, exponent_);
    return (exponent_ + 1) * std::numbers::inv_pi * height * half.area;
  }

  Rgb specular_;
  double exponent_;
};

namespace analytic::halfway_disk {

inline AnalyticInfo info() {
  return {
      .name = "halfway_disk",
      .title = "Halfway vector disk",
      .source = "Edwards and others 2006, with a density of our own on the disk",
      .parameters = {{"diffuse", Lambert::kAlbedo, 0.2, true},
                     {"specular", HalfwayDiskLobe::kSpecular, 0.2, true},
                     {.name = "exponent",
                      .bounds = HalfwayDiskLobe::kExponent,
                      .initial = 30,
                      .scale = SearchScale::logarithmic}},
      .examples = {{0.1, 0.1, 0, 0.2, 0.5, 1, 200}, {0.1, 0.2, 0.3, 0.5, 0.3, 0.1, 30}, {0, 0.1, 0, 0.2, 0.1, 0, 1}},
      .make_unchecked = [](const AnalyticValues& v) {
        const Rgb specular = rgb_at(v, 3);
        return with_diffuse(rgb_at(v, 0), std::make_shared<const HalfwayDiskLobe>(specular, v[6]), specular);
      }};
}

}  // namespace analytic::halfway_disk
}  // namespace sklar::brdf
