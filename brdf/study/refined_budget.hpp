#pragma once
/// The cheapest refined model that meets a budget.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "brdf/model/refined_fit.hpp"
#include "brdf/study/budget.hpp"

namespace sklar::brdf {

/// What is tried of each structure.
struct BudgetSearch {
  std::vector<FamilyInfo> families = {};     ///< each for all components
  std::vector<FamilyInfo> substitutes = {};  ///< for single components of the fit with the last of them
  std::vector<int> bits = {8, 10, 12, 14};   ///< of a stored coefficient
  /// Numbers of coefficients along half and difference by which red and blue differ from green, beside those of the
  /// structure: channels share less or more. Each with the best of the families.
  std::vector<std::array<int, 2>> colours = {};
};

/// Independence and Frank; every registered family that can couple, in every rotation, as a substitute; colours of 4 x
/// 4 and 8 x 10.
[[nodiscard]] BudgetSearch usual_search();

/// One model of the front.
struct FrontPoint {
  RefinedFit fit = {};
  std::string family = {};  ///< of all components, or "mixed"
  int bits = 0;
  ModelFigures figures = {};
};

/// Structures from 0.5 to 16 KB at kLadderBits, each larger and more exact than the one before.
[[nodiscard]] const std::vector<RefinedStructure>& structure_ladder();
inline constexpr int kLadderBits = 12;

/// Bytes of a model of this structure. @param coupled whether its components have copulas.
[[nodiscard]] std::size_t stored_bytes(const RefinedStructure& structure, int bits, bool coupled);

/// The largest of the ladder with at most this many bytes, copulas included.
/// @throws std::runtime_error naming the smallest where there is none.
[[nodiscard]] RefinedStructure largest_structure(double max_bytes, int bits);

/// The front of the models fitted, and the one that serves the budget.
struct BudgetChoice {
  std::vector<FrontPoint> front;  ///< of all models fitted those with none both smaller and more exact, by bytes
  std::size_t chosen;             ///< index in front
};

/// With max_error, goes up the ladder and takes the smallest model of the first structure that reaches it; else the
/// most exact one of the two largest structures that fit, further down where these are too slow. A structure is fitted
/// once a family, once more from there where choose_families finds better ones, and once a colour; its precisions share
/// the fit. The
/// structure, the families and the bits of `options` are not used.
/// @param progress called with what is being done.
/// @throws std::invalid_argument for a budget that is not positive; std::runtime_error naming the best model where none
/// meets it.
[[nodiscard]] BudgetChoice choose_model(const MeasuredTable& table, const Budget& budget,
                                        const BudgetSearch& search = usual_search(), RefinedFitOptions options = {},
                                        const std::function<void(const std::string&)>& progress = {});

/// Fits the largest structure of the ladder within max_bytes, with the first of each list of `search`.
[[nodiscard]] BudgetChoice fit_largest(const MeasuredTable& table, double max_bytes, const BudgetSearch& search,
                                       RefinedFitOptions options = {},
                                       const std::function<void(const std::string&)>& progress = {});

/// The front as a Markdown table, the chosen row marked.
[[nodiscard]] std::string to_markdown(const BudgetChoice& choice);

}  // namespace sklar::brdf
