#include "brdf/data/measured_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

}  // namespace

double Grid::theta_h_centre(int i) {
  const double x = (i + 0.5) / theta_h;
  return x * x * kRightAngle;
}

double Grid::theta_d_centre(int j) {
  return (j + 0.5) / theta_d * kRightAngle;
}

double Grid::phi_d_centre(int k) {
  return (k + 0.5) / phi_d * std::numbers::pi;
}

std::string to_text(Provenance provenance) {
  switch (provenance) {
    case Provenance::measured:
      return "measured";
    case Provenance::reconstruction:
      return "reconstruction";
    case Provenance::synthetic:
      return "synthetic";
    case Provenance::unknown:
      break;
  }
  return "unknown";
}

std::size_t MeasuredTable::valid_cells() const {
  return static_cast<std::size_t>(std::count(valid.begin(), valid.end(), std::uint8_t{1}));
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double mirror_asymmetry(const MeasuredTable& table) {
  std::vector<double> ratios;
  ratios.reserve(Grid::cells / 2);
  for (int row = 0; row < Grid::cells; row += Grid::phi_d) {
    for (int k = 0; k < Grid::phi_d / 2; ++k) {
      const auto here = static_cast<std::size_t>(row + k);
      const auto there = static_cast<std::size_t>(row + Grid::phi_d - 1 - k);
      if (!table.valid[here] || !table.valid[there]) continue;
      double difference = 0;
      double mean = 0;
      for (const std::vector<double>& plane : table.values) {
        difference += std::abs(plane[here] - plane[there]);
        mean += 0.5 * (plane[here] + plane[there]);
      }
      if (mean > 0) ratios.push_back(difference / mean);
    }
  }
  return median(std::move(ratios));
}

void require_table(std::string_view function, const MeasuredTable& table) {
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument(std::string(function) + ": table '" + table.name + "' " + what);
  };
  if (table.valid.size() != Grid::cells) {
    fail("has a mask of " + std::to_string(table.valid.size()) + " cells, expected " + std::to_string(Grid::cells));
  }
  for (const std::vector<double>& plane : table.values) {
    if (plane.size() != Grid::cells) {
      fail("has a plane of " + std::to_string(plane.size()) + " cells, expected " + std::to_string(Grid::cells));
    }
    const auto bad = std::find_if(plane.begin(), plane.end(), [](double f) { return !(f >= 0 && std::isfinite(f)); });
    if (bad != plane.end()) fail("holds " + sklar::to_text(*bad) + ", expected finite values >= 0");
  }
  if (table.valid_cells() == 0) fail("has no valid cell");
}

}  // namespace sklar::brdf
