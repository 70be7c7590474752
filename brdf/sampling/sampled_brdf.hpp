#pragma once
/// Any reflectance with a good sampler.

#include "brdf/sampling/conditional_sampler.hpp"

namespace sklar::brdf {

/// f_r of another Brdf, sampled by a ConditionalSampler of it: to a renderer a Brdf like any other.
class SampledBrdf final : public Brdf {
 public:
  /// Makes the sampler. @throws std::invalid_argument for no brdf.
  explicit SampledBrdf(BrdfPtr brdf);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override { return brdf_->eval(wo, wi); }
  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override { return sampler_.pdf(wo, wi); }
  [[nodiscard]] Traits traits() const override { return brdf_->traits(); }

  /// Of the reflectance and the tables of the sampler.
  [[nodiscard]] std::size_t bytes() const override { return brdf_->bytes() + sampler_.bytes(); }

  [[nodiscard]] const BrdfPtr& brdf() const { return brdf_; }
  [[nodiscard]] const ConditionalSampler& sampler() const { return sampler_; }

 protected:
  void eval_batch(const DirectionsRef& wo, const DirectionsRef& wi, Eigen::Ref<RgbRows> out) const override;
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override {
    return sampler_.sample_direction(wo, uniforms);
  }
  [[nodiscard]] Draw draw(const Vec3& wo, const Vec2& uniforms) const override { return sampler_.draw(wo, uniforms); }
  void draw_batch(const DirectionsRef& wo, const UniformsRef& uniforms, Samples& out) const override {
    sampler_.draw(wo, uniforms, out);
  }

 private:
  BrdfPtr brdf_;
  ConditionalSampler sampler_;
};

}  // namespace sklar::brdf
