#pragma once
/// The microfacet generator of Ashikhmin, Premoze and Shirley: a reflectance from any density of half vectors.
///
///     f_r = diffuse / pi + p(h) g(n) F / (4 g(wi) g(wo)),    g(k) = integral of max(0, h.k) p(h) dh
///     F = f0 + (1 - f0) (1 - cos(theta_d))^5                                                   Schlick 1994
///
/// Ashikhmin, Premoze and Shirley 2000, "A Microfacet-based BRDF Generator", with no correlation between what the two
/// directions see. p(h) is a density of facet normals per solid angle, of integral 1. A plane of unit area has facets
/// of area 1 / g(n); those that a direction k sees must show it the area cos(k), whatever their normal the share
/// G1(k) = cos(k) g(n) / g(k) <= 1 of them, and f_r = F p / g(n) G1(wi) G1(wo) / (4 cos_i cos_o). With p of GGX that is
/// Smith's masking without height correlation.
///
/// Draws of h follow p: pdf(wi) = p(h) / (4 (h.wo)), less those below the horizon. The albedo of the lobe is at most
/// the largest F: it is the mean of F G1(wi) over the facets that wo sees. f_r is finite, but pdf has no bound where
/// both directions graze opposite each other and ends at power_lobe::kLargest.
///
/// The registered form mixes two densities, each of integral 1 and drawn in closed form: of slopes that are normal, as
/// on polished surfaces, and of facets that stand upright, as the fibres of a cloth,
///
///     p = (1 - velvet) exp(-tan^2(theta_h) / m^2) / (pi m^2 cos^3(theta_h))
///         + velvet exp(-cos(theta_h) / s) / (2 pi s (1 - exp(-1 / s)))

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "brdf/analytic/check.hpp"
#include "brdf/analytic/fresnel.hpp"
#include "brdf/analytic/half_vector_density.hpp"
#include "brdf/analytic/info.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/power_lobe.hpp"
#include "brdf/analytic/sum.hpp"

namespace sklar::brdf {

class AshikhminPremozeShirleyLobe final : public Brdf {
 public:
  static constexpr Interval kF0{0, 1};

  /// @param f0 reflectance at normal incidence, each channel in [0,1]; std::domain_error otherwise.
  /// @param density not null; std::invalid_argument otherwise.
  AshikhminPremozeShirleyLobe(const Rgb& f0, std::shared_ptr<const HalfVectorDensity> density)
      : f0_(f0), density_(require(std::move(density))), area_(*density_) {
    require_inside("AshikhminPremozeShirleyLobe", "f0", kF0, f0);
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
    const Vec3 sum = wi + wo;
    const double length = std::hypot(sum.x(), sum.y(), sum.z());
    const Rgb fresnel = schlick_fresnel(f0_, wo, wi, length);
    const double masking = area_(wi.z()) * area_(wo.z());
    return fresnel * (0.25 * area_.of_normal() * (*density_)(of_half(sum, length)) / masking);
  }

  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return 0;
    const Vec3 sum = wi + wo;
    const double length = std::hypot(sum.x(), sum.y(), sum.z());
    return std::min(0.5 * (*density_)(of_half(sum, length)) / length, power_lobe::kLargest);
  }

  [[nodiscard]] Traits traits() const override { return {.albedo_bound = 1.0}; }
  [[nodiscard]] std::size_t bytes() const override { return sizeof f0_ + density_->bytes() + area_.bytes(); }

  /// The mean of F over the cosine hemisphere, to weigh draws by.
  [[nodiscard]] Rgb strength() const { return mean_schlick_fresnel(f0_); }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override {
    const double versine = density_->draw(uniforms.x());
    const double sine = std::sqrt(versine * (2 - versine));
    const double phi = 2 * std::numbers::pi * uniforms.y();
    const Vec3 half(sine * std::cos(phi), sine * std::sin(phi), 1 - versine);
    return 2 * wo.dot(half) * half - wo;
  }

 private:
  /// 1 - cos(theta_h) of the half vector along sum.
  [[nodiscard]] static double of_half(const Vec3& sum, double length) {
    return (sum.x() * sum.x() + sum.y() * sum.y()) / length / (length + sum.z());
  }

  [[nodiscard]] static std::shared_ptr<const HalfVectorDensity> require(std::shared_ptr<const HalfVectorDensity> p) {
    if (!p) throw std::invalid_argument("AshikhminPremozeShirleyLobe: needs a density");
    return p;
  }

