#pragma once
/// The anisotropic Phong model of Ashikhmin and Shirley, with its own diffuse term.
///
///     f_r = 28 diffuse / (23 pi) (1 - specular) (1 - (1 - cos_i/2)^5) (1 - (1 - cos_o/2)^5)
///           + sqrt((n_u + 1) (n_v + 1)) / (8 pi) cos^e(theta_h) F / ((h.wi) max(cos_i, cos_o))
///     e = n_u cos^2(phi_h) + n_v sin^2(phi_h),    F = specular + (1 - specular) (1 - h.wi)^5
///
/// Ashikhmin and Shirley 2000, "An Anisotropic Phong BRDF Model", journal of graphics tools 5(2). Draws as there: phi_h
/// with tan(phi_h) = sqrt((n_u + 1) / (n_v + 1)) tan(2 pi v), cos(theta_h) = u^(1 / (e + 1)), which makes
///     pdf(wi) = sqrt((n_u + 1) (n_v + 1)) / (2 pi) cos^e(theta_h) / (4 (h.wi)),
/// mixed with the cosine for the diffuse term; those below the horizon are lost.
///
/// f cos_i / pdf of the specular term is F cos_i / max(cos_i, cos_o) <= 1, and the diffuse term reflects
/// diffuse (1 - specular) (1 - (1 - cos_o/2)^5) <= 31/32 diffuse (1 - specular): the sum of both bounds is what traits
/// claim (by quadrature they reflect at most 1 together). Where both directions graze opposite each other the
/// specular term and its density have no bound and end at power_lobe::kLargest, which takes cosines below 1e-97.
///
/// 1 - (1 - x)^5 is written as x (5 - x (10 - ...)), whose partial results are positive for x <= 1/2; 1 - h.wi is
/// |wi - wo|^2 / 4 / (1 + |wi + wo|/2).

#include "brdf/analytic/check.hpp"
#include "brdf/analytic/fresnel.hpp"
#include "brdf/analytic/info.hpp"
#include "brdf/analytic/power_lobe.hpp"

namespace sklar::brdf {

class AshikhminShirley final : public Brdf {
 public:
  static constexpr Interval kReflectance{0, 1};
  static constexpr Interval kExponent{0, 1e6};

  /// @param diffuse, specular reflectances, each channel in [0,1]; specular at normal incidence.
  /// @param exponent_u, exponent_v n along x and y, each in [0,1e6]. @throws std::domain_error otherwise.
  AshikhminShirley(const Rgb& diffuse, const Rgb& specular, double exponent_u, double exponent_v)
      : diffuse_(diffuse), specular_(specular), exponent_u_(exponent_u), exponent_v_(exponent_v) {
    require_inside("AshikhminShirley", "diffuse", kReflectance, diffuse);
    require_inside("AshikhminShirley", "specular", kReflectance, specular);
    require_inside("AshikhminShirley", "exponent_u", kExponent, exponent_u);
    require_inside("AshikhminShirley", "exponent_v", kExponent, exponent_v);
    const double below = (diffuse * (1 - specular)).mean();
    share_ = below / (below + kMeanSchlick + (1 - kMeanSchlick) * specular.mean());
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
    const Vec3 sum = wi + wo;
    const double length = std::hypot(sum.x(), sum.y(), sum.z());
    const Rgb fresnel = schlick_fresnel(specular_, wo, wi, length);
    const double glossy = 0.5 * normals(sum, length) / length / std::max(wi.z(), wo.z());
    const Rgb below = diffuse_ * (1 - specular_) * (28 * std::numbers::inv_pi / 23 * (shade(wi.z()) * shade(wo.z())));
    return below + fresnel * std::min(glossy, power_lobe::kLargest);
  }

  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return 0;
    const Vec3 sum = wi + wo;
    const double length = std::hypot(sum.x(), sum.y(), sum.z());
    const double glossy = std::min(0.5 * normals(sum, length) / length, power_lobe::kLargest);
    return share_ * Brdf::pdf(wo, wi) + (1 - share_) * glossy;
  }

