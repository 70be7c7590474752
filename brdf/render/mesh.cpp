#include "brdf/render/mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "brdf/geometry/frame.hpp"

namespace sklar::brdf {
namespace {

constexpr double kFlat = 1e-12;       ///< area of a triangle over the square of its longest edge: degenerate below
constexpr double kUnitLength = 1e-3;  ///< how far the length of a normal may be from 1

[[noreturn]] void refuse(const char* what, std::size_t index, const std::string& reason) {
  throw std::invalid_argument(std::string(what) + " " + std::to_string(index + 1) + " " + reason);
}

void require_triangle(const TriangleMesh& mesh, std::size_t index) {
  for (const int vertex : mesh.triangles[index]) {
    if (vertex < 0 || static_cast<std::size_t>(vertex) >= mesh.vertices.size()) {
      refuse("triangle", index,
             "names vertex " + std::to_string(vertex + 1) + " of " + std::to_string(mesh.vertices.size()));
    }
  }
  const auto& [a, b, c] = mesh.triangles[index];
  const auto corner = [&](int vertex) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(vertex)]; };
  const double longest = std::max({(corner(b) - corner(a)).squaredNorm(), (corner(c) - corner(b)).squaredNorm(),
                                   (corner(a) - corner(c)).squaredNorm()});
  if (!(area_vector(mesh, index).norm() > kFlat * longest)) refuse("triangle", index, "is degenerate: it has no area");
}

}  // namespace

Vec3 area_vector(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& corners = mesh.triangles[triangle];
  const Vec3& a = mesh.vertices[static_cast<std::size_t>(corners[0])];
  return (mesh.vertices[static_cast<std::size_t>(corners[1])] - a)
      .cross(mesh.vertices[static_cast<std::size_t>(corners[2])] - a);
}

void require_mesh(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw std::invalid_argument("the mesh has no triangles");
  if (!mesh.normals.empty() && mesh.normals.size() != mesh.vertices.size()) {
    throw std::invalid_argument("the mesh has " + std::to_string(mesh.normals.size()) + " normals for " +
                                std::to_string(mesh.vertices.size()) + " vertices");
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!mesh.vertices[i].allFinite()) refuse("vertex", i, "is not finite");
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (!(std::abs(mesh.normals[i].norm() - 1) <= kUnitLength)) refuse("normal", i, "is not of length 1");
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) require_triangle(mesh, i);
}

TriangleMesh placed(TriangleMesh mesh, const Placement& placement) {
  for (Vec3& vertex : mesh.vertices) vertex = rotate_about_y(placement.scale * vertex, placement.turn) + placement.at;
  for (Vec3& normal : mesh.normals) normal = rotate_about_y(normal, placement.turn);
  return mesh;
}

}  // namespace sklar::brdf