  Rgb f0_;
  std::shared_ptr<const HalfVectorDensity> density_;
  FacetArea area_;
};

/// The density of the registered form.
class VelvetDensity final : public HalfVectorDensity {
 public:
  static constexpr Interval kRoughness{0.02, 1};
  static constexpr Interval kVelvet{0, 1};
  static constexpr Interval kVelvetWidth{0.02, 10};

  /// @param roughness m, root mean square slope, in [0.02,1]. @param velvet share of upright facets in [0,1].
  /// @param velvet_width s in [0.02,10]. @throws std::domain_error otherwise.
  VelvetDensity(double roughness, double velvet, double velvet_width)
      : area_(roughness * roughness),
        velvet_(velvet),
        width_(velvet_width),
        drop_(-std::expm1(-1 / velvet_width)),
        flat_scale_((1 - velvet) * std::numbers::inv_pi / area_),
        velvet_scale_(0.5 * velvet * std::numbers::inv_pi / (width_ * drop_)) {
    require_inside("VelvetDensity", "roughness", kRoughness, roughness);
    require_inside("VelvetDensity", "velvet", kVelvet, velvet);
    require_inside("VelvetDensity", "velvet_width", kVelvetWidth, velvet_width);
  }

  [[nodiscard]] double operator()(double versine) const override {
    const double cosine = 1 - versine;
    const double exponential = std::exp(-versine * (2 - versine) / (cosine * cosine) / area_);
    const double flat = exponential > 0 ? exponential / (cosine * cosine * cosine) : 0;  // not 0 times infinity
    return flat_scale_ * flat + velvet_scale_ * std::exp(-cosine / width_);
  }

  [[nodiscard]] double draw(double uniform) const override {
    // The uniform chooses and is stretched over (0,1] again.
    if (uniform <= velvet_) return 1 + width_ * std::log1p(-drop_ * (uniform / velvet_));
    const double square = -area_ * std::log((1 - uniform) / (1 - velvet_));  // tan^2
    const double secant = std::sqrt(1 + square);
    return std::isfinite(square) ? square / (secant * (1 + secant)) : 1;
  }

  /// Finer toward the normal.
  [[nodiscard]] std::vector<double> nodes() const override {
    constexpr int kNodes = 129;
    std::vector<double> result;
    for (int n = 0; n < kNodes; ++n) {
      const double share = static_cast<double>(n) / (kNodes - 1);
      const double sine = std::sin(std::numbers::pi / 4 * share * share * share);
      result.push_back(2 * sine * sine);
    }
    return result;
  }

  [[nodiscard]] std::size_t bytes() const override { return 6 * sizeof(double); }

 private:
  double area_, velvet_, width_;
  double drop_;  ///< 1 - exp(-1 / s)
  double flat_scale_, velvet_scale_;
};

namespace analytic::ashikhmin_premoze_shirley {

inline AnalyticInfo info() {
  return {.name = "ashikhmin_premoze_shirley",
          .title = "Ashikhmin-Premoze-Shirley",
          .source = "Ashikhmin, Premoze and Shirley 2000, A Microfacet-based BRDF Generator; Schlick 1994",
          .parameters = {{"diffuse", Lambert::kAlbedo, 0.2, true},
                         {"f0", AshikhminPremozeShirleyLobe::kF0, 0.1, true},
                         {"roughness", VelvetDensity::kRoughness, 0.3, false, SearchScale::logarithmic},
                         {"velvet", VelvetDensity::kVelvet, 0.2},
                         {"velvet_width", VelvetDensity::kVelvetWidth, 0.3, false, SearchScale::logarithmic}},
          .examples = {{0, 0, 0, 0.04, 0.5, 1, 0.1, 0, 0.5},
                       {0.2, 0.1, 0, 0.1, 0.1, 0.1, 0.4, 0.5, 0.2},
                       {0, 0, 0, 0.5, 0, 1, 1, 1, 1}},
          .make_unchecked = [](const AnalyticValues& v) {
            auto lobe = std::make_shared<const AshikhminPremozeShirleyLobe>(
                rgb_at(v, 3), std::make_shared<const VelvetDensity>(v[6], v[7], v[8]));
            const Rgb strength = lobe->strength();
            return with_diffuse(rgb_at(v, 0), std::move(lobe), strength);
          }};
}

}  // namespace analytic::ashikhmin_premoze_shirley
}  // namespace sklar::brdf
