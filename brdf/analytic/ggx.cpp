#include "brdf/analytic/ggx.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "brdf/analytic/check.hpp"
#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

constexpr double kSmallestAlpha = 1e-6;  // unit vectors in double leave ten digits of a slope of this size

}  // namespace

Ggx::Ggx(const Rgb& f0, double alpha) : f0_(f0), alpha_(alpha) {
  require_unit_rgb("Ggx", "f0", f0);
  if (!(alpha >= kSmallestAlpha && alpha <= 1)) {
    throw std::domain_error("Ggx: alpha must be in [" + to_text(kSmallestAlpha) + ",1], got " + to_text(alpha));
  }
}

Rgb Ggx::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  const auto [low, high] = std::minmax({wo.z(), wi.z()});  // one order for both (wo, wi) and (wi, wo)
  const Vec3 sum = wi + wo;
  const double versine = 0.25 * (wi - wo).squaredNorm() / (1 + 0.5 * sum.norm());
  const double square = versine * versine;
  const Rgb fresnel = f0_ + (1 - f0_) * (square * square * versine);
  return fresnel * (normals(sum) / (2 * (low * slope_length(high) + high * slope_length(low))));
}

double Ggx::pdf(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return 0;
  return normals(wi + wo) / (2 * (wo.z() + slope_length(wo.z())));
}

Vec3 Ggx::sample_direction(const Vec3& wo, const Vec2& uniforms) const {
  const Vec3 stretched = Vec3(alpha_ * wo.x(), alpha_ * wo.y(), wo.z()).normalized();
  // A point of the spherical cap z in [-stretched.z, 1]; 1 - z is drawn, so that the sine does not cancel.
  const double fall = uniforms.y() * (1 + stretched.z());
  const double sine = std::sqrt(fall * (2 - fall));
  const double phi = 2 * std::numbers::pi * uniforms.x();
  const Vec3 cap = Vec3(sine * std::cos(phi), sine * std::sin(phi), 1 - fall) + stretched;
  const Vec3 half = Vec3(alpha_ * cap.x(), alpha_ * cap.y(), cap.z()).normalized();
  return 2 * wo.dot(half) * half - wo;
}

double Ggx::normals(const Vec3& sum) const {
  const double square = alpha_ * alpha_;
  const double spread = sum.x() * sum.x() + sum.y() * sum.y() + square * sum.z() * sum.z();
  const double ratio = sum.squaredNorm() / spread;
  return square * std::numbers::inv_pi * ratio * ratio;
}

double Ggx::slope_length(double cosine) const {
  const double square = alpha_ * alpha_;
  return std::sqrt(square + (1 - square) * cosine * cosine);
}

}  // namespace sklar::brdf
