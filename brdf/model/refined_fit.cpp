#include "brdf/model/refined_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "brdf/model/refined_problem.hpp"
#include "copula/inference/minimise.hpp"
#include "families/registry.hpp"

namespace sklar::brdf {
namespace {

constexpr std::array<float, 4> kSoftness = {0.03F, 0.01F, 0.003F, 0.003F};  // of the stages

constexpr float kImage = 2;  // of the relative squared error beside the logarithmic ones

LossWeights weights_of(RefinedObjective objective) {
  switch (objective) {
    case RefinedObjective::balanced:
      return {.log1p = 4, .log_relative = 1, .image = kImage};
    case RefinedObjective::log1p:
      return {.log1p = 1};
    case RefinedObjective::log_relative:
      return {.log_relative = 1};
    case RefinedObjective::cube_root:
      return {.cube_root = 1};
    case RefinedObjective::likelihood:
      return {.likelihood = 1};
    case RefinedObjective::image:
      return {.image = 1};
  }
  return {};
}

std::vector<FamilyInfo> families_of(const RefinedFitOptions& options) {
  const auto components = static_cast<std::size_t>(options.structure.components);
  if (options.families.empty()) return std::vector<FamilyInfo>(components, families::find("independence"));
  if (options.families.size() == 1) return std::vector<FamilyInfo>(components, options.families.front());
  if (options.families.size() == components) return options.families;
  throw std::invalid_argument("fit_refined: " + std::to_string(options.families.size()) + " families for " +
                              std::to_string(components) + " components; allowed are 0, 1 or one each");
}

/// One search of the fit, in coordinates in which all second derivatives are about 1.
Minimum search(const RefinedProblem& problem, const LossWeights& weights, int evaluations,
               const std::function<void()>& tick, std::vector<double>& x) {
  const std::vector<double> scale = problem.curvature(weights, x);
  std::vector<double> at(x.size());
  const auto objective = [&](const std::vector<double>& z, std::vector<double>& gradient) {
    for (std::size_t i = 0; i < z.size(); ++i) at[i] = z[i] / scale[i];
    const double value = problem.evaluate(weights, at, gradient);
    for (std::size_t i = 0; i < z.size(); ++i) gradient[i] /= scale[i];
    tick();
    return value;
  };
  std::vector<double> z(x.size());
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = x[i] * scale[i];
  Minimum minimum = minimise_smooth(objective, z, evaluations);
  for (std::size_t i = 0; i < z.size(); ++i) x[i] = minimum.z[i] / scale[i];
  return minimum;
}

}  // namespace

std::string_view to_text(RefinedObjective objective) {
  constexpr std::array<std::string_view, 6> kNames = {"balanced",  "log1p",      "logrel",
                                                      "cube-root", "likelihood", "image"};
  return kNames[static_cast<std::size_t>(objective)];
}

RefinedFit fit_refined(const MeasuredTable& table, const RefinedFitOptions& options, const Progress& progress) {
  require_structure(options.structure);
  if (options.evaluations < 1) throw std::invalid_argument("fit_refined: evaluations must be at least 1");
  const std::vector<FamilyInfo> families = families_of(options);
  RefinedCells cells = refined_cells(table, options.measure, options.structure.width);
  const double log_scale = std::log(cells.scale);
  const RefinedProblem problem(options.structure, families, std::move(cells));
  std::vector<double> x = problem.start();
  RefinedFit fit;
  LossWeights weights = weights_of(options.objective);
  ProgressCounter counter(progress, 100);
  int done = 0, shown = 0;
  const auto tick = [&] {
    ++done;
    for (; shown < std::min(100, 100 * done / options.evaluations); ++shown) counter.step();
  };
  const int share = std::max(1, options.evaluations / static_cast<int>(kSoftness.size()));
  for (std::size_t stage = 0; stage < kSoftness.size(); ++stage) {
    weights.softness = kSoftness[stage];
    const Minimum minimum = search(problem, weights, share, tick, x);
    fit.evaluations += minimum.evaluations;
    fit.objective = minimum.best.value;
    fit.converged = minimum.stop == MinimiseStop::tolerance;
    if (stage == 0) fit.start = minimum.first;
  }
  const RefinedLayout& layout = problem.layout();
  for (int k = 0; k < options.structure.components; ++k) {  // the weights of a spline sum to 1
    for (int i = 0; i < layout.count(k, RefinedPart::shape); ++i) {
      x[static_cast<std::size_t>(layout.first(k, RefinedPart::shape) + i)] -= log_scale;
    }
  }
  PackedCoefficients packed = pack(layout, options.structure.components, options.bits, x);
  fit.brdf = std::make_shared<RefinedBrdf>(options.structure, families, std::move(packed));
  return fit;
}

}  // namespace sklar::brdf
