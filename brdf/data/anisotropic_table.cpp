#include "brdf/data/anisotropic_table.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;

struct Weighted {
  double difference = 0;
  double total = 0;
};

/// |f - g| and g of one row of cells of `table` against its folding.
Weighted compare_row(const AnisotropicTable& table, const AnisotropicTable& mean, int i) {
  const AnisotropicGrid& grid = table.grid;
  Weighted sum;
  for (int m = 0; m < grid.stored_phi_h(); ++m) {
    for (int j = 0; j < grid.theta_d; ++j) {
      for (int k = 0; k < grid.phi_d; ++k) {
        const std::size_t cell = grid.index(i, m, j, k);
        if (!table.valid[cell]) continue;
        const std::size_t other = mean.grid.index(i, m, j, k);
        const double light = grid.light(i, j, k);
        for (std::size_t channel = 0; channel < 3; ++channel) {
          const double g = static_cast<double>(mean.values[channel][other]);
          sum.difference += light * std::abs(static_cast<double>(table.values[channel][cell]) - g);
          sum.total += light * g;
        }
      }
    }
  }
  return sum;
}

/// Row i of `mean`: the average of all cells of `table` that are stored in one.
void fold_row(const AnisotropicTable& table, AnisotropicTable& mean, int i) {
  const AnisotropicGrid& grid = mean.grid;
  const std::size_t first = grid.index(i, 0, 0, 0);
  const std::size_t count = grid.stored_cells() / static_cast<std::size_t>(grid.theta_h);
  std::vector<double> sums(3 * count);
  std::vector<int> counts(count);
  for (int m = 0; m < grid.phi_h; ++m) {
    for (int j = 0; j < grid.theta_d; ++j) {
      for (int k = 0; k < grid.phi_d; ++k) {
        const std::size_t from = table.grid.index(i, m, j, k);
        if (!table.valid[from]) continue;
        const std::size_t to = grid.index(i, m, j, k) - first;
        ++counts[to];
        for (std::size_t channel = 0; channel < 3; ++channel) {
          sums[3 * to + channel] += static_cast<double>(table.values[channel][from]);
        }
      }
    }
  }
  for (std::size_t n = 0; n < count; ++n) {
    if (counts[n] == 0) continue;
    mean.valid[first + n] = 1;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      mean.values[channel][first + n] = static_cast<float>(sums[3 * n + channel] / counts[n]);
    }
  }
}

}  // namespace

std::size_t AnisotropicGrid::stored_cells() const {
  return static_cast<std::size_t>(theta_h) * static_cast<std::size_t>(stored_phi_h()) *
         static_cast<std::size_t>(theta_d) * static_cast<std::size_t>(phi_d);
}

HalfDifference4 AnisotropicGrid::centre(int i, int m, int j, int k) const {
  const double x = (i + 0.5) / theta_h;
  return {.theta_h = x * x * kPi / 2,
          .phi_h = (m + 0.5) / phi_h * 2 * kPi,
          .theta_d = (j + 0.5) / theta_d * kPi / 2,
          .phi_d = (k + 0.5) / phi_d * kPi};
}

double AnisotropicGrid::light(int i, int j, int k) const {
  const HalfDifference4 at = centre(i, 0, j, k);
  const double level = std::cos(at.theta_h) * std::cos(at.theta_d);
  const double tilt = std::sin(at.theta_h) * std::sin(at.theta_d) * std::cos(at.phi_d);
  const double cosines = (level - tilt) * (level + tilt);
  if (!(cosines > 0)) return 0;
  const double step_h = kPi / 2 * (2 * i + 1) / theta_h / theta_h;
  const double half = std::sin(at.theta_h) * step_h * 2 * kPi / phi_h;
  const double difference = std::sin(at.theta_d) * (kPi / 2 / theta_d) * (kPi / phi_d);
  return cosines * 4 * std::cos(at.theta_d) * half * difference;
}

