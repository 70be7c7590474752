#pragma once
/// A reflectance whose directions are drawn as another one's.

#include <stdexcept>
#include <utility>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// eval is that of one Brdf, sample and pdf those of another: pictures of different models take the same paths, so that
/// their differences have hardly any noise.
class DrawnBy final : public Brdf {
 public:
  /// @throws std::invalid_argument for none of either.
  DrawnBy(BrdfPtr brdf, BrdfPtr sampler) : brdf_(std::move(brdf)), sampler_(std::move(sampler)) {
    if (!brdf_ || !sampler_) throw std::invalid_argument("DrawnBy: two reflectances are needed");
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override { return brdf_->eval(wo, wi); }
  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override { return sampler_->pdf(wo, wi); }
  [[nodiscard]] Traits traits() const override { return brdf_->traits(); }
  [[nodiscard]] std::size_t bytes() const override { return brdf_->bytes(); }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override {
    return draw(wo, uniforms).wi;
  }
  [[nodiscard]] Draw draw(const Vec3& wo, const Vec2& uniforms) const override {
    const Sample drawn = sampler_->sample(wo, uniforms);
    return {drawn.wi, drawn.pdf};
  }

 private:
  BrdfPtr brdf_, sampler_;
};

}  // namespace sklar::brdf
