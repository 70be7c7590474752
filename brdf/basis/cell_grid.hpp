#pragma once
/// A grid over (theta_h, theta_d, phi_d) like that of the tables, with fewer cells.

#include <cmath>
#include <numbers>

#include "brdf/data/interpolation.hpp"
#include "brdf/data/table_brdf.hpp"

namespace sklar::brdf {

/// Cell centres as those of Grid: theta_h = ((i + .5) / n)^2 90 deg, theta_d = (j + .5) / n 90 deg, phi_d = (k + .5) /
/// n 180 deg. With the sides of Grid it is Grid.
struct CellGrid {
  int theta_h = Grid::theta_h;
  int theta_d = Grid::theta_d;
  int phi_d = Grid::phi_d;

  [[nodiscard]] int cells() const { return theta_h * theta_d * phi_d; }
  [[nodiscard]] int index(int i, int j, int k) const { return k + phi_d * (j + theta_d * i); }

  [[nodiscard]] HalfDifference centre(int i, int j, int k) const {
    const double x = (i + 0.5) / theta_h;
    return {x * x * std::numbers::pi / 2, (j + 0.5) / theta_d * std::numbers::pi / 2,
            (k + 0.5) / phi_d * std::numbers::pi};
  }

  /// Where coordinates lie between the centres: edges clamped, phi_d periodic.
  [[nodiscard]] CellPosition position(const HalfDifference& at) const {
    constexpr double kRight = std::numbers::pi / 2;
    return {.theta_h = between_clamped(theta_h * std::sqrt(at.theta_h / kRight) - 0.5, theta_h),
            .theta_d = between_clamped(theta_d * (at.theta_d / kRight) - 0.5, theta_d),
            .phi_d = between_periodic(phi_d * (at.phi_d / std::numbers::pi) - 0.5, phi_d)};
  }
};

}  // namespace sklar::brdf
