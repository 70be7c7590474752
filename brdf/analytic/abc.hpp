#pragma once
/// Low's ABC model, the form for smooth surfaces.
///
///     f_r = diffuse / pi + F(theta_d) a / (1 + b |D|^2)^c,    D = wi + wo projected onto the surface
///     cos(theta_d) = sqrt(1 - |wi - wo projected|^2 / 4)
///
/// Low, Kronander, Ynnerman and Unger 2012, "BRDF Models for Accurate and Efficient Rendering of Glossy Surfaces", ACM
/// TOG 31(1); F as in fresnel.hpp for an index of refraction eta. The lobe is that of scattering by
/// a surface with the spectrum a / (1 + b f^2)^c of heights, without the obliquity factor of Rayleigh and Rice.
///
/// With q = |D|^2: cos^2(theta_d) = (cos_i^2 + cos_o^2) / 2 + q / 4, no term of which is negative, and with
/// L = log(1 + b q) and k = 1 - c the integral of (1 + b q)^-c from 0 to q is (e^(k L) - 1) / (k b), or L / b for k =
/// 0, whose inverse is closed too. Draws of the projection of wi follow (1 + b q)^-c on the disk about that of -wo that
/// reaches round the horizon, |D| <= 1 + sin(theta_o), with azimuth 2 pi v; with I the integral up to there
///     pdf(wi) = cos_i (1 + b q)^-c / (pi I),
/// less those outside the horizon, and f cos_i / pdf of the lobe is pi a F I. Its albedo is at most pi a times the
/// integral up to q = 1: the lobe and the unit disk overlap most when they have one centre. With `a` free that may be
/// any number.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/analytic/check.hpp"
#include "brdf/analytic/fresnel.hpp"
#include "brdf/analytic/info.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/sum.hpp"

namespace sklar::brdf {

class AbcLobe final : public Brdf {
 public:
  static constexpr Interval kA{0, 1e6};
  static constexpr Interval kB{1e-6, 1e6};
  static constexpr Interval kC{0, 10};
  static constexpr Interval kEta{1, 100};

  /// @param a value of the lobe at its peak before the Fresnel term, 1/sr, each channel in [0,1e6]. @param b inverse
  /// square of its width in [1e-6,1e6]. @param c fall-off in [0,10]. @param eta index of refraction in [1,100].
  /// @throws std::domain_error otherwise.
  AbcLobe(const Rgb& a, double b, double c, double eta)
      : a_(a), b_(b), c_(c), root_f0_(Rgb::Constant((eta - 1) / (eta + 1))) {
    require_inside("AbcLobe", "a", kA, a);
    require_inside("AbcLobe", "b", kB, b);
    require_inside("AbcLobe", "c", kC, c);
    require_inside("AbcLobe", "eta", kEta, eta);
  }

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
    const double square = (wi + wo).head<2>().squaredNorm();
    const auto [low, high] = std::minmax({wo.z(), wi.z()});
    const double cosine = std::hypot(std::sqrt(0.5) * low, std::sqrt(0.5) * high, 0.5 * std::sqrt(square));
    return a_ * dielectric_fresnel(root_f0_, cosine) * shape(square);
  }

  [[nodiscard]] double pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return 0;
    return wi.z() * std::numbers::inv_pi * shape((wi + wo).head<2>().squaredNorm()) / integral(reach(wo));
  }

  [[nodiscard]] Traits traits() const override {
    return {.albedo_bound = std::numbers::pi * a_.maxCoeff() * integral(1)};
  }
  [[nodiscard]] std::size_t bytes() const override { return sizeof a_ + sizeof b_ + sizeof c_ + sizeof(double); }

  /// Albedo at normal incidence with the Fresnel term of the normal, to weigh draws by.
  [[nodiscard]] Rgb strength() const { return a_ * root_f0_.square() * (std::numbers::pi * integral(1)); }

 protected:
  [[nodiscard]] Vec3 sample_direction(const Vec3& wo, const Vec2& uniforms) const override {
    const double k = 1 - c_;
    const double whole = std::log1p(b_ * reach(wo));
    const double drawn =
        k == 0 ? uniforms.x() * whole : std::log1p(uniforms.x() * std::expm1(k * whole)) / k;  // log(1 + b q)
    const double radius = std::sqrt(std::expm1(drawn) / b_);
    const double phi = 2 * std::numbers::pi * uniforms.y();
    const Vec2 across = radius * Vec2(std::cos(phi), std::sin(phi)) - wo.head<2>();
    const double square = 1 - across.squaredNorm();
    return square > 0 ? Vec3(across.x(), across.y(), std::sqrt(square)) : Vec3(0, 0, -1);
  }

 private:
  /// The lobe at q over that at 0.
  [[nodiscard]] double shape(double square) const { return std::exp(-c_ * std::log1p(b_ * square)); }

  /// Of the shape over q from 0.
  [[nodiscard]] double integral(double square) const {
    const double log = std::log1p(b_ * square);
    const double scaled = (1 - c_) * log;
    return (scaled == 0 ? 1.0 : std::expm1(scaled) / scaled) * log / b_;
  }

  /// The largest q of any wi.
  [[nodiscard]] static double reach(const Vec3& wo) {
    const double radius = 1 + wo.head<2>().norm();
    return radius * radius;
  }

  Rgb a_;
  double b_, c_;
  Rgb root_f0_;
};

namespace analytic::abc {

inline AnalyticInfo info() {
  return {.name = "abc",
          .title = "Low (ABC, smooth surface)",
          .source = "Low et al. 2012, smooth surfaces; Cook and Torrance 1982",
          .parameters = {{"diffuse", Lambert::kAlbedo, 0.2, true},
                         {"a", AbcLobe::kA, 50, true},
                         {"b", AbcLobe::kB, 1000, false, SearchScale::logarithmic},
                         {"c", AbcLobe::kC, 1.5},
                         {"eta", AbcLobe::kEta, 1.5, false, SearchScale::logarithmic}},
          .examples = {{0, 0, 0, 100, 200, 400, 2000, 2, 1.5},
                       {0.3, 0.2, 0.1, 50, 50, 40, 1000, 1, 1.5},
                       {0.1, 0.1, 0.1, 1, 1, 0, 10, 0.5, 10},
                       {0.2, 0, 0, 0.3, 0.3, 0.3, 1, 4, 1}},
          .make_unchecked = [](const AnalyticValues& v) {
            auto lobe = std::make_shared<const AbcLobe>(rgb_at(v, 3), v[6], v[7], v[8]);
            const Rgb strength = lobe->strength();
            return with_diffuse(rgb_at(v, 0), std::move(lobe), strength);
          }};
}

}  // namespace analytic::abc
}  // namespace sklar::brdf
