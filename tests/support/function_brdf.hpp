#pragma once
/// Reflectances given by a formula in a test.

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "brdf/brdf.hpp"

namespace sklar::test {

/// f_r = formula(wo, wi) above the horizon, 0 below.
class FunctionBrdf final : public brdf::Brdf {
 public:
  using Formula = std::function<brdf::Rgb(const brdf::Vec3& wo, const brdf::Vec3& wi)>;

  explicit FunctionBrdf(Formula formula, brdf::Traits traits = {}) : formula_(std::move(formula)), traits_(traits) {}

  using Brdf::eval;
  [[nodiscard]] brdf::Rgb eval(const brdf::Vec3& wo, const brdf::Vec3& wi) const override {
    return wo.z() > 0 && wi.z() > 0 ? formula_(wo, wi) : brdf::Rgb::Zero();
  }
  [[nodiscard]] brdf::Traits traits() const override { return traits_; }
  [[nodiscard]] std::size_t bytes() const override { return 0; }

 private:
  Formula formula_;
  brdf::Traits traits_;
};

inline FunctionBrdf lambert(const brdf::Rgb& albedo) {
  return FunctionBrdf([=](const auto&, const auto&) -> brdf::Rgb { return albedo * std::numbers::inv_pi; });
}

/// Isotropic GGX with height-correlated Smith masking and no Fresnel term (Walter et al. 2007; Heitz 2014).
inline FunctionBrdf mirror_ggx(double alpha) {
  return FunctionBrdf([=](const brdf::Vec3& wo, const brdf::Vec3& wi) -> brdf::Rgb {
    const double a2 = alpha * alpha;
    const brdf::Vec3 half = (wo + wi).normalized();
    const double t = half.z() * half.z() * (a2 - 1) + 1;
    const auto root = [a2](double c) { return std::sqrt(a2 + (1 - a2) * c * c); };
    const double shadow = wo.z() * root(wi.z()) + wi.z() * root(wo.z());
    return brdf::Rgb::Constant(a2 / (2 * std::numbers::pi * t * t * shadow));
  });
}

}  // namespace sklar::test
