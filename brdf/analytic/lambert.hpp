#pragma once
/// The ideal diffuse reflector: f_r = albedo / pi. Source: Lambert 1760, Photometria.

#include "brdf/brdf.hpp"

namespace sklar::brdf {

class Lambert final : public Brdf {
 public:
  /// @param albedo each in [0,1]. @throws std::domain_error otherwise.
  explicit Lambert(const Rgb& albedo);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override;
  [[nodiscard]] std::size_t bytes() const override { return sizeof value_; }

 private:
  Rgb value_;  ///< albedo / pi
};

}  // namespace sklar::brdf
