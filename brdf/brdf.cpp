#include "brdf/brdf.hpp"

#include <numbers>
#include <stdexcept>

namespace sklar::brdf {

RgbRows Brdf::eval_rows(const DirectionsRef& wo, const DirectionsRef& wi) const {
  if (wo.rows() != wi.rows()) {
    throw std::invalid_argument("eval: wo has " + std::to_string(wo.rows()) + " rows, wi has " +
                                std::to_string(wi.rows()) + "; they must agree");
  }
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
