#include "brdf/basis/fit_cells.hpp"

#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "brdf/data/cell_directions.hpp"

namespace sklar::brdf {

std::vector<FitCell> spread_cells(const MeasuredTable& table, std::size_t about) {
  std::size_t step = std::max<std::size_t>(table.valid_cells() / std::max<std::size_t>(about, 1), 1);
  while (std::gcd(step, std::size_t{Grid::phi_d}) != 1) ++step;
  std::vector<FitCell> cells;
  std::size_t count = 0;
  for (int cell = 0; cell < Grid::cells; ++cell) {
    const auto n = static_cast<std::size_t>(cell);
    if (table.valid[n] == 0 || count++ % step != 0) continue;
    const int k = cell % Grid::phi_d, j = cell / Grid::phi_d % Grid::theta_d, i = cell / (Grid::phi_d * Grid::theta_d);
    const DirectionPair pair = cell_directions(i, j, k);
    if (!(pair.wi.z() > 0 && pair.wo.z() > 0)) continue;
    cells.push_back({pair.wo, pair.wi, {table.values[0][n], table.values[1][n], table.values[2][n]}});
  }
  if (cells.empty()) {
    throw std::invalid_argument("table '" + table.name + "' has no valid cell above the horizon among those to fit");
  }
  return cells;
}

double log_error(const Brdf& model, const std::vector<FitCell>& cells) {
  const double cos_80 = std::cos(80 * std::numbers::pi / 180);
  double inside = 0, all = 0;
  std::size_t count = 0;
  for (const FitCell& cell : cells) {
    const Rgb g = model.eval(cell.wo, cell.wi).max(0.0);
    const double error = ((cell.value * cell.wi.z()).log1p() - (g * cell.wi.z()).log1p()).abs().mean();
    all += error;
    if (std::min(cell.wi.z(), cell.wo.z()) < cos_80) continue;
    inside += error;
    ++count;
  }
  return count > 0 ? inside / static_cast<double>(count) : all / static_cast<double>(cells.size());
}

}  // namespace sklar::brdf
