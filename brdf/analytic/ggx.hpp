#pragma once
/// GGX microfacet reflection, isotropic or anisotropic.
///
///     f_r = F(theta_d) D(h) G2(wi, wo) / (4 cos_i cos_o)
///     D(h) = 1 / (pi alpha_x alpha_y (h_x^2/alpha_x^2 + h_y^2/alpha_y^2 + h_z^2)^2)   Walter et al. 2007, eq. 33;
///                                                                                    Heitz 2018, eq. 1
///     G2 / (4 cos_i cos_o) = 1 / (2 (cos_o l(wi) + cos_i l(wo)))                      Heitz 2014, eq. 99,
///     height-correlated l(w) = sqrt(alpha_x^2 w_x^2 + alpha_y^2 w_y^2 + w_z^2)        Heitz 2018, eq. 2
///     F = f0 + (1 - f0) (1 - cos(theta_d))^5                                          Schlick 1994
///
/// Single scattering only: energy that facets reflect onto each other is lost, so that the albedo is at most 1 and
/// falls with alpha. Sampling follows the visible normals of wo (Heitz 2018, eq. 3): wo is stretched to where the
/// normals are those of a sphere, a normal is drawn there from a spherical cap (Dupuy and Benyoub 2023) and
/// unstretched; with G1(wo) = 2 cos_o / (cos_o + l(wo)),
///     pdf(wi) = G1(wo) D(h) / (4 cos_o) = D(h) / (2 (cos_o + l(wo))),
/// which integrates to 1 less the share of draws below the horizon.
///
/// With a = wi + wo and d = wi - wo: D is a ratio of |a|^2 and a quadratic form of a, without cos^2(theta_h) - 1, which
/// cancels for small alpha; 1 - cos(theta_d) = |d|^2 / 4 / (1 + |a|/2). Both are the same to the last bit when wi and
/// wo change places.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/analytic/check.hpp"
#include "brdf/analytic/fresnel.hpp"
#include "brdf/analytic/info.hpp"

namespace sklar::brdf {

class Ggx final : public Brdf {
 public:
  static constexpr Interval kF0{0, 1};
  static constexpr Interval kAlpha{1e-6, 1};  // unit vectors in double leave ten digits of a slope of the smallest

  /// @param f0 reflectance at normal incidence, each channel in [0,1]. @param alpha roughness in [1e-6,1].
  /// @throws std::domain_error otherwise.
  Ggx(const Rgb& f0, double alpha) : f0_(f0), alpha_x_(alpha), alpha_y_(alpha) {
    require_inside("Ggx", "f0", kF0, f0);
    require_inside("Ggx", "alpha", kAlpha, alpha);
  }

  /// @param alpha_x, alpha_y roughness along x and y, each in [1e-6,1].
  Ggx(const Rgb& f0, double alpha_x, double alpha_y) : f0_(f0), alpha_x_(alpha_x), alpha_y_(alpha_y) {
    require_inside("Ggx", "f0", kF0, f0);
    require_inside("Ggx", "alpha_x", kAlpha, alpha_x);
    require_inside("Ggx", "alpha_y", kAlpha, alpha_y);
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
    const Vec3 sum = wi + wo;
    const Rgb fresnel = schlick_fresnel(f0_, wo, wi, sum.norm());
    // One order for both (wo, wi) and (wi, wo), whatever the compiler makes of a product and a sum.
    const auto [low, high] = std::minmax({wo.z() * stretch(wi), wi.z() * stretch(wo)});
    return fresnel * (normals(sum) / (2 * (low + high)));
  }

  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return 0;
    return normals(wi + wo) / (2 * (wo.z() + stretch(wo)));
  }

  [[nodiscard]] Traits traits() const override { return {.isotropic = alpha_x_ == alpha_y_, .albedo_bound = 1.0}; }
  [[nodiscard]] std::size_t bytes() const override {
    return sizeof f0_ + (alpha_x_ == alpha_y_ ? 1 : 2) * sizeof(double);
  }

  /// The mean of F over the cosine hemisphere, to weigh draws by.
  [[nodiscard]] Rgb strength() const { return mean_schlick_fresnel(f0_); }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override {
    const Vec3 stretched = Vec3(alpha_x_ * wo.x(), alpha_y_ * wo.y(), wo.z()).normalized();
    // A point of the spherical cap z in [-stretched.z, 1]; 1 - z is drawn, so that the sine does not cancel.
    const double fall = uniforms.y() * (1 + stretched.z());
    const double sine = std::sqrt(fall * (2 - fall));
    const double phi = 2 * std::numbers::pi * uniforms.x();
    const Vec3 cap = Vec3(sine * std::cos(phi), sine * std::sin(phi), 1 - fall) + stretched;
    const Vec3 half = Vec3(alpha_x_ * cap.x(), alpha_y_ * cap.y(), cap.z()).normalized();
    return 2 * wo.dot(half) * half - wo;
  }

 private:
  /// D of the half vector along sum = wi + wo.
  [[nodiscard]] double normals(const Vec3& sum) const {
    const double area = alpha_x_ * alpha_y_;
    const double ratio_xy = alpha_y_ / alpha_x_;
    const double spread = ratio_xy * (sum.x() * sum.x()) + sum.y() * sum.y() / ratio_xy + area * (sum.z() * sum.z());
    const double ratio = sum.squaredNorm() / spread;
    return area * std::numbers::inv_pi * ratio * ratio;
  }

  /// l of the unit vector w.
  [[nodiscard]] double stretch(const Vec3& w) const {
    const double x = alpha_x_ * w.x();
    const double y = alpha_y_ * w.y();
    return std::sqrt(x * x + y * y + w.z() * w.z());
  }

  Rgb f0_;
  double alpha_x_, alpha_y_;
};

namespace analytic::ggx {

inline AnalyticInfo info() {
  return {.name = "ggx",
          .title = "GGX",
          .source = "Walter et al. 2007, eq. 33; Heitz 2014, eq. 99; Schlick 1994",
          .parameters = {{"f0", Ggx::kF0, 0.5, true}, {"alpha", Ggx::kAlpha, 0.3, false, SearchScale::logarithmic}},
          .examples = {{0.04, 0.5, 1, 0.02}, {0.04, 0.5, 1, 0.1}, {0.04, 0.5, 1, 0.4}, {0, 0, 0, 1}},
          .make_unchecked = [](const AnalyticValues& v) { return std::make_shared<const Ggx>(rgb_at(v, 0), v[3]); }};
}

}  // namespace analytic::ggx
}  // namespace sklar::brdf
