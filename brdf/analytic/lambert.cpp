#include "brdf/analytic/lambert.hpp"

#include <numbers>

#include "brdf/analytic/check.hpp"

namespace sklar::brdf {

Lambert::Lambert(const Rgb& albedo) : value_(albedo * std::numbers::inv_pi) {
  require_unit_rgb("Lambert", "albedo", albedo);
}

Rgb Lambert::eval(const Vec3& wo, const Vec3& wi) const {
  return wo.z() > 0 && wi.z() > 0 ? value_ : Rgb(Rgb::Zero());
}

Traits Lambert::traits() const {
  return {.albedo_bound = value_.maxCoeff() * std::numbers::pi};
}

}  // namespace sklar::brdf
