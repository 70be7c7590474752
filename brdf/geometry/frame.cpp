#include "brdf/geometry/frame.hpp"

#include <cmath>

namespace sklar::brdf {

Vec3 spherical_direction(double theta, double phi) {
  const double sine = std::sin(theta);
  return {sine * std::cos(phi), sine * std::sin(phi), std::cos(theta)};
}

double polar_angle(const Vec3& w) {
  return std::atan2(std::sqrt(w.x() * w.x() + w.y() * w.y()), w.z());
}

Vec3 rotate_about_y(const Vec3& w, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * w.x() + s * w.z(), w.y(), c * w.z() - s * w.x()};
}

Frame::Frame(const Vec3& normal) : normal_(normal) {
  const double sign = std::copysign(1.0, normal.z());
  const double a = -1 / (sign + normal.z());
  const double b = normal.x() * normal.y() * a;
  tangent_ = {1 + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x()};
  bitangent_ = {b, sign + normal.y() * normal.y() * a, -normal.y()};
}

}  // namespace sklar::brdf
