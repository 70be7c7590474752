#include "brdf/sampling/sampler_fit.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "brdf/sampling/sampler_mixture.hpp"

namespace sklar::brdf {
namespace {

constexpr int kTurns = 8;                           // azimuths of wo over which an anisotropic reflectance is averaged
constexpr double kGrazing = 0.01;                   // the cosine that stands for the last node, 0
constexpr std::array<int, 3> kProbes = {3, 8, 12};  // nodes at which widths are judged: 25, 60, 80 degrees
constexpr int kAzimuths = 64;
constexpr int kProbeAzimuths = 24;
constexpr MixtureProblem::Steps kFirstSteps = {.likelihood = 100, .variance = 0};
constexpr MixtureProblem::Steps kSteps = {.likelihood = 30, .variance = 10};
constexpr MixtureProblem::Steps kProbeSteps = {.likelihood = 15, .variance = 10};

using Targets = std::vector<std::vector<TargetPoint>>;

/// @param nodes of theta_o. @param azimuths as of sampler_target.
template <class Nodes>
Targets targets_at(const Brdf& brdf, const Nodes& nodes, int azimuths) {
  Targets targets(std::size(nodes));
  const int turns = brdf.traits().isotropic ? 1 : kTurns;
  tbb::parallel_for(std::size_t{0}, targets.size(), [&](std::size_t i) {
    const double cosine = std::clamp(OutgoingPlace::cosine_at(nodes[i]), kGrazing, 1.0);
    targets[i] = sampler_target(brdf, cosine, azimuths, turns);
  });
  return targets;
}

/// slope2 below which a share of the light of the probes is.
double slope2_quantile(const Targets& targets, double share) {
  std::vector<std::pair<double, double>> points;
  double total = 0;
  for (const std::vector<TargetPoint>& target : targets) {
    for (const TargetPoint& point : target) {
      points.emplace_back(point.at.slope2, point.mass);
      total += point.mass;
    }
  }
  std::sort(points.begin(), points.end());
  double sum = 0;
  for (const auto& [slope2, mass] : points) {
    sum += mass;
    if (sum >= share * total && slope2 > 0) return slope2;
  }
  return 1;
}

/// Sum over the probes of the variance that is reached with these widths.
double probe(const Targets& targets, const SamplerWidths& width2, double cosine_share) {
  double sum = 0;
  for (const std::vector<TargetPoint>& target : targets) {
    const MixtureProblem problem(target, width2, cosine_share);
    sum += problem.variance(problem.solve(MixtureState::start(), kProbeSteps));
  }
  return sum;
}

/// Compass search over the logs of the widths.
SamplerWidths fit_widths(const Targets& targets, double cosine_share) {
  constexpr double kLeast = 1e-14, kMost = 100;
  SamplerWidths best = {0, slope2_quantile(targets, 0.1), slope2_quantile(targets, 0.4), slope2_quantile(targets, 0.8)};
  double least = probe(targets, best, cosine_share);
  double factor = 4;
  for (int round = 0; round < 6; ++round) {
    std::vector<SamplerWidths> candidates;
    for (std::size_t k = 1; k < kSamplerComponents; ++k) {
      for (const double change : {factor, 1 / factor}) {
        SamplerWidths candidate = best;
        candidate[k] = std::clamp(candidate[k] * change, kLeast, kMost);
        candidates.push_back(candidate);
      }
    }
    std::vector<double> reached(candidates.size());
    tbb::parallel_for(std::size_t{0}, candidates.size(),
                      [&](std::size_t i) { reached[i] = probe(targets, candidates[i], cosine_share); });
    const auto i = static_cast<std::size_t>(std::min_element(reached.begin(), reached.end()) - reached.begin());
    if (reached[i] < least) {
      least = reached[i];
      best = candidates[i];
    } else {
      factor = std::sqrt(factor);
    }
  }
  return best;
}

}  // namespace

SamplerTables fit_sampler(const Brdf& brdf, double cosine_share) {
  SamplerTables tables{.nodes = {}, .width2 = fit_widths(targets_at(brdf, kProbes, kProbeAzimuths), cosine_share)};
  std::vector<int> nodes(kOutgoingNodes);
  std::iota(nodes.begin(), nodes.end(), 0);
  MixtureState state = MixtureState::start();
  for (const std::vector<TargetPoint>& target : targets_at(brdf, nodes, kAzimuths)) {
    const MixtureProblem problem(target, tables.width2, cosine_share);
    if (tables.nodes.empty()) state = problem.solve(state, kFirstSteps);
    state = problem.solve(state.loosened(), kSteps);
    tables.nodes.push_back(state.node());
  }
  tables.width2[0] = 1;
  return tables;
}

}  // namespace sklar::brdf
