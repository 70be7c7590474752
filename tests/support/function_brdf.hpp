#pragma once
/// Reflectances given by a formula in a test.

#include <functional>
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

}  // namespace sklar::test
