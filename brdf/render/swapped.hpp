#pragma once
/// A reflectance with its two directions exchanged: pictures show whether it is reciprocal.

#include <stdexcept>
#include <utility>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// eval(wo, wi) is base.eval(wi, wo); draws and their densities are those of the base.
class Swapped final : public Brdf {
 public:
  /// @throws std::invalid_argument for no base.
  explicit Swapped(BrdfPtr base) : base_(std::move(base)) {
    if (!base_) throw std::invalid_argument("Swapped: a reflectance is needed");
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override { return base_->eval(wi, wo); }
  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override { return base_->pdf(wo, wi); }
  [[nodiscard]] Traits traits() const override { return base_->traits(); }
  [[nodiscard]] std::size_t bytes() const override { return base_->bytes(); }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override {
    return draw(wo, uniforms).wi;
  }
  [[nodiscard]] Draw draw(const Vec3& wo, const Vec2& uniforms) const override {
    const Sample drawn = base_->sample(wo, uniforms);
    return {drawn.wi, drawn.pdf};
  }

 private:
  BrdfPtr base_;
};

}  // namespace sklar::brdf