  [[nodiscard]] Traits traits() const override {
    return {.isotropic = exponent_u_ == exponent_v_,
            .albedo_bound = 1 + 31.0 / 32 * (diffuse_ * (1 - specular_)).maxCoeff()};
  }
  [[nodiscard]] std::size_t bytes() const override {
    return sizeof diffuse_ + sizeof specular_ + sizeof share_ + (exponent_u_ == exponent_v_ ? 1 : 2) * sizeof(double);
  }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override {
    // The first uniform chooses and is stretched over (0,1] again.
    if (uniforms.x() < share_) return Brdf::sample_direction(wo, {uniforms.x() / share_, uniforms.y()});
    const double angle = 2 * std::numbers::pi * uniforms.y();
    const Vec2 across =
        Vec2(std::sqrt(exponent_v_ + 1) * std::cos(angle), std::sqrt(exponent_u_ + 1) * std::sin(angle)).normalized();
    const double exponent = exponent_u_ * (across.x() * across.x()) + exponent_v_ * (across.y() * across.y());
    const double log_cosine = std::log((1 - uniforms.x()) / (1 - share_)) / (exponent + 1);
    const double sine = std::sqrt(-std::expm1(2 * log_cosine));
    const Vec3 half(sine * across.x(), sine * across.y(), std::exp(log_cosine));
    return 2 * wo.dot(half) * half - wo;
  }

 private:
  static constexpr double kMeanSchlick = 1.0 / 21;  ///< the mean of (1 - cos)^5 over the cosine, the weight of F there

  /// 1 - (1 - cosine/2)^5.
  [[nodiscard]] static double shade(double cosine) {
    const double x = 0.5 * cosine;
    return x * (5 - x * (10 - x * (10 - x * (5 - x))));
  }

  /// Density of the half vector along sum, per solid angle.
  [[nodiscard]] double normals(const Vec3& sum, double length) const {
    const double xx = sum.x() * sum.x();
    const double yy = sum.y() * sum.y();
    const double exponent = xx + yy > 0 ? (exponent_u_ * xx + exponent_v_ * yy) / (xx + yy) : 0.0;
    const double norm = 0.5 * std::numbers::inv_pi * std::sqrt((exponent_u_ + 1) * (exponent_v_ + 1));
    return norm * power_lobe::half_power(sum, length, exponent);
  }

  Rgb diffuse_, specular_;
  double exponent_u_, exponent_v_;
  double share_;  ///< of the draws that follow the cosine
};

namespace analytic::ashikhmin_shirley {

inline AnalyticInfo info() {
  return {
      .name = "ashikhmin_shirley",
      .title = "Ashikhmin-Shirley",
      .source = "Ashikhmin and Shirley 2000; Schlick 1994",
      .parameters = {{"diffuse", AshikhminShirley::kReflectance, 0.2, true},
                     {"specular", AshikhminShirley::kReflectance, 0.2, true},
                     {"exponent_u", AshikhminShirley::kExponent, 100, false, SearchScale::logarithmic},
                     {"exponent_v", AshikhminShirley::kExponent, 100, false, SearchScale::logarithmic, "exponent_u"}},
      .examples = {{0, 0, 0, 0.2, 0.5, 1, 500, 500},
                   {0.5, 0.3, 0.1, 0.05, 0.05, 0.05, 10, 1000},
                   {1, 0, 0.5, 0, 0.5, 0.3, 30, 5},
                   {0, 0, 0, 0, 0, 0, 0, 0}},
      .make_unchecked = [](const AnalyticValues& v) {
        return std::make_shared<const AshikhminShirley>(rgb_at(v, 0), rgb_at(v, 3), v[6], v[7]);
      }};
}

}  // namespace analytic::ashikhmin_shirley
}  // namespace sklar::brdf
