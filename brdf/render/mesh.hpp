#pragma once
/// Triangle meshes: values, checks, and the shapes that need no file.

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// A surface of triangles.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<Vec3> normals;                  ///< unit, one a vertex; none = each triangle has its own
  std::vector<std::array<int, 3>> triangles;  ///< anticlockwise seen from the front
};

/// How meshes are held and shared.
using MeshPtr = std::shared_ptr<const TriangleMesh>;

/// (b - a) x (c - a) of a triangle: along its normal, twice its area long.
[[nodiscard]] Vec3 area_vector(const TriangleMesh& mesh, std::size_t triangle);

/// @throws std::invalid_argument naming the first vertex that is not finite, normal that is not of length 1, triangle
/// that names a missing vertex or has no area (below 1e-12 of the square of its longest edge); each counted from 1.
/// Also for a mesh without triangles, or with another number of normals than vertices.
void require_mesh(const TriangleMesh& mesh);

/// Scaled, turned about the y axis, moved, in this order.
struct Placement {
  double scale = 1;  ///< positive
  double turn = 0;   ///< radians, z toward x
  Vec3 at = Vec3::Zero();
};

/// The mesh scaled, turned and moved.
[[nodiscard]] TriangleMesh placed(TriangleMesh mesh, const Placement& placement);

/// The parallelogram at `corner` with the given sides; its front is along side_a x side_b.
[[nodiscard]] TriangleMesh rectangle(const Vec3& corner, const Vec3& side_a, const Vec3& side_b);

/// A box around the origin with these edges along x, y, z. The front is outside.
[[nodiscard]] TriangleMesh box(const Vec3& size);

/// A ring around the y axis: circles of radius `tube` about a circle of radius `ring`; smooth normals.
/// @throws std::domain_error unless 0 < tube < ring.
[[nodiscard]] TriangleMesh torus(double ring, double tube);

/// The surface swept by a profile of (radius, height) about the y axis, smooth through a Catmull-Rom spline of the
/// points. A profile that runs upward has its front outside. @throws std::invalid_argument for fewer than two points,
/// or neighbours that coincide; std::domain_error for a radius that is negative, or 0 but at an end.
[[nodiscard]] TriangleMesh revolution(std::span<const Vec2> profile);

}  // namespace sklar::brdf
