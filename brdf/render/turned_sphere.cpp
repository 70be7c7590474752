#include "brdf/render/turned_sphere.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace sklar::brdf {
namespace {
using std::numbers::pi;

constexpr int kRings = 256;  ///< theta_o of the quadratures: the nearest is taken, at most 0.18 degrees off

RgbRows values(const Brdf& brdf, const Directions& wo, const Directions& wi, bool swap) {
  return swap ? brdf.eval(wi, wo) : brdf.eval(wo, wi);
}

std::vector<HemisphereNodes> quadratures(const HemisphereOptions& options) {
  const HemisphereOptions fewer{.polar = std::max(2, options.polar / 2),
                                .azimuth = std::max(2, options.azimuth * 2 / 3)};
  std::vector<HemisphereNodes> rings(kRings);
  tbb::parallel_for(0, kRings, [&](int k) {
    rings[static_cast<std::size_t>(k)] = hemisphere_nodes((k + 0.5) / kRings * pi / 2, fewer);
  });
  return rings;
}

/// Tangent along the circle of latitude, bitangent along the meridian, normal (columns).
Eigen::Matrix3d grain(const Vec3& normal) {
  const double across = std::hypot(normal.x(), normal.z());
  const Vec3 tangent = across > 0 ? Vec3(normal.z() / across, 0, -normal.x() / across) : Vec3(1, 0, 0);
  Eigen::Matrix3d frame;
  frame << tangent, normal.cross(tangent), normal;
  return frame;
}

/// The part of the sphere that a pixel sees.
struct Pixel {
  int column = 0;
  std::vector<Vec3> normals{};  ///< at the sub-pixels

  /// At the middle of them.
  [[nodiscard]] Vec3 middle() const {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& normal : normals) sum += normal;
    return sum.normalized();
  }
};

std::vector<Pixel> row_pixels(const SphereOptions& options, int row) {
  const int fine = options.supersampling;
  const double half = options.size / 2.0;
  std::vector<Pixel> pixels;
  for (int column = 0; column < options.size; ++column) {
    Pixel pixel{.column = column};
    for (int sub = 0; sub < fine * fine; ++sub) {
      const int across = sub % fine, down = sub / fine;
      const double x = ((column + (across + 0.5) / fine) / half - 1) / options.radius;
      const double y = (1 - (row + (down + 0.5) / fine) / half) / options.radius;
      const double square = x * x + y * y;
      if (square < 1) pixel.normals.emplace_back(x, y, std::sqrt(1 - square));
    }
    if (!pixel.normals.empty()) pixels.push_back(std::move(pixel));
  }
  return pixels;
}

/// The environment's light reflected to the viewer.
Rgb environment_share(const Brdf& brdf, const SphereOptions& options, const std::vector<HemisphereNodes>& rings,
                      const Vec3& normal) {
  const Eigen::Matrix3d frame = grain(normal);
  const Vec3 view = frame.row(2).transpose();
  const double theta_o = std::acos(std::min(view.z(), 1.0));
  const auto ring = static_cast<std::size_t>(std::min(static_cast<int>(theta_o / (pi / 2) * kRings), kRings - 1));
  const HemisphereNodes& nodes = rings[ring];
  const double radius = std::hypot(view.x(), view.y());
  const double c = radius > 0 ? view.x() / radius : 1, s = radius > 0 ? view.y() / radius : 0;
  const double near = (static_cast<double>(ring) + 0.5) / kRings * pi / 2;
  Directions wo(nodes.wi.rows(), 3), wi(nodes.wi.rows(), 3);
  wo.rowwise() = Eigen::RowVector3d(c * std::sin(near), s * std::sin(near), std::cos(near)).array();
  wi.col(0) = c * nodes.wi.col(0) - s * nodes.wi.col(1);
  wi.col(1) = s * nodes.wi.col(0) + c * nodes.wi.col(1);
  wi.col(2) = nodes.wi.col(2);
  const RgbRows f = values(brdf, wo, wi, options.swap_directions);
  Rgb sum = Rgb::Zero();
  for (Eigen::Index n = 0; n < f.rows(); ++n) {
    sum += f.row(n).transpose() * nodes.weight(n) * options.environment(frame * wi.row(n).matrix().transpose());
  }
  return sum;
}

/// The mean over all sub-pixels of the light's share, 0 where they miss the sphere.
Rgb light_share(const Brdf& brdf, const SphereOptions& options, const Pixel& pixel) {
  const Vec3 light = options.light_direction.normalized();
  const auto count = static_cast<Eigen::Index>(pixel.normals.size());
  Directions wo(count, 3), wi(count, 3);
  for (Eigen::Index n = 0; n < count; ++n) {
    const Eigen::Matrix3d frame = grain(pixel.normals[static_cast<std::size_t>(n)]);
    wo.row(n) = frame.row(2).array();
    wi.row(n) = (frame.transpose() * light).transpose().array();
  }
  const RgbRows reflected = values(brdf, wo, wi, options.swap_directions).colwise() * wi.col(2).max(0.0);
  return options.light_irradiance * reflected.colwise().sum().transpose() /
         (options.supersampling * options.supersampling);
}

}  // namespace

Image render_turned_sphere(const Brdf& brdf, const SphereOptions& options) {
  require_sphere_options("render_turned_sphere", options);
  const std::vector<HemisphereNodes> rings = quadratures(options.nodes);
  Image image(options.size, options.size);
  ProgressCounter counter(options.progress, options.size);
  tbb::parallel_for(0, options.size, [&](int row) {
    for (int column = 0; column < options.size; ++column) {
      for (int c = 0; c < 3; ++c) image.at(row, column, c) = static_cast<float>(options.background(c));
    }
    for (const Pixel& pixel : row_pixels(options, row)) {
      const double covered =
          static_cast<double>(pixel.normals.size()) / (options.supersampling * options.supersampling);
      const Rgb colour = (1 - covered) * options.background +
                         covered * environment_share(brdf, options, rings, pixel.middle()) +
                         light_share(brdf, options, pixel);
      for (int c = 0; c < 3; ++c) image.at(row, pixel.column, c) = static_cast<float>(colour(c));
    }
    counter.step();
  });
  return image;
}

}  // namespace sklar::brdf
