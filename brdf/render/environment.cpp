#include "brdf/render/environment.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace sklar::brdf {
namespace {

double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// A rectangle of light seen through a tangent plane: 1 inside, falling to 0 over `edge` beyond its half sizes.
double soft_box(const Vec3& direction, const Vec3& centre, double half_width, double half_height, double edge) {
  const Vec3 axis = centre.normalized();
  const double depth = direction.dot(axis);
  if (depth <= 0) return 0;
  const Vec3 right = Vec3::UnitY().cross(axis).normalized();
  const double x = std::abs(direction.dot(right)) / depth;
  const double y = std::abs(direction.dot(axis.cross(right))) / depth;
  return smooth_step(half_width + edge, half_width, x) * smooth_step(half_height + edge, half_height, y);
}

}  // namespace

Rgb studio_environment(const Vec3& direction) {
  const Rgb ground(0.16, 0.13, 0.10);
  const Rgb horizon(0.52, 0.54, 0.57);
  const Rgb zenith(0.17, 0.29, 0.55);
  const double up = direction.y();
  const Rgb sky = horizon + (zenith - horizon) * smooth_step(0.0, 1.0, up);
  Rgb radiance = ground + (sky - ground) * smooth_step(-0.12, 0.08, up);
  radiance += Rgb(4.0, 3.8, 3.5) * soft_box(direction, {-0.75, 0.65, 0.6}, 0.32, 0.32, 0.14);
  radiance += Rgb(2.0, 2.2, 2.4) * soft_box(direction, {0.95, 0.1, 0.15}, 0.10, 0.9, 0.14);
  return radiance;
}

}  // namespace sklar::brdf
