#pragma once
/// The Cook-Torrance model: V-grooves whose facets have Beckmann's distribution, with the Fresnel term of fresnel.hpp.
///
///     f_r = diffuse / pi + F D G / (4 cos_i cos_o)
///     D = exp(-tan^2(theta_h) / m^2) / (pi m^2 cos^4(theta_h))                 Walter et al. 2007, eq. 25
///     G = min(1, 2 cos(theta_h) cos_o / (h.wo), 2 cos(theta_h) cos_i / (h.wo)) Torrance and Sparrow 1967; Blinn 1977
///
/// Cook and Torrance 1982, "A Reflectance Model for Computer Graphics", print D without pi and pi for the 4; here D is
/// normalised, so that the projected area of the facets is that of the surface.
///
/// With a = wi + wo, cos(theta_h) / (h.wo) = 2 a_z / |a|^2 and
///     G / (4 cos_i cos_o) = min(1 / (4 cos_i cos_o), a_z / |a|^2 / max(cos_i, cos_o)).
/// Draws of h follow D cos(theta_h): tan^2(theta_h) = -m^2 log(u), pdf(wi) = D cos(theta_h) / (4 (h.wo)), less those
/// below the horizon. The lobe's albedo is at most 1: G is at most the masking of wo alone, with which the facets that
/// wo sees have the projected area cos_o (Heitz 2014, section 3). f_r and pdf have no bound where both directions graze
/// opposite each other and end at kLargest, which takes cosines below 1e-94.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/analytic/check.hpp"
#include "brdf/analytic/fresnel.hpp"
#include "brdf/analytic/info.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/sum.hpp"

namespace sklar::brdf {

class CookTorranceLobe final : public Brdf {
 public:
  static constexpr Interval kF0{0, 1};
  static constexpr Interval kRoughness{1e-6, 1};
  static constexpr double kLargest = 1e200;

  /// @param f0 reflectance at normal incidence, each channel in [0,1]. @param roughness m, root mean square slope of
  /// the facets, in [1e-6,1]. @throws std::domain_error otherwise.
  CookTorranceLobe(const Rgb& f0, double roughness) : root_f0_(f0.sqrt()), roughness_(roughness) {
    require_inside("CookTorranceLobe", "f0", kF0, f0);
    require_inside("CookTorranceLobe", "roughness", kRoughness, roughness);
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
    const Vec3 sum = wi + wo;
    const double facets = normals(sum);
    if (facets == 0) return Rgb::Zero();
    const double length = std::hypot(sum.x(), sum.y(), sum.z());
    const auto [low, high] = std::minmax({wo.z(), wi.z()});
    const double geometry = std::min(0.25 / high / low, sum.z() / length / length / high);
    return dielectric_fresnel(root_f0_, 0.5 * length) * std::min(facets * geometry, kLargest);
  }

  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return 0;
    const Vec3 sum = wi + wo;
    const double facets = normals(sum);
    if (facets == 0) return 0;
    const double length = std::hypot(sum.x(), sum.y(), sum.z());
    return std::min(0.5 * facets * (sum.z() / length) / length, kLargest);
  }

  [[nodiscard]] Traits traits() const override { return {.albedo_bound = 1.0}; }
  [[nodiscard]] std::size_t bytes() const override { return sizeof root_f0_ + sizeof roughness_; }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override {
    const double slope = roughness_ * std::sqrt(-std::log(uniforms.x()));
    const double phi = 2 * std::numbers::pi * uniforms.y();
    const Vec3 half = Vec3(slope * std::cos(phi), slope * std::sin(phi), 1).normalized();
    return 2 * wo.dot(half) * half - wo;
  }

 private:
  /// D of the half vector along sum = wi + wo.
  [[nodiscard]] double normals(const Vec3& sum) const {
    const double x = sum.x() / sum.z();
    const double y = sum.y() / sum.z();
    const double square = x * x + y * y;
    const double area = roughness_ * roughness_;
    const double exponential = std::exp(-square / area);
    if (exponential == 0) return 0;  // 1 / cos^4 may be infinite there
    return exponential * std::numbers::inv_pi / area * ((1 + square) * (1 + square));
  }

  Rgb root_f0_;
  double roughness_;
};

namespace analytic::cook_torrance {

inline AnalyticInfo info() {
  return {.name = "cook_torrance",
          .title = "Cook-Torrance",
          .source = "Cook and Torrance 1982; Walter et al. 2007, eq. 25",
          .parameters = {{"diffuse", Lambert::kAlbedo, 0.2, true},
                         {"f0", CookTorranceLobe::kF0, 0.5, true},
                         {"roughness", CookTorranceLobe::kRoughness, 0.3, false, SearchScale::logarithmic}},
          .examples = {{0, 0, 0, 0.04, 0.5, 1, 0.03},
                       {0.3, 0.2, 0.1, 0.04, 0.04, 0.04, 0.15},
                       {0, 0, 0, 0.9, 0.6, 0.3, 0.5},
                       {0.5, 0.5, 0.5, 0, 0, 0, 1}},
          .make_unchecked = [](const AnalyticValues& v) {
            const Rgb f0 = rgb_at(v, 3);
            return with_diffuse(rgb_at(v, 0), std::make_shared<const CookTorranceLobe>(f0, v[6]), f0);
          }};
}

}  // namespace analytic::cook_torrance
}  // namespace sklar::brdf
