#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "brdf/data/table_brdf.hpp"
#include "brdf/geometry/frame.hpp"
#include "brdf/study/metrics.hpp"

namespace sklar::brdf {
namespace {
using std::numbers::pi;

constexpr int kSize = 96;
constexpr int kLights = 6000;
constexpr double kDisk = 0.995;         ///< of x^2 + y^2
constexpr double kLowestCosine = 0.01;  ///< of both directions
constexpr double kPeakQuantile = 0.995;

/// Lights of a block have nearly the same theta_d, half the angle to the viewer: what a block of pixels reads of a
/// table then stays in the cache. The sum at a pixel runs over the lights in order whatever the blocks.
constexpr std::size_t kLightBlock = 64;
constexpr std::size_t kPixelBlock = 512;

struct Light {
  Vec3 direction;
  double power;  ///< radiance times solid angle
};

double radiance(const Vec3& light) {
  const auto lobe = [&](double x, double y, double z, int power) {
    return std::pow(std::max(light.dot(Vec3(x, y, z).normalized()), 0.0), power);
  };
  return 0.3 + 0.3 * light.y() + 30 * lobe(0.5, 0.6, 0.6, 40) + 40 * lobe(-0.7, 0.3, 0.5, 80) +
         20 * lobe(0.1, -0.2, -1, 60);
}

/// A spherical Fibonacci lattice, z falling.
std::vector<Light> lights() {
  std::vector<Light> all;
  for (int k = 0; k < kLights; ++k) {
    const double z = 1 - 2 * (k + 0.5) / kLights;
    const double azimuth = pi * (1 + std::sqrt(5.0)) * (k + 0.5);
    const double r = std::sqrt(1 - z * z);
    const Vec3 direction(r * std::cos(azimuth), r * std::sin(azimuth), z);
    all.push_back({direction, radiance(direction) * 4 * pi / kLights});
  }
  return all;
}

std::vector<Vec3> disk_normals() {
  std::vector<Vec3> normals;
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j < kSize; ++j) {
      const double x = (j + 0.5) / (kSize / 2.0) - 1;
      const double y = 1 - (i + 0.5) / (kSize / 2.0);
      const double square = x * x + y * y;
      if (square < kDisk) normals.emplace_back(x, y, std::sqrt(1 - square));
    }
  }
  return normals;
}

using Cell = std::array<double, 3>;

/// A table with the channels of a cell side by side: one cache line serves all three.
std::vector<Cell> interleave(const CellValues& values) {
  for (const std::vector<double>& plane : values) {
    if (plane.size() != Grid::cells) {
      throw std::invalid_argument("sphere_pixels: a plane has " + std::to_string(plane.size()) + " cells, expected " +
                                  std::to_string(Grid::cells));
    }
  }
  std::vector<Cell> cells(Grid::cells);
  for (std::size_t n = 0; n < cells.size(); ++n) cells[n] = {values[0][n], values[1][n], values[2][n]};
  return cells;
}

/// The eight cells around a position and their shares.
struct Stencil {
  std::array<int, 8> cell;
  std::array<double, 8> weight;

  explicit Stencil(const CellPosition& p) {
    const auto of = [](const Between& axis, bool high) { return high ? axis.high : axis.low; };
    const auto share = [](const Between& axis, bool high) { return high ? axis.share : 1 - axis.share; };
    for (std::size_t n = 0; n < 8; ++n) {
      const bool i = (n & 4U) != 0;
      const bool j = (n & 2U) != 0;
      const bool k = (n & 1U) != 0;
      cell[n] = Grid::index(of(p.theta_h, i), of(p.theta_d, j), of(p.phi_d, k));
      weight[n] = share(p.theta_h, i) * share(p.theta_d, j) * share(p.phi_d, k);
    }
  }

  [[nodiscard]] Rgb read(const std::vector<Cell>& table) const {
    Cell sum{};
    for (std::size_t n = 0; n < 8; ++n) {
      const Cell& value = table[static_cast<std::size_t>(cell[n])];
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight[n] * value[c];
    }
    return {sum[0], sum[1], sum[2]};
  }
};

/// Adds the light of a block to one pixel of every table's sphere.
void add(const Vec3& normal, std::span<const Light> block, const std::vector<std::vector<Cell>>& tables,
         std::size_t pixel, std::vector<SpherePixels>& spheres) {
  const Frame frame(normal);
  const Vec3 wo = frame.to_local(Vec3::UnitZ());
  const auto row = static_cast<Eigen::Index>(pixel);
  for (const Light& light : block) {
    const Vec3 wi = frame.to_local(light.direction);
    if (!(wi.z() > kLowestCosine && wo.z() > kLowestCosine)) continue;
    const Stencil stencil(cell_position(half_difference(wo, wi)));
    for (std::size_t t = 0; t < tables.size(); ++t) {
      spheres[t].row(row) += (light.power * wi.z() * stencil.read(tables[t])).transpose();
    }
  }
}

/// The value at a quantile, linear between order statistics.
double quantile(Eigen::ArrayXd values, double q) {
  std::sort(values.begin(), values.end());
  const double position = q * static_cast<double>(values.size() - 1);
  const auto low = static_cast<Eigen::Index>(position);
  const Eigen::Index high = std::min(low + 1, values.size() - 1);
  return mix(values(low), values(high), position - static_cast<double>(low));
}

}  // namespace

std::vector<SpherePixels> sphere_pixels(std::span<const CellValues* const> tables) {
  std::vector<std::vector<Cell>> cells;
  for (const CellValues* table : tables) cells.push_back(interleave(*table));
  const std::vector<Light> all = lights();
  const std::vector<Vec3> normals = disk_normals();
  const auto count = static_cast<Eigen::Index>(normals.size());
  std::vector<SpherePixels> pixels(tables.size(), SpherePixels::Zero(count, 3));
  const auto work = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t first = 0; first < all.size(); first += kLightBlock) {
      const std::span block(all.data() + first, std::min(kLightBlock, all.size() - first));
      for (std::size_t n = range.begin(); n != range.end(); ++n) add(normals[n], block, cells, n, pixels);
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, normals.size(), kPixelBlock), work, tbb::simple_partitioner());
  return pixels;
}

Rgb sphere_psnr_linear_db(const SpherePixels& reference, const SpherePixels& model) {
  if (reference.rows() != model.rows() || reference.rows() == 0) {
    throw std::invalid_argument("sphere_psnr_linear_db: reference has " + std::to_string(reference.rows()) +
                                " pixels, model " + std::to_string(model.rows()) + "; they must agree");
  }
  Rgb psnr;
  for (int c = 0; c < 3; ++c) {
    const double peak = quantile(reference.col(c), kPeakQuantile);
    const double error = (reference.col(c).min(peak) - model.col(c).min(peak)).square().mean();
    psnr[c] = error > 0 ? -10 * std::log10(error / (peak * peak)) : std::numeric_limits<double>::infinity();
  }
  return psnr;
}

Rgb sphere_psnr_linear_db(const MeasuredTable& reference, const Brdf& model) {
  const CellValues predicted = predict(model, reference);
  const std::array<const CellValues*, 2> tables{&reference.values, &predicted};
  const std::vector<SpherePixels> pixels = sphere_pixels(tables);
  return sphere_psnr_linear_db(pixels[0], pixels[1]);
}

}  // namespace sklar::brdf
