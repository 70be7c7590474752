#pragma once
/// The glossy term of Ward's model and of those that mend its normalisation.
///
///     f_r = specular / (4 pi alpha_x alpha_y g) exp(-tan^2(theta_h) (cos^2(phi_h)/alpha_x^2 + sin^2(phi_h)/alpha_y^2))
///     g = sqrt(cos_i cos_o)    Ward 1992, "Measuring and Modeling Anisotropic Reflection", eqs. 5a and 5b
///     g = cos_i cos_o          Duer 2006, "An Improved Normalization for the Ward Reflectance Model"
///
/// With a = wi + wo the exponent is -((a_x/alpha_x)^2 + (a_y/alpha_y)^2) / a_z^2: no angle, and the same to the last
/// bit when wi and wo change places. Sampling as in Walter 2005, "Notes on the Ward BRDF": slopes of h are normal,
/// h ~ (alpha_x r cos(2 pi v), alpha_y r sin(2 pi v), 1) with r = sqrt(-log u), which makes
///     pdf(wi) = exp(...) / (4 pi alpha_x alpha_y (h.wi) cos^3(theta_h)) = exp(...) |a|^2 / (2 pi alpha_x alpha_y
///     a_z^3).
///
/// Nothing here conserves energy. The albedo for specular 1 and small alpha is cos_o (Ward) or 1 (Duer); for alpha =
/// 0.3 it is 0.79, 0.69, 0.28, 0.28 (Ward) and 0.86, 0.86, 0.84, 2.4 (Duer) at theta_o = 0, 30, 75, 88 degrees, and
/// both grow without bound toward 90. So does f_r where both directions graze opposite each other: values and densities
/// end at kLargest, which takes cosines below 1e-90.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/analytic/check.hpp"

namespace sklar::brdf {

/// The denominators of Ward (1992) and of Duer (2005).
enum class WardNormalisation { ward, duer };

class WardLobe final : public Brdf {
 public:
  static constexpr Interval kSpecular{0, 1};
  static constexpr Interval kAlpha{1e-6, 1};
  static constexpr double kLargest = 1e200;

  /// @param specular reflectance, each channel in [0,1]. @param alpha_x, alpha_y root mean square slopes times
  /// sqrt(2) along x and y, each in [1e-6,1]. @throws std::domain_error otherwise.
  WardLobe(const Rgb& specular, double alpha_x, double alpha_y, WardNormalisation normalisation)
      : specular_(specular), alpha_x_(alpha_x), alpha_y_(alpha_y), normalisation_(normalisation) {
    require_inside("WardLobe", "specular", kSpecular, specular);
    require_inside("WardLobe", "alpha_x", kAlpha, alpha_x);
    require_inside("WardLobe", "alpha_y", kAlpha, alpha_y);
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
    auto [low, high] = std::minmax({wo.z(), wi.z()});
    if (normalisation_ == WardNormalisation::ward) {
      low = std::sqrt(low);
      high = std::sqrt(high);
    }
    return specular_ *
           std::min(exponential(wi + wo) / (4 * std::numbers::pi * alpha_x_ * alpha_y_) / high / low, kLargest);
  }

  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return 0;
    const Vec3 sum = wi + wo;
    const double over_area = exponential(sum) / (2 * std::numbers::pi * alpha_x_ * alpha_y_);
    if (over_area == 0) return 0;
    const double x = sum.x() / sum.z();
    const double y = sum.y() / sum.z();
    return std::min(over_area * (1 + x * x + y * y) / sum.z(), kLargest);
  }

  [[nodiscard]] Traits traits() const override { return {.isotropic = alpha_x_ == alpha_y_}; }
  [[nodiscard]] std::size_t bytes() const override { return sizeof specular_ + 2 * sizeof alpha_x_; }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override {
    const double radius = std::sqrt(-std::log(uniforms.x()));
    const double phi = 2 * std::numbers::pi * uniforms.y();
    const Vec3 half = Vec3(alpha_x_ * radius * std::cos(phi), alpha_y_ * radius * std::sin(phi), 1).normalized();
    return 2 * wo.dot(half) * half - wo;
  }

 private:
  [[nodiscard]] double exponential(const Vec3& sum) const {
    const double x = sum.x() / alpha_x_ / sum.z();
    const double y = sum.y() / alpha_y_ / sum.z();
    return std::exp(-(x * x + y * y));
  }

  Rgb specular_;
  double alpha_x_, alpha_y_;
  WardNormalisation normalisation_;
};

}  // namespace sklar::brdf
