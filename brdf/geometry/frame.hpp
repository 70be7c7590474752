#pragma once
/// Local frames and spherical directions (docs/conventions.md).

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// Unit vector at polar angle theta from z and azimuth phi from x. @param theta, phi radians.
[[nodiscard]] Vec3 spherical_direction(double theta, double phi);

/// Angle in [0,pi] between w and z, accurate to rounding at every angle. @param w any length but 0.
[[nodiscard]] double polar_angle(const Vec3& w);

/// Ry(angle): turns z toward x. @param angle radians.
[[nodiscard]] Vec3 rotate_about_y(const Vec3& w, double angle);

/// Right-handed orthonormal frame around a unit normal, without a branch on its direction. Source: Duff et al. 2017,
/// "Building an Orthonormal Basis, Revisited", JCGT 6(1), listing 3.
class Frame {
 public:
  /// @param normal world space, unit.
  explicit Frame(const Vec3& normal);

  [[nodiscard]] Vec3 to_local(const Vec3& world) const {
    return {tangent_.dot(world), bitangent_.dot(world), normal_.dot(world)};
  }
  [[nodiscard]] Vec3 to_world(const Vec3& local) const {
    return local.x() * tangent_ + local.y() * bitangent_ + local.z() * normal_;
  }

 private:
  Vec3 tangent_, bitangent_, normal_;
};

}  // namespace sklar::brdf