void AnisotropicGrid::require(std::string_view function) const {
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument(std::string(function) + ": the grid " + what);
  };
  for (const int count : {theta_h, phi_h, theta_d, phi_d, turns}) {
    if (count < 1) fail("has a count of " + std::to_string(count) + ", expected 1 or more");
  }
  if (phi_h % turns != 0 || (mirrored && phi_h / turns % 2 != 0)) {
    fail("has " + std::to_string(phi_h) + " cells of phi_h, which " + std::to_string(turns) + " turns" +
         (mirrored ? " and the mirror" : "") + " do not divide");
  }
  std::size_t cells = 1;
  for (const int count : {theta_h, stored_phi_h(), theta_d, phi_d}) {
    if (static_cast<std::size_t>(count) > kMostCells / cells) {
      fail("has more than " + std::to_string(kMostCells) + " cells");
    }
    cells *= static_cast<std::size_t>(count);
  }
}

std::size_t AnisotropicTable::valid_cells() const {
  return static_cast<std::size_t>(std::count(valid.begin(), valid.end(), std::uint8_t{1}));
}

void require_table(std::string_view function, const AnisotropicTable& table) {
  table.grid.require(function);
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument(std::string(function) + ": table '" + table.name + "' " + what);
  };
  const std::size_t cells = table.grid.stored_cells();
  if (table.valid.size() != cells) {
    fail("has a mask of " + std::to_string(table.valid.size()) + " cells, expected " + std::to_string(cells));
  }
  for (const std::vector<float>& plane : table.values) {
    if (plane.size() != cells) {
      fail("has a plane of " + std::to_string(plane.size()) + " cells, expected " + std::to_string(cells));
    }
    const auto bad = std::find_if(plane.begin(), plane.end(), [](float f) { return !(f >= 0 && std::isfinite(f)); });
    if (bad != plane.end()) {
      fail("holds " + sklar::to_text(static_cast<double>(*bad)) + ", expected finite values >= 0");
    }
  }
  if (table.valid_cells() == 0) fail("has no valid cell");
}

AnisotropicTable folded(const AnisotropicTable& table, int turns, bool mirrored) {
  require_table("folded", table);
  AnisotropicTable mean{table.name, table.provenance, table.grid, table.report, {}, {}};
  mean.grid.turns = turns;
  mean.grid.mirrored = mirrored;
  mean.grid.require("folded");
  // The mean over phi_h takes in both halves of a mirrored period.
  if (turns % table.grid.turns != 0 || (table.grid.mirrored && !mirrored && turns != table.grid.phi_h)) {
    throw std::invalid_argument("folded: the table has symmetries that are not asked for");
  }
  const std::size_t cells = mean.grid.stored_cells();
  mean.valid.assign(cells, 0);
  for (std::vector<float>& plane : mean.values) plane.assign(cells, 0.0F);
  tbb::parallel_for(0, mean.grid.theta_h, [&](int i) { fold_row(table, mean, i); });
  return mean;
}

double deviation(const AnisotropicTable& table, int turns, bool mirrored) {
  const AnisotropicTable mean = folded(table, turns, mirrored);
  std::vector<Weighted> rows(static_cast<std::size_t>(table.grid.theta_h));
  tbb::parallel_for(0, table.grid.theta_h,
                    [&](int i) { rows[static_cast<std::size_t>(i)] = compare_row(table, mean, i); });
  Weighted sum;
  for (const Weighted& row : rows) {
    sum.difference += row.difference;
    sum.total += row.total;
  }
  return sum.total > 0 ? sum.difference / sum.total : 0.0;
}

AnisotropicTable fold_symmetric(AnisotropicTable table, double tolerance) {
  const AnisotropicGrid& grid = table.grid;
  table.report.isotropy_deviation = isotropy_deviation(table);
  if (table.report.isotropy_deviation <= tolerance) return folded(table, grid.phi_h, false);
  if (grid.turns % 2 != 0 && grid.phi_h % (2 * grid.turns) == 0) {
    table.report.half_turn_deviation = deviation(table, 2 * grid.turns, grid.mirrored);
    if (table.report.half_turn_deviation <= tolerance) table = folded(table, 2 * grid.turns, grid.mirrored);
  }
  if (!grid.mirrored && grid.phi_h / grid.turns % 2 == 0) {
    table.report.mirror_deviation = deviation(table, grid.turns, true);
    if (table.report.mirror_deviation <= tolerance) table = folded(table, grid.turns, true);
  }
  return table;
}

}  // namespace sklar::brdf
