#pragma once
/// The ideal diffuse reflector: f_r = albedo / pi. Source: Lambert 1760, Photometria.

#include <numbers>

#include "brdf/analytic/check.hpp"
#include "brdf/analytic/info.hpp"

namespace sklar::brdf {

class Lambert final : public Brdf {
 public:
  static constexpr Interval kAlbedo{0, 1};

  /// @param albedo each in [0,1]. @throws std::domain_error otherwise.
  explicit Lambert(const Rgb& albedo) : value_(albedo * std::numbers::inv_pi) {
    require_inside("Lambert", "albedo", kAlbedo, albedo);
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    return wo.z() > 0 && wi.z() > 0 ? value_ : Rgb(Rgb::Zero());
  }
  [[nodiscard]] Traits traits() const override { return {.albedo_bound = value_.maxCoeff() * std::numbers::pi}; }
  [[nodiscard]] std::size_t bytes() const override { return sizeof value_; }

 private:
  Rgb value_;  ///< albedo / pi
};

namespace analytic::lambert {

inline AnalyticInfo info() {
  return {.name = "lambert",
          .title = "Lambert",
          .source = "Lambert 1760, Photometria",
          .parameters = {{"albedo", Lambert::kAlbedo, 0.5, true}},
          .examples = {{0.1, 0.5, 1}, {0, 0, 0}},
          .make_unchecked = [](const AnalyticValues& v) { return std::make_shared<const Lambert>(rgb_at(v, 0)); }};
}

}  // namespace analytic::lambert
}  // namespace sklar::brdf
