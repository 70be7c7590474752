#pragma once
/// Fitting an anisotropic model to a table over four coordinates.

#include <memory>

#include "brdf/data/anisotropic_table.hpp"
#include "brdf/model/anisotropic_model.hpp"
#include "brdf/model/paper_brdf.hpp"
#include "brdf/model/staged_search.hpp"

namespace sklar::brdf {

/// How an anisotropic model is fitted.
struct AnisotropicFitOptions {
  AnisotropicStructure structure = {};
  RefinedObjective objective = RefinedObjective::balanced;
  CellMeasure measure = CellMeasure::per_cell;
  int bits = 12;          ///< of a stored coefficient, 6 to 16
  int evaluations = 600;  ///< of the objective, at most
  int samples = 48;       ///< cells of a bin of theta_h and theta_d, at most
};

struct AnisotropicFit {
  std::shared_ptr<const AnisotropicModel> brdf;
  double start = 0;      ///< objective, mean over cells and channels, at the start
  double objective = 0;  ///< and at the end, before the coefficients are rounded
  int evaluations = 0;
  bool converged = false;  ///< whether the last search ended before its share of the evaluations
};

/// Whether f_r(phi_h + pi) = f_r(phi_h), to kSymmetricDeviation: where not, structure.tilted is needed.
[[nodiscard]] bool repeats_after_half_turn(const AnisotropicTable& table);

/// All coefficients together, the ellipses included, as fit_refined. Deterministic, whatever the number of threads.
/// @throws std::invalid_argument for options out of range or a table that fails require_table or has no valid cell
/// above the horizon.
[[nodiscard]] AnisotropicFit fit_anisotropic(const AnisotropicTable& table, const AnisotropicFitOptions& options = {},
                                             const Progress& progress = {});

}  // namespace sklar::brdf
