#include "brdf/render/sphere.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "brdf/render/turned_light.hpp"

namespace sklar::brdf {
namespace {
using std::numbers::pi;

constexpr int kAngles = 512;  ///< azimuths of a ring, and columns of the environment map
constexpr int kRows = 256;    ///< rows of the environment map, from z = 1 to z = -1
using Ring = std::array<std::array<float, kAngles>, 3>;

/// The environment on a grid around the view axis; every row is stored twice, so that a window of kAngles + 1 columns
/// starting anywhere in the first copy needs no wrapping.
class EnvironmentMap {
 public:
  explicit EnvironmentMap(const Environment& environment) : planes_(3) {
    for (auto& plane : planes_) plane.resize(static_cast<std::size_t>(kRows) * kWidth);
    tbb::parallel_for(0, kRows, [&](int row) {
      const double theta = pi * (row + 0.5) / kRows;
      for (int column = 0; column < kWidth; ++column) {
        const double phi = 2 * pi * (column % kAngles) / kAngles;
        const Rgb radiance =
            environment({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
        for (std::size_t c = 0; c < 3; ++c) {
          planes_[c][static_cast<std::size_t>(row * kWidth + column)] =
              static_cast<float>(radiance(static_cast<int>(c)));
        }
      }
    });
  }

  /// ring[c][a] += value[c] * radiance from `direction` turned about the view axis by 2 pi a / kAngles.
  void add(const Vec3& direction, const Rgb& value, Ring& ring) const {
    const double y = std::clamp(std::acos(std::clamp(direction.z(), -1.0, 1.0)) / pi * kRows - 0.5, 0.0, kRows - 1.0);
    const int row = std::min(static_cast<int>(y), kRows - 2);
    double x = std::atan2(direction.y(), direction.x()) / (2 * pi) * kAngles;
    if (x < 0) x += kAngles;
    const int column = std::min(static_cast<int>(x), kAngles - 1);
    const double down = y - row;
    const double right = x - column;
    for (std::size_t c = 0; c < 3; ++c) {
      const double v = value(static_cast<int>(c));
      const double above = v * (1 - down), below = v * down;
      const std::array<double, 4> share{above * (1 - right), above * right, below * (1 - right), below * right};
      const float* upper = &planes_[c][static_cast<std::size_t>(row * kWidth + column)];
      add_turned_light(upper, upper + kWidth, share, kAngles, ring[c].data());
    }
  }

 private:
  static constexpr int kWidth = 2 * kAngles;
  std::vector<std::vector<float>> planes_;
};

RgbRows values(const Brdf& brdf, const Directions& wo, const Directions& wi, bool swap) {
  return swap ? brdf.eval(wi, wo) : brdf.eval(wo, wi);
}

/// Tangent, bitangent and normal (columns) where the normal is theta_o off the view axis at azimuth 0. The tangent
/// points so that the view direction is (sin theta_o, 0, cos theta_o) in this frame.
Eigen::Matrix3d frame_at(double theta_o) {
  Eigen::Matrix3d frame;
  frame << -std::cos(theta_o), 0, std::sin(theta_o),  //
      0, -1, 0,                                       //
      std::sin(theta_o), 0, std::cos(theta_o);
  return frame;
}

/// The environment's light that leaves the sphere, on rings theta_o = (k + .5) / count * 90 degrees.
std::vector<Ring> shade_rings(const Brdf& brdf, const SphereOptions& options, int count, ProgressCounter& counter) {
  const EnvironmentMap map(options.environment);
  std::vector<Ring> rings(static_cast<std::size_t>(count));
  tbb::parallel_for(0, count, [&](int k) {
    const double theta_o = (k + 0.5) / count * pi / 2;
    const HemisphereNodes nodes = hemisphere_nodes(theta_o, options.nodes);
    Directions wo(nodes.wi.rows(), 3);
    wo.rowwise() = Eigen::RowVector3d(std::sin(theta_o), 0, std::cos(theta_o)).array();
    const RgbRows f = values(brdf, wo, nodes.wi, options.swap_directions);
    const Eigen::Matrix3d frame = frame_at(theta_o);
    Ring& ring = rings[static_cast<std::size_t>(k)];
    for (auto& plane : ring) plane.fill(0);
    for (Eigen::Index row = 0; row < f.rows(); ++row) {
      const Vec3 direction = frame * nodes.wi.row(row).matrix().transpose();
      map.add(direction, f.row(row).transpose() * nodes.weight(row), ring);
    }
    counter.step();
  });
  return rings;
}

Rgb interpolate(const std::vector<Ring>& rings, double theta_o, double phi) {
  const int count = static_cast<int>(rings.size());
  const double y = std::clamp(theta_o / (pi / 2) * count - 0.5, 0.0, count - 1.0);
  const auto k = static_cast<std::size_t>(std::min(static_cast<int>(y), count - 2));
  const double x = (phi < 0 ? phi + 2 * pi : phi) / (2 * pi) * kAngles;
  const auto left = static_cast<std::size_t>(x);
  const double out = y - static_cast<double>(k);
  const double on = x - static_cast<double>(left);
  Rgb sum;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto along = [&](const Ring& ring) {
      return (1 - on) * ring[c][left % kAngles] + on * ring[c][(left + 1) % kAngles];
    };
    sum(static_cast<int>(c)) = (1 - out) * along(rings[k]) + out * along(rings[k + 1]);
  }
  return sum;
}

/// The sub-pixels of one row of pixels that see the sphere.
struct RowSamples {
  std::vector<int> column;
  std::vector<double> theta_o, phi;
};

RowSamples row_samples(const SphereOptions& options, int row) {
  const int fine = options.supersampling;
  const double half = options.size / 2.0;
  RowSamples samples;
  for (int column = 0; column < options.size; ++column) {
    for (int sub = 0; sub < fine * fine; ++sub) {
      const int across = sub % fine, down = sub / fine;
      const double x = ((column + (across + 0.5) / fine) / half - 1) / options.radius;
      const double y = (1 - (row + (down + 0.5) / fine) / half) / options.radius;
      const double r = std::hypot(x, y);
      if (r >= 1) continue;
      samples.column.push_back(column);
      samples.theta_o.push_back(std::asin(r));
      samples.phi.push_back(std::atan2(y, x));
    }
  }
  return samples;
}

/// f cos(theta_i) of the directional light at every sample.
RgbRows directional(const Brdf& brdf, const SphereOptions& options, const RowSamples& samples) {
  const Vec3 light = options.light_direction.normalized();
  const auto count = static_cast<Eigen::Index>(samples.column.size());
  Directions wo(count, 3);
  Directions wi(count, 3);
  for (Eigen::Index n = 0; n < count; ++n) {
    const double theta_o = samples.theta_o[static_cast<std::size_t>(n)];
    const double c = std::cos(samples.phi[static_cast<std::size_t>(n)]);
    const double s = std::sin(samples.phi[static_cast<std::size_t>(n)]);
    const Vec3 turned(c * light.x() + s * light.y(), c * light.y() - s * light.x(), light.z());
    wo.row(n) << std::sin(theta_o), 0, std::cos(theta_o);
    wi.row(n) = (frame_at(theta_o).transpose() * turned).transpose().array();
  }
  return values(brdf, wo, wi, options.swap_directions).colwise() * wi.col(2).max(0.0);
}

void shade_row(const Brdf& brdf, const SphereOptions& options, const std::vector<Ring>& rings, int row, Image& image) {
  const RowSamples samples = row_samples(options, row);
  const RgbRows light = directional(brdf, options, samples);
  const double share = 1.0 / (options.supersampling * options.supersampling);
  std::vector<Rgb> sums(static_cast<std::size_t>(options.size), options.background);
  for (std::size_t n = 0; n < samples.column.size(); ++n) {
    const Rgb reflected = options.light_irradiance * light.row(static_cast<Eigen::Index>(n)).transpose() +
                          interpolate(rings, samples.theta_o[n], samples.phi[n]);
    sums[static_cast<std::size_t>(samples.column[n])] += share * (reflected - options.background);
  }
  for (int column = 0; column < options.size; ++column) {
    for (int c = 0; c < 3; ++c)
      image.at(row, column, c) = static_cast<float>(sums[static_cast<std::size_t>(column)](c));
  }
}

}  // namespace

void require_sphere_options(std::string_view function, const SphereOptions& options) {
  if (options.size < 1 || options.supersampling < 1) {
    throw std::invalid_argument(std::string(function) + ": size and supersampling must be at least 1, got " +
                                std::to_string(options.size) + " and " + std::to_string(options.supersampling));
  }
  if (!(options.radius > 0) || !(options.light_direction.norm() > 0)) {
    throw std::invalid_argument(std::string(function) + ": radius and the length of light_direction must be positive");
  }
}

Image render_sphere(const Brdf& brdf, const SphereOptions& options) {
  if (!brdf.traits().isotropic) throw std::invalid_argument("render_sphere: the BRDF must be isotropic");
  require_sphere_options("render_sphere", options);
  const int count = std::max(32, options.size * 5 / 8);
  ProgressCounter counter(options.progress, count + options.size);
  const std::vector<Ring> rings = shade_rings(brdf, options, count, counter);
  Image image(options.size, options.size);
  tbb::parallel_for(0, options.size, [&](int row) {
    shade_row(brdf, options, rings, row, image);
    counter.step();
  });
  return image;
}

}  // namespace sklar::brdf
