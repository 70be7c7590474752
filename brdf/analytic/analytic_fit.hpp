#pragma once
/// Fitting any registered analytic model to a measured table: the same cells, objective and search for each.

#include <string>
#include <string_view>
#include <vector>

#include "brdf/analytic/info.hpp"
#include "brdf/data/measured_table.hpp"
#include "brdf/progress.hpp"

namespace sklar::brdf {

/// How long to search.
struct AnalyticFitOptions {
  int shapes = 6;  ///< starts beside the defaults and the examples, times the number of free values that are not
                   ///< per channel, over which they are spread; >= 0
  int evaluations =
      20;  ///< of objective and gradient in a stage of the last searches, times the number of free values;
           ///< >= 1
};

/// How the search ended.
enum class AnalyticFitStatus {
  converged,        ///< the search that gave the values ended by its tolerance
  max_evaluations,  ///< the best values seen within AnalyticFitOptions::evaluations
  black,            ///< every measured value is 0: the values are those of the darkest model found
  underdetermined   ///< fewer measured numbers than values: the values are one choice of many
};
[[nodiscard]] std::string_view to_text(AnalyticFitStatus status);  ///< "converged", "max_evaluations", ...

/// A point from which a search starts, and the objective there.
struct AnalyticStart {
  AnalyticValues values;
  double objective;
};

/// The values found, the model of them, and how the search went.
struct AnalyticFit {
  AnalyticValues values;  ///< isotropic, within their bounds
  BrdfPtr brdf;           ///< AnalyticInfo::make of them
  double objective = 0;   ///< BalancedError with softness 0.003, mean over channels; at most that of every start
  AnalyticFitStatus status = AnalyticFitStatus::converged;
  int evaluations = 0;                ///< of the model over the cells of the fit, those for differences counted
  std::size_t cells = 0;              ///< of the table that the cells of the fit stand for
  std::vector<AnalyticStart> starts;  ///< the defaults, the examples, and the spread shapes
};

/// Local searches from many starts. The values per channel are fitted first for each start; then all values, from the
/// best of them, in stages in which the absolute values of the objective become sharper, by SLSQP with differences as
/// slopes. Parameters with isotropic_as stay tied, so that an anisotropic model is fitted as an isotropic one. Runs on
/// the threads of oneTBB; the same for any number of them. About a second of processor time for a model of one lobe,
/// up to seven for one of three.
/// @throws std::invalid_argument for options out of range, and as fit_cells does for the table.
[[nodiscard]] AnalyticFit fit_analytic(const AnalyticInfo& info, const MeasuredTable& table,
                                       const AnalyticFitOptions& options = {}, const Progress& progress = {});

}  // namespace sklar::brdf
