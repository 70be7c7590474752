#pragma once
/// Fitting a refined model to a measured table.

#include <memory>
#include <vector>

#include "brdf/data/measured_table.hpp"
#include "brdf/model/cell_importance.hpp"
#include "brdf/model/paper_brdf.hpp"
#include "brdf/model/refined_brdf.hpp"
#include "brdf/model/staged_search.hpp"
#include "brdf/progress.hpp"

namespace sklar::brdf {

/// How a refined model is fitted.
struct RefinedFitOptions {
  RefinedStructure structure = {};
  std::vector<FamilyInfo> families = {};  ///< one for all components or one a component; none is independence
  RefinedObjective objective = RefinedObjective::balanced;
  CellMeasure measure = CellMeasure::per_cell;
  int bits = 16;                                               ///< of a stored coefficient, 6 to 16
  int evaluations = 800;                                       ///< of the objective, at most
  std::shared_ptr<const CellImportance> importance = nullptr;  ///< factors of the weights of cells; none is 1
};

struct RefinedFit {
  std::shared_ptr<const RefinedBrdf> brdf;
  std::vector<double> coefficients;  ///< those of brdf before they were rounded, in the order of its layout
  double start = 0;                  ///< objective, mean over cells and channels, at the start
  double objective = 0;              ///< and at the end, before the coefficients are rounded
  int evaluations = 0;
  bool converged = false;  ///< whether the last search ended before its share of the evaluations
};

/// All coefficients together, by L-BFGS with exact gradients, in stages in which the absolute values of the objective
/// become sharper; the copulas join in after a quarter of the evaluations. Only valid cells count; those with an angle
/// beyond 80 degrees a tenth, those with a cosine below 0.02 not at all. Deterministic, whatever the number of threads.
/// @throws std::invalid_argument for options out of range or a table that fails require_table or has no valid cell with
/// both angles at most 80 degrees.
[[nodiscard]] RefinedFit fit_refined(const MeasuredTable& table, const RefinedFitOptions& options = {},
                                     const Progress& progress = {});

/// The same from where another fit of the same structure ended, whatever its families: each copula starts with the
/// nearest tau that its family has. @throws std::invalid_argument also for a fit of another structure.
[[nodiscard]] RefinedFit refit_refined(const MeasuredTable& table, const RefinedFitOptions& options,
                                       const RefinedFit& from, const Progress& progress = {});

/// The same fit with coefficients rounded to another number of bits. @throws std::invalid_argument unless 6 to 16.
[[nodiscard]] RefinedFit with_bits(RefinedFit fit, int bits);

/// One family a component: that of the candidates with the least objective where it takes the place of the component's
/// own, at the nearest tau that it has and with all else as it is. The families of `options` are not used.
[[nodiscard]] std::vector<FamilyInfo> choose_families(const MeasuredTable& table, const RefinedFitOptions& options,
                                                      const RefinedFit& from,
                                                      const std::vector<FamilyInfo>& candidates);

}  // namespace sklar::brdf
