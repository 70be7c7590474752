#include "brdf/model/refined_fit.hpp"

#include <cmath>
#include <stdexcept>

#include "brdf/model/refined_problem.hpp"
#include "families/registry.hpp"

namespace sklar::brdf {
namespace {

std::vector<FamilyInfo> families_of(const RefinedFitOptions& options) {
  const auto components = static_cast<std::size_t>(options.structure.components);
  if (options.families.empty()) return std::vector<FamilyInfo>(components, families::find("independence"));
  if (options.families.size() == 1) return std::vector<FamilyInfo>(components, options.families.front());
  if (options.families.size() == components) return options.families;
  throw std::invalid_argument("fit_refined: " + std::to_string(options.families.size()) + " families for " +
                              std::to_string(components) + " components; allowed are 0, 1 or one each");
}

}  // namespace

RefinedFit fit_refined(const MeasuredTable& table, const RefinedFitOptions& options, const Progress& progress) {
  require_structure(options.structure);
  if (options.evaluations < 1) throw std::invalid_argument("fit_refined: evaluations must be at least 1");
  const std::vector<FamilyInfo> families = families_of(options);
  RefinedCells cells = refined_cells(table, options.measure, options.structure.width);
  const double log_scale = std::log(cells.scale);
  const RefinedProblem problem(options.structure, families, std::move(cells));
  std::vector<double> x = problem.start();
  const StagedProblem staged{
      .evaluate = [&](const auto& weights, const auto& at,
                      auto& gradient) { return problem.evaluate(weights, at, gradient); },
      .curvature = [&](const auto& weights, const auto& at) { return problem.curvature(weights, at); }};
  const StagedSearch search = search_in_stages(staged, options.objective, options.evaluations, progress, x);
  const RefinedLayout& layout = problem.layout();
  for (int k = 0; k < options.structure.components; ++k) {  // the weights of a spline sum to 1
    for (int i = 0; i < layout.count(k, RefinedPart::shape); ++i) {
      x[static_cast<std::size_t>(layout.first(k, RefinedPart::shape) + i)] -= log_scale;
    }
  }
  PackedCoefficients packed = pack(layout, options.structure.components, options.bits, x);
  return {.brdf = std::make_shared<RefinedBrdf>(options.structure, families, std::move(packed)),
          .coefficients = x,
          .start = search.start,
          .objective = search.objective,
          .evaluations = search.evaluations,
          .converged = search.converged};
}

}  // namespace sklar::brdf
