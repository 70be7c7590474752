#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "brdf/data/table_brdf.hpp"
#include "brdf/study/metrics.hpp"
#include "brdf/study/sphere_positions.hpp"

namespace sklar::brdf {
namespace {
using std::numbers::pi;

constexpr int kSize = 96;
constexpr int kLights = 6000;
constexpr double kDisk = 0.995;         ///< of x^2 + y^2
constexpr double kLowestCosine = 0.01;  ///< of both directions
constexpr double kPeakQuantile = 0.995;

/// Lights follow each other by theta_d, half the angle to the viewer: what a block of pixels reads of a table for some
/// of them stays in the cache. The sum at a pixel runs over the lights in order whatever the blocks.
constexpr Eigen::Index kPixelBlock = 512;

/// The viewer is at z. The half vector h and theta_d are the same at all pixels; a normal's coordinates in the frame
/// (x, y, h), where y = h x (wi - wo) / |wi - wo| and x = h x y, are sin(theta_h) cos(phi_d), sin(theta_h) sin(phi_d)
/// and cos(theta_h).
struct Light {
  Vec3 direction;
  double power;  ///< radiance times solid angle
  Eigen::Matrix3d frame;
  Between theta_d;

  Light(const Vec3& wi, double watts) : direction(wi), power(watts) {
    const Vec3 wo = Vec3::UnitZ();
    const Vec3 half = (wi + wo).normalized();
    const Vec3 across = half.cross(wi - wo).normalized();
    frame << half.cross(across), across, half;
    theta_d = cell_position(half_difference(wo, wi)).theta_d;
  }
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
    all.emplace_back(direction, radiance(direction) * 4 * pi / kLights);
  }
  return all;
}

using Normals = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// 7208 normals, whole blocks and 40 more: multiples of 8, as the vector kernel wants them.
Normals disk_normals() {
  std::vector<double> coordinates;
  for (int i = 0; i < kSize; ++i) {
    for (int j = 0; j < kSize; ++j) {
      const double x = (j + 0.5) / (kSize / 2.0) - 1;
      const double y = 1 - (i + 0.5) / (kSize / 2.0);
      const double square = x * x + y * y;
      if (square < kDisk) coordinates.insert(coordinates.end(), {x, y, std::sqrt(1 - square)});
    }
  }
  return Eigen::Map<const Eigen::Matrix3Xd>(coordinates.data(), 3, static_cast<Eigen::Index>(coordinates.size()) / 3)
      .transpose();
}

using Cell = Eigen::Array4d;  ///< the last is 0: whole vector registers

/// A table with the channels of a cell side by side: one cache line serves all three.
std::vector<Cell> interleave(const CellValues& values) {
  for (const std::vector<double>& plane : values) {
    if (plane.size() != Grid::cells) {
      throw std::invalid_argument("sphere_pixels: a plane has " + std::to_string(plane.size()) + " cells, expected " +
                                  std::to_string(Grid::cells));
    }
  }
  std::vector<Cell> cells(Grid::cells);
  for (std::size_t n = 0; n < cells.size(); ++n) cells[n] = {values[0][n], values[1][n], values[2][n], 0};
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
    Cell sum = Cell::Zero();
    for (std::size_t n = 0; n < 8; ++n) sum += weight[n] * table[static_cast<std::size_t>(cell[n])];
    return sum.head<3>();
  }
};

/// Adds a light to a block of pixels of every table's sphere.
void add(const Light& light, const Normals& normals, const std::vector<std::vector<Cell>>& tables, Eigen::Index first,
         std::vector<SpherePixels>& spheres) {
  const Normals turned = normals * light.frame;
  std::array<double, kPixelBlock> theta_h, phi_d;
  sphere_positions(turned.col(0).data(), turned.col(1).data(), turned.col(2).data(),
                   static_cast<std::size_t>(turned.rows()), theta_h.data(), phi_d.data());
  for (Eigen::Index n = 0; n < normals.rows(); ++n) {
    const double cos_i = normals.row(n).dot(light.direction);
    if (!(cos_i > kLowestCosine && normals(n, 2) > kLowestCosine)) continue;
    const auto at = static_cast<std::size_t>(n);
    const Stencil stencil({.theta_h = between_clamped(theta_h[at], Grid::theta_h),
                           .theta_d = light.theta_d,
                           .phi_d = between_periodic(phi_d[at], Grid::phi_d)});
    for (std::size_t t = 0; t < tables.size(); ++t) {
      spheres[t].row(first + n) += (light.power * cos_i * stencil.read(tables[t])).transpose();
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
  const Normals normals = disk_normals();
  std::vector<SpherePixels> pixels(tables.size(), SpherePixels::Zero(normals.rows(), 3));
  const Eigen::Index blocks = (normals.rows() + kPixelBlock - 1) / kPixelBlock;
  tbb::parallel_for(Eigen::Index{0}, blocks, [&](Eigen::Index n) {
    const Eigen::Index first = n * kPixelBlock;
    const Normals block = normals.middleRows(first, std::min(kPixelBlock, normals.rows() - first));
    for (const Light& light : all) add(light, block, cells, first, pixels);
  });
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
