#include "copula/inference/cells.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "copula/error.hpp"
#include "copula/inference/checks.hpp"

namespace sklar {
namespace {

Index cell_count(std::span<const Index> shape) {
  if (shape.size() < 2) {
    throw std::invalid_argument("cell_table: needs 2 or more axes, got " + std::to_string(shape.size()));
  }
  Index cells = 1;
  for (const Index bins : shape) {
    if (bins < 1)
      throw std::invalid_argument("cell_table: every axis needs 1 or more bins, got " + std::to_string(bins));
    cells *= bins;
  }
  return cells;
}

void require_masses(const ColumnRef& masses) {
  for (Index i = 0; i < masses.size(); ++i) {
    if (std::isfinite(masses[i]) && masses[i] >= 0) continue;
    throw std::domain_error("cell_table: masses must be finite and 0 or more, got masses(" + std::to_string(i) +
                            ") = " + to_text(masses[i]));
  }
  if (!(masses > 0).any()) throw std::invalid_argument("cell_table: all masses are zero");
}

/// Calls body(cell, bin) for every cell, bin being its index along the axis.
template <class Body>
void for_each_bin(std::span<const Index> shape, std::size_t axis, Index cells, Body body) {
  Index stride = 1;
  for (std::size_t k = axis + 1; k < shape.size(); ++k) stride *= shape[k];
  for (Index cell = 0; cell < cells; ++cell) body(cell, cell / stride % shape[axis]);
}

}  // namespace

CellTable cell_table(const ColumnRef& masses, std::span<const Index> shape) {
  const Index n = cell_count(shape);
  require_rows("cell_table", "masses", masses.rows(), n);
  require_masses(masses);
  CellTable cells{.u = Points(n, static_cast<Index>(shape.size())),
                  .mass = masses / masses.sum(),
                  .margin = Column::Ones(n),
                  .weight = Column()};
  for (std::size_t axis = 0; axis < shape.size(); ++axis) {
    Column margin = Column::Zero(shape[axis]);
    for_each_bin(shape, axis, n, [&](Index cell, Index bin) { margin[bin] += cells.mass[cell]; });
    margin /= margin.sum();
    Column centre(margin.size());
    double below = 0;
    for (Index bin = 0; bin < margin.size(); ++bin) {
      centre[bin] = std::min(below + 0.5 * margin[bin], 1.0);
      below += margin[bin];
    }
    for_each_bin(shape, axis, n, [&](Index cell, Index bin) {
      cells.u(cell, static_cast<Index>(axis)) = centre[bin];
      cells.margin[cell] *= margin[bin];
    });
  }
  return cells;
}

CellTable count_cells(const PointsRef& u, const ColumnRef& weights, Index bins) {
  require_enough_rows("count_cells", "u", u.rows(), 1);
  require_finite("count_cells", "u", u);
  require_unit_cube("count_cells", "u", u);
  require_weights("count_cells", weights, u.rows());
  const double cells = std::pow(static_cast<double>(bins), static_cast<double>(u.cols()));
  if (bins < 1 || cells > static_cast<double>(kMostCells)) {
    throw std::invalid_argument("count_cells: bins^d must be in 1 to " + std::to_string(kMostCells) + ", got " +
                                std::to_string(bins) + "^" + std::to_string(u.cols()));
  }
  Column counts = Column::Zero(static_cast<Index>(cells));
  for (Index row = 0; row < u.rows(); ++row) {
    Index cell = 0;
    for (Index k = 0; k < u.cols(); ++k) {
      cell = cell * bins + std::min(static_cast<Index>(u(row, k) * static_cast<double>(bins)), bins - 1);
    }
    counts[cell] += weights.size() == 0 ? 1.0 : weights[row];
  }
  return cell_table(counts, std::vector<Index>(static_cast<std::size_t>(u.cols()), bins));
}

std::vector<double> spread_positions(Index n) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  std::vector<double> positions;
  positions.reserve(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i) {
    const double turns = (static_cast<double>(i) + 0.5) * kGoldenRatio;
    positions.push_back(turns - std::floor(turns));
  }
  return positions;
}

CellTable sample_cells(const CellTable& cells, Index most) {
  const Index n = cells.mass.size();
  if (n <= most) return cells;
  const Column weight = cells.weight.size() == 0 ? Column(Column::Ones(n)) : cells.weight;
  const Column probability = 0.5 * (weight > 0).select(1 / static_cast<double>(n) + cells.mass / cells.mass.sum(), 0.0);
  std::vector<double> positions = spread_positions(most);
  std::sort(positions.begin(), positions.end());
  const double total = probability.sum();
  std::vector<Index> chosen;
  std::vector<double> chosen_weight;
  double below = 0;
  auto next = positions.begin();
  for (Index cell = 0; cell < n && next != positions.end(); ++cell) {
    below += probability[cell] / total;
    const auto first = next;
    while (next != positions.end() && *next < below) ++next;
    if (next == first) continue;
    const auto hits = static_cast<double>(next - first);
    chosen.push_back(cell);
    chosen_weight.push_back(weight[cell] * hits * total / (static_cast<double>(most) * probability[cell]));
  }
  return {.u = cells.u(chosen, Eigen::all),
          .mass = cells.mass(chosen),
          .margin = cells.margin(chosen),
          .weight = Eigen::Map<const Column>(chosen_weight.data(), static_cast<Index>(chosen_weight.size()))};
}

}  // namespace sklar
