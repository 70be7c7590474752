#include "brdf/model/refined_cells.hpp"

#include <stdexcept>

#include "brdf/data/cell_directions.hpp"
#include "brdf/data/fit_weight.hpp"
#include "brdf/geometry/coordinates.hpp"
#include "brdf/model/warp.hpp"

namespace sklar::brdf {
namespace {

constexpr int kFolded = Grid::phi_d / 2;

/// Azimuth bins of the columns at a bin of theta_h and theta_d: evenly spaced, shifted from bin to bin.
int azimuth_bin(int i, int j, int column) {
  constexpr int kShifts = 6;
  const double shift = static_cast<double>((2 * i + j) % kShifts) / kShifts;
  return static_cast<int>((column + shift) * kFolded / kLossColumns);
}

struct Filler {
  const MeasuredTable& table;
  CellMeasure measure;
  const RefinedStructure& structure;
  const CellImportance* importance;

  /// One column; returns its weight.
  double fill(LossSlice& slice, int i, int j, int column) const {
    const int k = azimuth_bin(i, j, column);
    const auto one = static_cast<std::size_t>(Grid::index(i, j, k));
    const auto other = static_cast<std::size_t>(Grid::index(i, j, Grid::phi_d - 1 - k));
    const int valid = table.valid[one] + table.valid[other];
    const DirectionPair pair = cell_directions(i, j, k);
    const double counts = fit_weight(pair);
    if (valid == 0 || counts == 0) return 0;
    const Warped w = warp(structure.width, pair.wo, pair.wi);
    if (!structure.half_range.contains(w.half) || !structure.difference_range.contains(w.difference)) return 0;
    const auto at = static_cast<std::size_t>(i * kLossColumns + column);
    for (std::size_t c = 0; c < 3; ++c) {
      slice.measured[c][at] = static_cast<float>((table.values[c][one] + table.values[c][other]) / valid);
    }
    slice.cos_i[at] = static_cast<float>(pair.wi.z());
    slice.cos_o[at] = static_cast<float>(pair.wo.z());
    slice.azimuth[at] = static_cast<float>(w.azimuth);
    double weight = valid / 2.0 * counts;
    if (measure == CellMeasure::per_solid_angle) weight *= cell_measure(i, j);
    if (importance != nullptr) weight *= importance->at(i, j, k);
    slice.weight[at] = static_cast<float>(weight);
    return weight;
  }
};

}  // namespace

RefinedCells refined_cells(const MeasuredTable& table, CellMeasure measure, const RefinedStructure& structure,
                           const CellImportance* importance) {
  require_table("fit_refined", table);
  RefinedCells cells{.slices = std::vector<LossSlice>(Grid::theta_d),
                     .half = Eigen::ArrayXd(Grid::theta_h),
                     .difference = Eigen::ArrayXd(Grid::theta_d),
                     .scale = fit_scale(table.values, table.valid_cells())};
  const Filler filler{table, measure, structure, importance};
  for (int i = 0; i < Grid::theta_h; ++i) {
    const DirectionPair pair = directions({Grid::theta_h_centre(i), 0, 0});
    cells.half(i) = coordinates(structure, pair.wo, pair.wi).half;
  }
  for (int j = 0; j < Grid::theta_d; ++j) {
    const DirectionPair pair = directions({0, Grid::theta_d_centre(j), 0});
    cells.difference(j) = coordinates(structure, pair.wo, pair.wi).difference;
    LossSlice& slice = cells.slices[static_cast<std::size_t>(j)];
    for (int i = 0; i < Grid::theta_h; ++i) {
      for (int column = 0; column < kLossColumns; ++column) {
        cells.total_weight += 3 * filler.fill(slice, i, j, column);
      }
    }
    for (auto& plane : slice.measured) {
      for (float& value : plane) value *= static_cast<float>(cells.scale);
    }
  }
  if (!(cells.total_weight > 0)) {
    throw std::invalid_argument("fit_refined: table '" + table.name + "' has no valid cell above the horizon");
  }
  return cells;
}

}  // namespace sklar::brdf
