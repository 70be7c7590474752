#include "brdf/brdf.hpp"

#include <numbers>
#include <stdexcept>

namespace sklar::brdf {

namespace {

void require_rows(const char* function, Eigen::Index wo, const char* other, Eigen::Index rows) {
  if (wo == rows) return;
  throw std::invalid_argument(std::string(function) + ": wo has " + std::to_string(wo) + " rows, " + other + " has " +
                              std::to_string(rows) + "; they must agree");
}

}  // namespace

RgbRows Brdf::eval_rows(const DirectionsRef& wo, const DirectionsRef& wi) const {
  require_rows("eval", wo.rows(), "wi", wi.rows());
  RgbRows out(wo.rows(), 3);
  eval_batch(wo, wi, out);
  return out;
}

void Brdf::eval_batch(const DirectionsRef& wo, const DirectionsRef& wi, Eigen::Ref<RgbRows> out) const {
  for (Eigen::Index row = 0; row < wo.rows(); ++row) {
    out.row(row) = eval(Vec3(wo.row(row).transpose()), Vec3(wi.row(row).transpose())).transpose();
  }
}

double Brdf::pdf(const Vec3& wo, const Vec3& wi) const {
  return wo.z() > 0 && wi.z() > 0 ? wi.z() * std::numbers::inv_pi : 0.0;
}

Sample Brdf::sample(const Vec3& wo, const Vec2& uniforms) const {
  const auto [wi, density] = draw(wo, uniforms);
  if (!(density > 0)) return {wi, density, Rgb::Zero()};
  return {wi, density, eval(wo, wi) * (wi.z() / density)};
}

Samples Brdf::sample_rows(const DirectionsRef& wo, const UniformsRef& uniforms) const {
  require_rows("sample", wo.rows(), "uniforms", uniforms.rows());
  Samples samples{Directions(wo.rows(), 3), Eigen::ArrayXd(wo.rows()), RgbRows(wo.rows(), 3)};
  draw_batch(wo, uniforms, samples);
  eval_batch(wo, samples.wi, samples.weight);
  for (Eigen::Index row = 0; row < wo.rows(); ++row) {
    const double density = samples.pdf(row);
    samples.weight.row(row) *= density > 0 ? samples.wi(row, 2) / density : 0;
  }
  return samples;
}

void Brdf::draw_batch(const DirectionsRef& wo, const UniformsRef& uniforms, Samples& out) const {
  for (Eigen::Index row = 0; row < wo.rows(); ++row) {
    const Draw one = draw(wo.row(row).transpose(), uniforms.row(row).transpose());
    out.wi.row(row) = one.wi.array().transpose();
    out.pdf(row) = one.pdf;
  }
}

Draw Brdf::draw(const Vec3& wo, const Vec2& uniforms) const {
  const Vec3 wi = sample_direction(wo, uniforms);
  return {wi, pdf(wo, wi)};
}

Vec3 Brdf::sample_direction(const Vec3& /*wo*/, const Vec2& uniforms) const {
  const double radius = std::sqrt(uniforms.x());
  const double phi = 2 * std::numbers::pi * uniforms.y();
  return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1 - uniforms.x())};
}

}  // namespace sklar::brdf
