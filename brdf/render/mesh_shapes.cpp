#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "brdf/render/mesh.hpp"

namespace sklar::brdf {
namespace {
using std::numbers::pi;

constexpr int kAround = 96;  ///< segments about the axis: the outline is off by 1/2000 of the radius
constexpr int kTube = 48;
constexpr int kSplineSteps = 12;  ///< between two points of a profile

struct ProfilePoint {
  Vec2 place;    ///< radius, height
  Vec2 tangent;  ///< along the profile
};

/// The Catmull-Rom spline; at the ends the tangent is that of the chord.
std::vector<ProfilePoint> smooth_profile(std::span<const Vec2> points) {
  const auto tangent = [&](std::size_t i) -> Vec2 {
    if (i == 0) return points[1] - points[0];
    if (i + 1 == points.size()) return points[i] - points[i - 1];
    return 0.5 * (points[i + 1] - points[i - 1]);
  };
  std::vector<ProfilePoint> profile;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec2& a = points[i];
    const Vec2& b = points[i + 1];
    const Vec2 da = tangent(i), db = tangent(i + 1);
    const bool last = i + 2 == points.size();
    for (int step = 0; step < kSplineSteps + (last ? 1 : 0); ++step) {
      const double t = static_cast<double>(step) / kSplineSteps;
      const double u = 1 - t;
      profile.push_back({u * u * (1 + 2 * t) * a + t * u * u * da + t * t * (3 - 2 * t) * b - t * t * u * db,
                         6 * t * u * (b - a) + u * (1 - 3 * t) * da + t * (3 * t - 2) * db});
    }
  }
  for (ProfilePoint& point : profile) point.place.x() = std::max(point.place.x(), 0.0);
  return profile;
}

/// The profile turned about y. Rings of radius 0 have no area of their own: one of the two triangles there goes.
TriangleMesh swept(std::span<const ProfilePoint> profile, int around) {
  TriangleMesh mesh;
  const int rings = static_cast<int>(profile.size());
  for (const ProfilePoint& point : profile) {
    const Vec2 outward = Vec2(point.tangent.y(), -point.tangent.x()).normalized();
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * pi * k / around;
      const double s = std::sin(angle), c = std::cos(angle);
      mesh.vertices.emplace_back(point.place.x() * s, point.place.y(), point.place.x() * c);
      mesh.normals.emplace_back(outward.x() * s, outward.y(), outward.x() * c);
    }
  }
  for (int ring = 0; ring + 1 < rings; ++ring) {
    const auto low = static_cast<std::size_t>(ring);
    for (int k = 0; k < around; ++k) {
      const int next = (k + 1) % around;
      const int a = ring * around + k, b = ring * around + next;
      if (profile[low].place.x() > 0) mesh.triangles.push_back({a, b, b + around});
      if (profile[low + 1].place.x() > 0) mesh.triangles.push_back({a, b + around, a + around});
    }
  }
  return mesh;
}

}  // namespace

TriangleMesh rectangle(const Vec3& corner, const Vec3& side_a, const Vec3& side_b) {
  return {.vertices = {corner, corner + side_a, corner + side_a + side_b, corner + side_b},
          .normals = {},
          .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

TriangleMesh box(const Vec3& size) {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 a = Vec3::Zero(), b = Vec3::Zero(), out = Vec3::Zero();
      out(axis) = side * size(axis);
      a((axis + 1) % 3) = side * size((axis + 1) % 3);
      b((axis + 2) % 3) = size((axis + 2) % 3);
      const int first = static_cast<int>(mesh.vertices.size());
      for (const Vec3& vertex : rectangle(0.5 * (out - a - b), a, b).vertices) mesh.vertices.push_back(vertex);
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
  return mesh;
}

TriangleMesh torus(double ring, double tube) {
  if (!(tube > 0) || !(tube < ring) || !std::isfinite(ring)) {
    throw std::domain_error("torus: tube must be positive and below ring");
  }
  std::vector<ProfilePoint> profile;
  for (int k = 0; k <= kTube; ++k) {
    const double angle = 2 * pi * (k % kTube) / kTube;
    profile.push_back({{ring + tube * std::cos(angle), tube * std::sin(angle)}, {-std::sin(angle), std::cos(angle)}});
  }
  return swept(profile, kAround);
}

TriangleMesh revolution(std::span<const Vec2> profile) {
  if (profile.size() < 2) throw std::invalid_argument("revolution: a profile needs at least two points");
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const bool end = i == 0 || i + 1 == profile.size();
    if (!profile[i].allFinite() || !(end ? profile[i].x() >= 0 : profile[i].x() > 0)) {
      throw std::domain_error("revolution: radius " + std::to_string(i + 1) +
                              " must be positive and finite; 0 is for the ends");
    }
    if (i > 0 && profile[i] == profile[i - 1]) {
      throw std::invalid_argument("revolution: points " + std::to_string(i) + " and " + std::to_string(i + 1) +
                                  " of the profile coincide");
    }
  }
  return swept(smooth_profile(profile), kAround);
}

}  // namespace sklar::brdf
