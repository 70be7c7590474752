#include "brdf/analytic/sum.hpp"

#include <stdexcept>

#include "brdf/analytic/check.hpp"
#include "brdf/analytic/lambert.hpp"

namespace sklar::brdf {

Sum::Sum(BrdfPtr first, BrdfPtr second, double share)
    : first_(std::move(first)), second_(std::move(second)), share_(share) {
  if (!first_ || !second_) throw std::invalid_argument("Sum: two reflectances are needed");
  require_inside("Sum", "share", {0, 1}, share);
}

Rgb Sum::eval(const Vec3& wo, const Vec3& wi) const {
  return first_->eval(wo, wi) + second_->eval(wo, wi);
}

double Sum::pdf(const Vec3& wo, const Vec3& wi) const {
  return share_ * first_->pdf(wo, wi) + (1 - share_) * second_->pdf(wo, wi);
}

Traits Sum::traits() const {
  const Traits a = first_->traits();
  const Traits b = second_->traits();
  const bool bounded = a.albedo_bound > 0 && b.albedo_bound > 0;
  return {.reciprocal = a.reciprocal && b.reciprocal,
          .isotropic = a.isotropic && b.isotropic,
          .non_negative = a.non_negative && b.non_negative,
          .albedo_bound = bounded ? a.albedo_bound + b.albedo_bound : 0.0};
}

Vec3 Sum::sample_direction(const Vec3& wo, const Vec2& uniforms) const {
  // The first uniform chooses and is stretched over (0,1] again.
  if (uniforms.x() < share_) return first_->sample(wo, {uniforms.x() / share_, uniforms.y()}).wi;
  return second_->sample(wo, {(1 - uniforms.x()) / (1 - share_), uniforms.y()}).wi;
}

BrdfPtr with_diffuse(const Rgb& albedo, BrdfPtr lobe, const Rgb& strength) {
  const double both = albedo.mean() + strength.mean();
  return std::make_shared<const Sum>(std::make_shared<const Lambert>(albedo), std::move(lobe),
                                     both > 0 ? albedo.mean() / both : 0.0);
}

}  // namespace sklar::brdf
