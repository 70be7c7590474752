#include "brdf/model/staged_search.hpp"

#include <algorithm>
#include <array>

#include "copula/inference/minimise.hpp"

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

/// One search of the fit, in coordinates in which all second derivatives are about 1.
Minimum search(const StagedProblem& problem, const LossWeights& weights, int evaluations,
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

LossWeights final_weights(RefinedObjective objective) {
  LossWeights weights = weights_of(objective);
  weights.softness = kSoftness.back();
  return weights;
}

StagedSearch search_in_stages(const StagedProblem& problem, RefinedObjective objective, int evaluations,
                              const Progress& progress, std::vector<double>& x) {
  StagedSearch result;
  LossWeights weights = weights_of(objective);
  ProgressCounter counter(progress, 100);
  int done = 0, shown = 0;
  const auto tick = [&] {
    ++done;
    for (; shown < std::min(100, 100 * done / evaluations); ++shown) counter.step();
  };
  const int share = std::max(1, evaluations / static_cast<int>(kSoftness.size()));
  for (std::size_t stage = 0; stage < kSoftness.size(); ++stage) {
    weights.softness = kSoftness[stage];
    const Minimum minimum = search(problem, weights, share, tick, x);
    result.evaluations += minimum.evaluations;
    result.objective = minimum.best.value;
    result.converged = minimum.stop == MinimiseStop::tolerance;
    if (stage == 0) result.start = minimum.first;
  }
  return result;
}

}  // namespace sklar::brdf
