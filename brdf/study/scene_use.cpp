#include "brdf/study/scene_use.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "brdf/geometry/coordinates.hpp"

namespace sklar::brdf {
namespace {

constexpr double kLeast = 1e-3;  // of the mean importance, where no light came

int bin_of(double x, int count) {
  return std::clamp(static_cast<int>(x * count), 0, count - 1);
}

/// Each bin shared with its neighbours: uses are few beside the bins.
CellImportance spread(const CellImportance& counts) {
  CellImportance result;
  for (int i = 0; i < Grid::theta_h; ++i) {
    for (int j = 0; j < Grid::theta_d; ++j) {
      for (int k = 0; k < CellImportance::kAzimuths; ++k) {
        double sum = 0;
        for (const int row : {i - 1, i, i + 1}) {
          for (const int column : {j - 1, j, j + 1}) {
            if (row < 0 || row >= Grid::theta_h || column < 0 || column >= Grid::theta_d) continue;
            sum += counts.bin(row, column, k);
          }
        }
        result.bin(i, j, k) = sum / 9;
      }
    }
  }
  return result;
}

CellImportance normalised(CellImportance importance) {
  double sum = 0;
  const auto for_each_bin = [&](const auto& action) {
    for (int i = 0; i < Grid::theta_h; ++i) {
      for (int j = 0; j < Grid::theta_d; ++j) {
        for (int k = 0; k < CellImportance::kAzimuths; ++k) action(importance.bin(i, j, k));
      }
    }
  };
  for_each_bin([&](double value) { sum += value; });
  const double mean = sum / (Grid::theta_h * Grid::theta_d * CellImportance::kAzimuths);
  for_each_bin([&](double& value) { value = value / mean + kLeast; });
  return importance;
}

/// The least range of 64ths that leaves out half of kLeast of the light at either end.
AxisRange range_of(const std::vector<LightUse>& uses, double total, const std::vector<double>& at) {
  std::array<double, AxisRange::kWhole> light{};
  for (std::size_t n = 0; n < uses.size(); ++n) {
    light[static_cast<std::size_t>(bin_of(at[n], AxisRange::kWhole))] += uses[n].light;
  }
  // How many bins from an end hold less than that together.
  const auto spare = [&](auto first) {
    double sum = 0;
    int count = 0;
    while ((sum += *first++) < kLeast / 2 * total) ++count;
    return count;
  };
  return {spare(light.begin()), AxisRange::kWhole - spare(light.rbegin())};
}

double total_light(const std::vector<LightUse>& uses) {
  double total = 0;
  for (const LightUse& use : uses) total += use.light;
  if (!(total > 0)) throw std::runtime_error("the scene shows no light by way of the material");
  return total;
}

}  // namespace

SceneUse scene_use(const Scene& scene, const Brdf& material, double width, const PathOptions& options) {
  const std::vector<LightUse> uses = light_uses(scene, material, options);
  const double total = total_light(uses);
  CellImportance counts;
  std::vector<double> half, difference;
  for (const LightUse& use : uses) {
    const HalfDifference angles = half_difference(use.wo, use.wi);
    const double quarter = std::numbers::pi / 2, folded = std::min(angles.phi_d, std::numbers::pi - angles.phi_d);
    counts.bin(bin_of(std::sqrt(angles.theta_h / quarter), Grid::theta_h),
               bin_of(angles.theta_d / quarter, Grid::theta_d), bin_of(folded / quarter, CellImportance::kAzimuths)) +=
        use.light;
    const Warped w = warp(width, use.wo, use.wi);
    half.push_back(w.half);
    difference.push_back(w.difference);
  }
  return {.importance = std::make_shared<CellImportance>(normalised(spread(counts))),
          .half_range = range_of(uses, total, half),
          .difference_range = range_of(uses, total, difference),
          .reflections = uses.size()};
}

double share_outside(const Scene& scene, const Brdf& material, const RefinedStructure& structure,
                     const PathOptions& options) {
  const std::vector<LightUse> uses = light_uses(scene, material, options);
  double outside = 0;
  for (const LightUse& use : uses) {
    if (!in_ranges(structure, use.wo, use.wi)) outside += use.light;
  }
  return outside / total_light(uses);
}

}  // namespace sklar::brdf
