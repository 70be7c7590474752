#pragma once
/// What the models of one material cost and how near they come, from small to large.

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "brdf/study/refined_budget.hpp"

namespace sklar::brdf {

/// One model. Figures are NaN where error says why there is none.
struct ModelTradeoffRow {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string mode = {};       ///< "paper", "refined"
  std::string family = {};     ///< FamilyInfo::name
  std::string structure = {};  ///< "6 slices"; "5 x 16 x 11": components, coefficients along theta_h and theta_d
  std::size_t bytes = 0;       ///< Brdf::bytes
  double batch_ns = kNone;     ///< an RGB value, one thread; see evaluation_ns
  double single_ns = kNone;    ///< see single_evaluation_ns
  double fit_s = kNone;        ///< wall clock, all threads
  double log1p_mae = kNone;    ///< CellErrors, mean over channels
  double logrel_mae = kNone;
  bool best_for_bytes = false;  ///< no other is better in one of bytes and log1p_mae and as good in the other
  bool best_for_ns = false;     ///< the same of batch_ns
  std::string error = {};
};

/// Which models are fitted.
struct ModelTradeoffOptions {
  std::vector<int> slices = {1, 3, 6, 15, 30};                ///< of the paper's models; divisors of 90
  std::vector<RefinedStructure> ladder = structure_ladder();  ///< of the refined ones
  RefinedFitOptions refined = {.bits = kLadderBits};          ///< its structure and families are not used
};

/// Fits every family in the paper's mode with each number of slices, and refined with each structure.
/// @param progress called with what is being done, for a person to read.
/// @throws what fit_paper and fit_refined throw for a bad table or bad options.
[[nodiscard]] std::vector<ModelTradeoffRow> measure_model_tradeoff(
    const MeasuredTable& table, std::span<const FamilyInfo* const> families, const ModelTradeoffOptions& options = {},
    const std::function<void(const std::string&)>& progress = {});

/// Sets best_for_bytes and best_for_ns of every row.
void mark_best(std::span<ModelTradeoffRow> rows);

}  // namespace sklar::brdf
