#include "brdf/study/metrics.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "brdf/data/cell_directions.hpp"

namespace sklar::brdf {
namespace {

constexpr int kRow = Grid::theta_d * Grid::phi_d;  ///< cells of one theta_h, the unit of parallel work
constexpr double kFloor = 1e-3;                    ///< of w and of the ratio in logrel_mae

/// Calls visit(cell, directions) for the cells of one theta_h where `wanted` is not 0.
template <typename Visit>
void for_each_cell(int i, const std::vector<std::uint8_t>& wanted, Visit visit) {
  for (int j = 0; j < Grid::theta_d; ++j) {
    for (int k = 0; k < Grid::phi_d; ++k) {
      const auto cell = static_cast<std::size_t>(Grid::index(i, j, k));
      if (wanted[cell] == 0) continue;
      visit(cell, cell_directions(i, j, k));
    }
  }
}

struct Sums {
  Rgb log1p = Rgb::Zero(), logrel = Rgb::Zero(), cuberoot = Rgb::Zero(), difference = Rgb::Zero(), power = Rgb::Zero();
  std::size_t cells = 0;

  void add(const Rgb& f, const Rgb& g, double cos_i, double cos_o) {
    const double w = std::max(cos_i * cos_o, kFloor);
    for (int channel = 0; channel < 3; ++channel) {
      const double a = f[channel] * cos_i;
      const double b = g[channel] * cos_i;
      const double root = std::cbrt(a) - std::cbrt(b);
      log1p[channel] += std::abs(std::log1p(a) - std::log1p(std::max(b, 0.0)));
      logrel[channel] += std::abs(std::log((f[channel] * w + kFloor) / (std::max(g[channel], 0.0) * w + kFloor)));
      cuberoot[channel] += root * root;
      difference[channel] += (a - b) * (a - b);
      power[channel] += a * a;
    }
    ++cells;
  }

  void add(const Sums& other) {
    log1p += other.log1p;
    logrel += other.logrel;
    cuberoot += other.cuberoot;
    difference += other.difference;
    power += other.power;
    cells += other.cells;
  }
};

Rgb at(const CellValues& values, std::size_t cell) {
  return {values[0][cell], values[1][cell], values[2][cell]};
}

/// @throws std::invalid_argument if no cell took part.
CellErrors errors_of(const std::vector<Sums>& rows) {
  Sums total;
  for (const Sums& row : rows) total.add(row);  // in order, so that the sum does not depend on threads
  if (total.cells == 0) {
    throw std::invalid_argument("cell_errors: the table has no valid cell with both angles at most 80 degrees");
  }
  const auto n = static_cast<double>(total.cells);
  return {.log1p_mae = total.log1p / n,
          .logrel_mae = total.logrel / n,
          .cuberoot_rms = (total.cuberoot / n).sqrt(),
          .rel_l2 = (total.difference == 0).select(Rgb::Zero(), (total.difference / total.power).sqrt()),
          .cells = total.cells};
}

}  // namespace

CellValues predict(const Brdf& model, const MeasuredTable& reference) {
  require_table("predict", reference);
  CellValues values;
  for (auto& plane : values) plane.assign(Grid::cells, 0.0);
  tbb::parallel_for(0, Grid::theta_h, [&](int i) {
    std::vector<std::size_t> cells;
    Directions wo(kRow, 3);
    Directions wi(kRow, 3);
    for_each_cell(i, reference.valid, [&](std::size_t cell, const DirectionPair& pair) {
      const auto row = static_cast<Eigen::Index>(cells.size());
      wo.row(row) = pair.wo.transpose().array();
      wi.row(row) = pair.wi.transpose().array();
      cells.push_back(cell);
    });
    const auto count = static_cast<Eigen::Index>(cells.size());
    const RgbRows f = model.eval(wo.topRows(count), wi.topRows(count));
    for (std::size_t n = 0; n < cells.size(); ++n) {
      for (int c = 0; c < 3; ++c) values[static_cast<std::size_t>(c)][cells[n]] = f(static_cast<Eigen::Index>(n), c);
    }
  });
  return values;
}

CellErrors cell_errors(const MeasuredTable& reference, const CellValues& predicted) {
  require_table("cell_errors", reference);
  for (const std::vector<double>& plane : predicted) {
    if (plane.size() != Grid::cells) {
      throw std::invalid_argument("cell_errors: predicted has a plane of " + std::to_string(plane.size()) +
                                  " cells, expected " + std::to_string(Grid::cells));
    }
  }
  const double lowest = std::cos(80 * std::numbers::pi / 180);
  std::vector<Sums> rows(Grid::theta_h);
  tbb::parallel_for(0, Grid::theta_h, [&](int i) {
    for_each_cell(i, reference.valid, [&](std::size_t cell, const DirectionPair& pair) {
      if (pair.wi.z() < lowest || pair.wo.z() < lowest) return;
      rows[static_cast<std::size_t>(i)].add(at(reference.values, cell), at(predicted, cell), pair.wi.z(), pair.wo.z());
    });
  });
  return errors_of(rows);
}

CellErrors cell_errors(const AnisotropicTable& reference, const Brdf& model) {
  require_table("cell_errors", reference);
  const AnisotropicGrid& grid = reference.grid;
  const double lowest = std::cos(80 * std::numbers::pi / 180);
  std::vector<Sums> rows(static_cast<std::size_t>(grid.theta_h * grid.stored_phi_h()));
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t row) {
    const int i = static_cast<int>(row) / grid.stored_phi_h(), m = static_cast<int>(row) % grid.stored_phi_h();
    const Eigen::Index most = Eigen::Index{grid.theta_d} * grid.phi_d;
    Directions wo(most, 3), wi(most, 3);
    std::vector<std::size_t> cells;
    for (int j = 0; j < grid.theta_d; ++j) {
      for (int k = 0; k < grid.phi_d; ++k) {
        const std::size_t cell = grid.index(i, m, j, k);
        const DirectionPair pair = directions4(grid.centre(i, m, j, k));
        if (!reference.valid[cell] || pair.wi.z() < lowest || pair.wo.z() < lowest) continue;
        wo.row(static_cast<Eigen::Index>(cells.size())) = pair.wo.transpose().array();
        wi.row(static_cast<Eigen::Index>(cells.size())) = pair.wi.transpose().array();
        cells.push_back(cell);
      }
    }
    const auto count = static_cast<Eigen::Index>(cells.size());
    const RgbRows g = model.eval(wo.topRows(count), wi.topRows(count));
    for (Eigen::Index n = 0; n < count; ++n) {
      const std::size_t cell = cells[static_cast<std::size_t>(n)];
      const Rgb f(reference.values[0][cell], reference.values[1][cell], reference.values[2][cell]);
      rows[row].add(f, g.row(n).transpose(), wi(n, 2), wo(n, 2));
    }
  });
  return errors_of(rows);
}

}  // namespace sklar::brdf
