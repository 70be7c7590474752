#include "brdf/model/refined_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

/// Adds to log f_r. The weights of a spline sum to 1.
void shift(const RefinedLayout& layout, int components, double by, std::vector<double>& x) {
  for (int k = 0; k < components; ++k) {
    const auto first = x.begin() + layout.first(k, RefinedPart::shape);
    std::for_each(first, first + layout.count(k, RefinedPart::shape), [by](double& value) { value += by; });
  }
}

/// @param x the start, in the units of the cells
RefinedFit search_from(std::vector<double> x, const RefinedProblem& problem, const RefinedFitOptions& options,
                       const std::vector<FamilyInfo>& families, double log_scale, const Progress& progress) {
  const StagedSearch search = search_in_stages(staged(problem), options.objective, options.evaluations, progress, x);
  const int components = options.structure.components;
  shift(problem.layout(), components, -log_scale, x);
  PackedCoefficients packed = pack(problem.layout(), options.bits, x);
  return {.brdf = std::make_shared<RefinedBrdf>(options.structure, families, std::move(packed)),
          .coefficients = x,
          .start = search.start,
          .objective = search.objective,
          .evaluations = search.evaluations,
          .converged = search.converged};
}

void require_fit_options(const RefinedFitOptions& options) {
  require_structure(options.structure);
  require_bits("refined model", options.bits);
  if (options.evaluations < 1) throw std::invalid_argument("fit_refined: evaluations must be at least 1");
}

void require_same_structure(const RefinedFitOptions& options, const RefinedFit& from) {
  if (from.brdf == nullptr || options.structure != from.brdf->structure()) {
    throw std::invalid_argument("refit_refined: the fit to start from has another structure");
  }
}

/// The coefficients of a fit for other families, in the units of the cells.
std::vector<double> carried_over(const RefinedFit& from, const std::vector<FamilyInfo>& families,
                                 const RefinedLayout& layout, double log_scale) {
  std::vector<double> x(static_cast<std::size_t>(layout.size()), 0.0);
  for (int k = 0; k < from.brdf->structure().components; ++k) {
    const auto at = static_cast<std::size_t>(k);
    for (const RefinedPart part : kRefinedParts) {
      const auto first = from.coefficients.begin() + from.brdf->layout().first(k, part);
      const auto to = x.begin() + layout.first(k, part);
      if (part != RefinedPart::coupling) {
        std::copy_n(first, layout.count(k, part), to);
        continue;
      }
      const FamilyInfo& old_family = from.brdf->families()[at];
      if (layout.count(k, part) == 0 || old_family.parameters.empty()) continue;
      const Coupling before(old_family), after(families[at]);
      std::transform(first, first + layout.count(k, part), to,
                     [&](double dependence) { return after.dependence(before.tau(dependence)); });
    }
  }
  shift(layout, from.brdf->structure().components, log_scale, x);
  return x;
}

}  // namespace

RefinedFit fit_refined(const MeasuredTable& table, const RefinedFitOptions& options, const Progress& progress) {
  require_fit_options(options);
  const std::vector<FamilyInfo> families = families_of(options);
  const std::vector<bool> copulas = coupled(families);
  if (std::find(copulas.begin(), copulas.end(), true) != copulas.end() && options.evaluations > 1) {
    RefinedFitOptions margins = options, all = options;
    margins.families.clear();
    margins.evaluations = std::max(1, options.evaluations / 4);
    all.evaluations -= margins.evaluations;
    const RefinedFit first = fit_refined(table, margins);
    RefinedFit result = refit_refined(table, all, first, progress);
    result.start = first.start;
    result.evaluations += first.evaluations;
    return result;
  }
  RefinedCells cells = refined_cells(table, options.measure, options.structure, options.importance.get());
  const double log_scale = std::log(cells.scale);
  const RefinedProblem problem(options.structure, families, std::move(cells));
  return search_from(problem.start(), problem, options, families, log_scale, progress);
}

RefinedFit refit_refined(const MeasuredTable& table, const RefinedFitOptions& options, const RefinedFit& from,
                         const Progress& progress) {
  require_fit_options(options);
  require_same_structure(options, from);
  const std::vector<FamilyInfo> families = families_of(options);
  RefinedCells cells = refined_cells(table, options.measure, options.structure, options.importance.get());
  const double log_scale = std::log(cells.scale);
  const RefinedProblem problem(options.structure, families, std::move(cells));
  return search_from(carried_over(from, families, problem.layout(), log_scale), problem, options, families, log_scale,
                     progress);
}

RefinedFit with_bits(RefinedFit fit, int bits) {
  require_bits("refined model", bits);
  const RefinedBrdf& fitted = *fit.brdf;
  fit.brdf = std::make_shared<RefinedBrdf>(fitted.structure(), fitted.families(),
                                           pack(fitted.layout(), bits, fit.coefficients));
  return fit;
}

std::vector<FamilyInfo> choose_families(const MeasuredTable& table, const RefinedFitOptions& options,
                                        const RefinedFit& from, const std::vector<FamilyInfo>& candidates) {
  require_same_structure(options, from);
  const RefinedCells cells = refined_cells(table, options.measure, options.structure, options.importance.get());
  const double log_scale = std::log(cells.scale);
  const LossWeights weights = final_weights(options.objective);
  std::vector<double> gradient;
  const auto objective = [&](const std::vector<FamilyInfo>& families) {
    const RefinedProblem problem(options.structure, families, cells);
    return problem.evaluate(weights, carried_over(from, families, problem.layout(), log_scale), gradient);
  };
  std::vector<FamilyInfo> result = from.brdf->families();
  for (std::size_t k = 0; k < result.size(); ++k) {
    std::vector<FamilyInfo> families = from.brdf->families();
    double least = objective(families);
    for (const FamilyInfo& candidate : candidates) {
      families[k] = candidate;
      const double value = objective(families);
      if (!(value < least)) continue;
      least = value;
      result[k] = candidate;
    }
  }
  return result;
}

}  // namespace sklar::brdf
