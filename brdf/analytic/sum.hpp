#pragma once
/// Two reflectances on one surface.

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// f_r is the sum, pdf the mixture of both densities.
class Sum final : public Brdf {
 public:
  /// @param share of the draws that follow `first`, in [0,1]; in (0,1) the draws cover what both reflect.
  /// @throws std::invalid_argument for no first or second, std::domain_error for a share outside [0,1].
  Sum(BrdfPtr first, BrdfPtr second, double share);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override;

  /// What both claim; the albedo bound is the sum where both have one.
  [[nodiscard]] Traits traits() const override;
  [[nodiscard]] std::size_t bytes() const override { return first_->bytes() + second_->bytes() + sizeof share_; }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override;

 private:
  BrdfPtr first_, second_;
  double share_;
};

/// Lambert of the given albedo under a lobe; draws follow each in proportion to the means of albedo and `strength`, or
/// the lobe where both are 0. @throws std::domain_error for an albedo outside [0,1].
[[nodiscard]] BrdfPtr with_diffuse(const Rgb& albedo, BrdfPtr lobe, const Rgb& strength);

}  // namespace sklar::brdf
