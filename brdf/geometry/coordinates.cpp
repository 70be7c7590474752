#include "brdf/geometry/coordinates.hpp"

#include <cmath>
#include <numbers>

#include "brdf/geometry/frame.hpp"

namespace sklar::brdf {

HalfDifference half_difference(const Vec3& wo, const Vec3& wi) {
  // Exchanging wo and wi leaves `sum` and negates `difference`, exactly; folding takes the sign out again.
  const Vec3 sum = wi + wo;
  const Vec3 difference = wi - wo;
  const double radius = std::sqrt(sum.x() * sum.x() + sum.y() * sum.y());
  const double length = sum.norm();
  const double cos_phi_h = radius > 0 ? sum.x() / radius : 1.0;
  const double sin_phi_h = radius > 0 ? sum.y() / radius : 0.0;

  const double radial = cos_phi_h * difference.x() + sin_phi_h * difference.y();
  double x = (sum.z() * radial - radius * difference.z()) / length;
  double y = cos_phi_h * difference.y() - sin_phi_h * difference.x();
  if (y < 0 || (y == 0 && x < 0)) {
    x = -x;
    y = -y;
  }
  const double phi_d = std::atan2(std::abs(y), x);
  return {.theta_h = std::atan2(radius, sum.z()),
          .theta_d = std::atan2(difference.norm(), length),
          .phi_d = phi_d < std::numbers::pi ? phi_d : 0.0};
}

DirectionPair directions(const HalfDifference& coordinates) {
  const Vec3 wi = spherical_direction(coordinates.theta_d, coordinates.phi_d);
  const Vec3 wo(-wi.x(), -wi.y(), wi.z());
  return {.wi = rotate_about_y(wi, coordinates.theta_h), .wo = rotate_about_y(wo, coordinates.theta_h)};
}

HalfDifference4 half_difference4(const Vec3& wo, const Vec3& wi) {
  const auto [theta_h, theta_d, phi_d] = half_difference(wo, wi);
  const Vec3 sum = wi + wo;
  const double phi = sum.x() == 0 && sum.y() == 0 ? 0.0 : std::atan2(sum.y(), sum.x());
  const double turned = phi < 0 ? phi + 2 * std::numbers::pi : phi;
  return {
      .theta_h = theta_h, .phi_h = turned < 2 * std::numbers::pi ? turned : 0.0, .theta_d = theta_d, .phi_d = phi_d};
}

DirectionPair directions4(const HalfDifference4& coordinates) {
  const DirectionPair pair = directions(HalfDifference{coordinates.theta_h, coordinates.theta_d, coordinates.phi_d});
  const double c = std::cos(coordinates.phi_h);
  const double s = std::sin(coordinates.phi_h);
  const auto turn = [&](const Vec3& w) { return Vec3(c * w.x() - s * w.y(), s * w.x() + c * w.y(), w.z()); };
  return {.wi = turn(pair.wi), .wo = turn(pair.wo)};
}

}  // namespace sklar::brdf
