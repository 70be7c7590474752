#pragma once
/// The Oren-Nayar model of rough diffuse surfaces, in its qualitative form.
///
///     f_r = albedo / pi (A + B max(0, cos(phi_i - phi_o)) sin(alpha) tan(beta)),
///     alpha, beta = the larger, the smaller of theta_i, theta_o
///     A = 1 - 0.5 sigma^2 / (sigma^2 + 0.33), B = 0.45 sigma^2 / (sigma^2 + 0.09)
///
/// Oren and Nayar 1994, "Generalization of Lambert's Reflectance Model", eq. 30; sigma is the standard deviation of the
/// slope angle of Lambertian V-grooves, in radians, 0 for Lambert's model. It leaves out light reflected twice.
///
/// sin(alpha) tan(beta) cos(phi_i - phi_o) = (wi_x wo_x + wi_y wo_y) / max(cos_i, cos_o): no angle, and the same to the
/// last bit when wi and wo change places. It has no bound where both directions graze side by side and ends at
/// kLargest, which takes cosines below 1e-199. The albedo rises from albedo A at theta_o = 0 to albedo (A + B / 2) at
/// 90 degrees, as much as 1.015 times `albedo` near sigma = 0.2. Draws follow the cosine.

#include <algorithm>
#include <numbers>

#include "brdf/analytic/check.hpp"
#include "brdf/analytic/info.hpp"

namespace sklar::brdf {

class OrenNayar final : public Brdf {
 public:
  static constexpr Interval kAlbedo{0, 1};
  static constexpr Interval kSigma{0, std::numbers::pi / 2};
  static constexpr double kLargest = 1e199;

  /// @param albedo of the facets, each channel in [0,1]. @param sigma radians, in [0, pi/2].
  /// @throws std::domain_error otherwise.
  OrenNayar(const Rgb& albedo, double sigma) : value_(albedo * std::numbers::inv_pi) {
    require_inside("OrenNayar", "albedo", kAlbedo, albedo);
    require_inside("OrenNayar", "sigma", kSigma, sigma);
    const double square = sigma * sigma;
    flat_ = 1 - 0.5 * square / (square + 0.33);
    rough_ = 0.45 * square / (square + 0.09);
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
    const double along = std::max(wi.x() * wo.x() + wi.y() * wo.y(), 0.0);
    return value_ * (flat_ + rough_ * std::min(along / std::max(wi.z(), wo.z()), kLargest));
  }

  [[nodiscard]] Traits traits() const override {
    return {.albedo_bound = std::numbers::pi * value_.maxCoeff() * (flat_ + 0.5 * rough_)};
  }
  [[nodiscard]] std::size_t bytes() const override { return sizeof value_ + sizeof flat_ + sizeof rough_; }

 private:
  Rgb value_;  ///< albedo / pi
  double flat_ = 1, rough_ = 0;
};

namespace analytic::oren_nayar {

inline AnalyticInfo info() {
  return {
      .name = "oren_nayar",
      .title = "Oren-Nayar (qualitative)",
      .source = "Oren and Nayar 1994, eq. 30",
      .parameters = {{"albedo", OrenNayar::kAlbedo, 0.5, true}, {"sigma", OrenNayar::kSigma, 0.3}},
      .examples = {{0.1, 0.5, 1, 0}, {0.1, 0.5, 1, 0.3}, {1, 0.2, 0, 0.7}, {1, 1, 1, 1.5}},
      .make_unchecked = [](const AnalyticValues& v) { return std::make_shared<const OrenNayar>(rgb_at(v, 0), v[3]); }};
}

}  // namespace analytic::oren_nayar
}  // namespace sklar::brdf
