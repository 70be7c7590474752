#pragma once
/// Where rays meet the objects of a scene, by Embree. Directions of rays in single precision, points in double.

#include <memory>
#include <optional>

#include "brdf/render/scene.hpp"

namespace sklar::brdf {

/// Where a ray meets a surface.
struct Hit {
  std::size_t object;
  Vec3 point;           ///< on the surface, to rounding
  Vec3 face_normal;     ///< unit, of the surface that was hit
  Vec3 shading_normal;  ///< unit, interpolated where the mesh has normals
};

/// Immutable and thread-safe. Answers do not depend on the number of threads.
class RayScene {
 public:
  /// @param scene as require_scene accepts it; outlives this. @throws std::runtime_error if Embree cannot be used.
  explicit RayScene(const Scene& scene);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// @param direction unit.
  [[nodiscard]] std::optional<Hit> closest(const Vec3& origin, const Vec3& direction) const;

  /// Whether something lies between two points, but for a ten-thousandth of the way before the second.
  [[nodiscard]] bool blocked(const Vec3& from, const Vec3& to) const;

  /// Whether something lies in a direction, however far.
  [[nodiscard]] bool blocked_toward(const Vec3& from, const Vec3& direction) const;

  /// A point off the surface, from which rays do not meet it again. @param direction of the ray to start there.
  [[nodiscard]] Vec3 start(const Hit& hit, const Vec3& direction) const;

  /// Of a sphere around all objects; 0 without any.
  [[nodiscard]] double radius() const { return radius_; }

 private:
  struct Embree;
  const Scene& scene_;
  std::unique_ptr<Embree> embree_;
  double radius_ = 0;
  double offset_ = 0;
};

}  // namespace sklar::brdf
