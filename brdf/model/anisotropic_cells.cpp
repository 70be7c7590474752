#include "brdf/model/anisotropic_cells.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "brdf/data/fit_weight.hpp"
#include "brdf/geometry/coordinates.hpp"

namespace sklar::brdf {
namespace {

/// Walks over 0 .. count - 1 in an order of which every beginning is spread evenly: steps of the golden section.
class Spread {
 public:
  Spread(int count, int start) : count_(count), step_(golden(count)), at_(start % count) {}

  int next() {
    const int now = at_;
    at_ = (at_ + step_) % count_;
    return now;
  }

 private:
  static int golden(int count) {
    int step = std::max(1, static_cast<int>(std::lround(count / std::numbers::phi)));
    while (std::gcd(step, count) != 1) ++step;
    return step;
  }

  int count_, step_, at_;
};

struct Picked {
  std::size_t cell;
  DirectionPair pair;
  double weight;
};

/// Cells of one bin of theta_h and theta_d.
void pick(const AnisotropicTable& table, int i, int j, int samples, std::vector<Picked>& picked) {
  const AnisotropicGrid& grid = table.grid;
  const int count = grid.phi_h * grid.phi_d;
  Spread spread(count, 977 * i + 331 * j);
  const std::size_t first = picked.size();
  int tried = 0;
  for (; tried < count && picked.size() < first + static_cast<std::size_t>(samples); ++tried) {
    const int at = spread.next(), m = at / grid.phi_d, k = at % grid.phi_d;
    const std::size_t cell = grid.index(i, m, j, k);
    if (!table.valid[cell]) continue;
    const DirectionPair pair = directions4(grid.centre(i, m, j, k));
    const double counts = fit_weight(pair);
    if (counts > 0) picked.push_back({cell, pair, counts});
  }
  // What was picked stands for the valid ones among all cells of the bin.
  for (std::size_t n = first; n < picked.size(); ++n) picked[n].weight *= static_cast<double>(samples) / tried;
}

AnisotropicSlice make_slice(const AnisotropicTable& table, const AnisotropicStructure& structure, int j,
                            CellMeasure measure, int samples, double scale) {
  std::vector<Picked> picked;
  for (int i = 0; i < table.grid.theta_h; ++i) {
    const std::size_t first = picked.size();
    pick(table, i, j, samples, picked);
    if (measure == CellMeasure::per_cell) continue;
    const HalfDifference4 at = table.grid.centre(i, 0, j, 0);
    const double solid_angle = std::sin(at.theta_h) * (i + 0.5) / table.grid.theta_h * std::sin(2 * at.theta_d);
    for (std::size_t n = first; n < picked.size(); ++n) picked[n].weight *= solid_angle;
  }
  const auto count = static_cast<Eigen::Index>(picked.size());
  const std::size_t padded = (picked.size() + kPointBlock - 1) / kPointBlock * kPointBlock;
  AnisotropicSlice slice;
  slice.difference = 1 - std::sqrt(1 - std::sin(table.grid.centre(0, 0, j, 0).theta_d));
  for (auto* numbers :
       {&slice.measured[0], &slice.measured[1], &slice.measured[2], &slice.cos_i, &slice.cos_o, &slice.weight}) {
    numbers->assign(padded, 0.0F);
  }
  Directions wo(count, 3), wi(count, 3);
  for (std::size_t n = 0; n < picked.size(); ++n) {
    const auto& [cell, pair, weight] = picked[n];
    const auto row = static_cast<Eigen::Index>(n);
    wo.row(row) = pair.wo.transpose().array();
    wi.row(row) = pair.wi.transpose().array();
    for (std::size_t c = 0; c < 3; ++c) {
      slice.measured[c][n] = static_cast<float>(static_cast<double>(table.values[c][cell]) * scale);
    }
    slice.cos_i[n] = static_cast<float>(pair.wi.z());
    slice.cos_o[n] = static_cast<float>(pair.wo.z());
    slice.weight[n] = static_cast<float>(weight);
  }
  slice.points = anisotropic_points(structure, {wo.data(), count}, {wi.data(), count}, count);
  return slice;
}

}  // namespace

AnisotropicCells anisotropic_cells(const AnisotropicTable& table, const AnisotropicStructure& structure,
                                   CellMeasure measure, int samples) {
  require_table("fit_anisotropic", table);
  AnisotropicCells cells{.slices = std::vector<AnisotropicSlice>(static_cast<std::size_t>(table.grid.theta_d)),
                         .scale = fit_scale(table.values, table.valid_cells())};
  tbb::parallel_for(std::size_t{0}, cells.slices.size(), [&](std::size_t j) {
    cells.slices[j] = make_slice(table, structure, static_cast<int>(j), measure, samples, cells.scale);
  });
  for (const AnisotropicSlice& slice : cells.slices) {
    for (const float weight : slice.weight) cells.total_weight += 3 * static_cast<double>(weight);
  }
  if (!(cells.total_weight > 0)) {
    throw std::invalid_argument("fit_anisotropic: table '" + table.name + "' has no valid cell above the horizon");
  }
  return cells;
}

}  // namespace sklar::brdf
