#pragma once
/// What a model may cost and must reach, and what a fitted one does.

#include <cstddef>
#include <limits>
#include <string>

#include "brdf/brdf.hpp"
#include "brdf/study/metrics.hpp"

namespace sklar::brdf {

struct Budget {
  double max_error = 0;                                        ///< mean log1p_mae over channels; 0 asks for nothing
  double max_bytes = std::numeric_limits<double>::infinity();  ///< of storage
  double max_ns = std::numeric_limits<double>::infinity();     ///< an RGB value in a batch, one thread

  /// Whether anything is asked for.
  [[nodiscard]] bool limits() const;
};

/// @throws std::invalid_argument naming the caller and a number that is not positive.
void require_budget(const Budget& budget, const std::string& caller);

/// @throws std::runtime_error where the smallest model there is has more bytes than the budget.
void require_bytes(const Budget& budget, std::size_t smallest);

/// What a budget may limit, of one model.
struct ModelFigures {
  std::size_t bytes = 0;                 ///< Brdf::bytes
  double log1p_mae = 0, logrel_mae = 0;  ///< CellErrors, mean over channels
  double eval_ns = 0;                    ///< evaluation_ns
  double fit_s = 0;                      ///< wall clock, all threads
};

/// All but the time of the fit.
[[nodiscard]] ModelFigures figures_of(const Brdf& brdf, const CellErrors& errors);

/// Whether no figure is above its limit.
[[nodiscard]] bool meets(const ModelFigures& figures, const Budget& budget);

/// "no model meets the budget; the most exact one has .."
[[nodiscard]] std::string missed_budget(const ModelFigures& most_exact);

}  // namespace sklar::brdf
