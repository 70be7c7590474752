#pragma once
/// The search that the fits of the refined and the anisotropic model share.

#include <functional>
#include <string_view>
#include <vector>

#include "brdf/model/refined_loss.hpp"
#include "brdf/progress.hpp"

namespace sklar::brdf {

/// What a fit makes small; see LossWeights. balanced is 4 log1p + log_relative + 2 image, so that cells and
/// pictures both count.
enum class RefinedObjective { balanced, log1p, log_relative, cube_root, likelihood, image };
[[nodiscard]] std::string_view to_text(RefinedObjective objective);

/// Of its last stage.
[[nodiscard]] LossWeights final_weights(RefinedObjective objective);

/// An objective as a function of all coefficients.
struct StagedProblem {
  /// Returns the value and sets the gradient.
  std::function<double(const LossWeights&, const std::vector<double>& x, std::vector<double>& gradient)> evaluate;
  /// Square roots of the second derivatives by each coefficient, about; never 0.
  std::function<std::vector<double>(const LossWeights&, const std::vector<double>& x)> curvature;
};

/// @param problem RefinedProblem or AnisotropicProblem; kept by reference.
template <class Problem>
[[nodiscard]] StagedProblem staged(const Problem& problem) {
  return {.evaluate = [&](const auto& weights, const auto& x,
                          auto& gradient) { return problem.evaluate(weights, x, gradient); },
          .curvature = [&](const auto& weights, const auto& x) { return problem.curvature(weights, x); }};
}

struct StagedSearch {
  double start = 0;      ///< objective at the start
  double objective = 0;  ///< and at the end
  int evaluations = 0;
  bool converged = false;  ///< whether the last search ended before its share of the evaluations
};

/// L-BFGS in stages in which the absolute values of the objective become sharper, each in coordinates in which all
/// second derivatives are about 1. @param x the start, and then the end.
[[nodiscard]] StagedSearch search_in_stages(const StagedProblem& problem, RefinedObjective objective, int evaluations,
                                            const Progress& progress, std::vector<double>& x);

}  // namespace sklar::brdf
