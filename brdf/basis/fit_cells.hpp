#pragma once
/// Valid cells of a table with their directions, spread evenly, and the error of a model over them.

#include <cmath>
#include <limits>
#include <vector>

#include "brdf/data/measured_table.hpp"

namespace sklar::brdf {

/// A measured value and its directions.
struct FitCell {
  Vec3 wo, wi;  ///< above the horizon; wi is the direction at phi_d
  Rgb value;    ///< f_r, 1/sr
};

/// About so many of the valid cells above the horizon, every n-th of them with n prime to the sides of the grid; all if
/// there are fewer. @throws std::invalid_argument if there is none.
[[nodiscard]] std::vector<FitCell> spread_cells(const MeasuredTable& table, std::size_t about);

/// Mean of |ln(1 + f cos_i) - ln(1 + g cos_i)| over channels and the cells with both angles at most 80 degrees, all
/// cells if there is none; a negative g counts as 0. By it a model's structure is chosen within a budget, whatever its
/// coefficients are fitted by.
[[nodiscard]] double log_error(const Brdf& model, const std::vector<FitCell>& cells);

/// The model of the least log_error among those that `fit` makes of each structure, the first of equals; null for none.
template <class Structures, class Fit>
[[nodiscard]] BrdfPtr best_structure(const Structures& structures, const std::vector<FitCell>& cells, const Fit& fit) {
  BrdfPtr best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& structure : structures) {
    const BrdfPtr model = fit(structure);
    const double error = log_error(*model, cells);
    if (best && !(error < least)) continue;
    least = error;
    best = model;
  }
  return best;
}

/// Weight of (g - f)^2, per channel, that makes it (ln(1 + f c) - ln(1 + g c))^2 to first order: (c / (1 + f c))^2 with
/// c^2 = cos_i cos_o. @param cosines cos_i cos_o.
[[nodiscard]] inline Rgb log_weight(const Rgb& f, double cosines) {
  return cosines / (1 + f * std::sqrt(cosines)).square();
}

}  // namespace sklar::brdf
