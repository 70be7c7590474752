#pragma once
/// What each cell of a measured table counts in a fit.

#include <algorithm>
#include <vector>

#include "brdf/data/measured_table.hpp"

namespace sklar::brdf {

/// By bins of theta_h, theta_d and phi_d folded at pi/2, those of Grid but coarser in azimuth.
class CellImportance {
 public:
  static constexpr int kAzimuths = 9;

  CellImportance() : values_(static_cast<std::size_t>(Grid::theta_h * Grid::theta_d * kAzimuths)) {}

  /// Of the bins i, j, k of theta_h, theta_d and phi_d; azimuth is one of kAzimuths.
  [[nodiscard]] double at(int i, int j, int k) const { return values_[index(i, j, azimuth_of(k))]; }
  [[nodiscard]] double& bin(int i, int j, int azimuth) { return values_[index(i, j, azimuth)]; }
  [[nodiscard]] double bin(int i, int j, int azimuth) const { return values_[index(i, j, azimuth)]; }

  [[nodiscard]] static int azimuth_of(int k) {
    constexpr int kFolded = Grid::phi_d / 2;
    return std::min(k, Grid::phi_d - 1 - k) * kAzimuths / kFolded;
  }

 private:
  static std::size_t index(int i, int j, int azimuth) {
    return static_cast<std::size_t>((i * Grid::theta_d + j) * kAzimuths + azimuth);
  }
  std::vector<double> values_;
};

}  // namespace sklar::brdf
