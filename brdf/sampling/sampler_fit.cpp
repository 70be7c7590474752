#include "brdf/sampling/sampler_fit.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "brdf/sampling/sampler_mixture.hpp"

namespace sklar::brdf {
namespace {

constexpr int kTurns = 8;          // azimuths of wo over which an anisotropic reflectance is averaged
constexpr double kGrazing = 0.01;  // the cosine that stands for the last node, 0
constexpr int kAzimuths = 64;
constexpr int kLightSteps = 60;     // towards f
constexpr int kVarianceSteps = 30;  // then, towards f^2 / pdf
// How much the components of a node follow those of its neighbours in each step, so that what lies between two nodes
// is between them: geometric, first and last step.
constexpr double kFirstTie = 0.2, kLastTie = 0.02;
constexpr double kLobe = 0.05;  // the share of the light at normal incidence that tells the width of the lobe,
constexpr double kSpread = 20;  // and the spread of the warp for its radius

double cosine_of(std::size_t node) {
  return std::max(static_cast<double>(kOutgoingCosines[node]), kGrazing);
}

bool has_light(const std::vector<TargetPoint>& target) {
  return std::any_of(target.begin(), target.end(), [](const TargetPoint& point) { return point.mass > 0; });
}

/// |m| below which a share of the light is; 1 where there is no light.
double radius_quantile(const std::vector<TargetPoint>& target, double share) {
  std::vector<std::pair<double, double>> points;
  points.reserve(target.size());
  for (const TargetPoint& point : target) points.emplace_back(point.at.disk2, point.mass);
  std::sort(points.begin(), points.end());
  double sum = 0;
  for (const auto& [disk2, mass] : points) {
    sum += mass;
    if (sum >= share) return std::sqrt(disk2);
  }
  return 1;
}

/// Tied to both neighbours, the first and the last node to the one they have.
std::vector<MixtureState> tied(const std::vector<MixtureState>& states, double tie) {
  std::vector<MixtureState> result;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const MixtureState& before = states[i == 0 ? i : i - 1];
    const MixtureState& after = states[i + 1 == states.size() ? i : i + 1];
    result.push_back(states[i].towards(before, after, tie));
  }
  return result;
}

}  // namespace

SamplerTables fit_sampler(const Brdf& brdf, double cosine_share) {
  constexpr std::size_t kNodes = kOutgoingNodes;
  const int turns = brdf.traits().isotropic ? 1 : kTurns;
  std::vector<std::vector<TargetPoint>> targets(kNodes);
  tbb::parallel_for(std::size_t{0}, kNodes,
                    [&](std::size_t i) { targets[i] = sampler_target(brdf, cosine_of(i), kAzimuths, turns); });
  const double lobe = kSpread * radius_quantile(targets[0], kLobe);
  std::vector<double> spreads;
  std::vector<MixtureProblem> problems;
  for (std::size_t i = 0; i < kNodes; ++i) {
    // 1 / cos(theta_o) is the scale of m around the mirror direction.
    spreads.push_back(std::sqrt(std::min(lobe / cosine_of(i), 1.0)));
    problems.emplace_back(targets[i], spreads[i], cosine_share);
  }
  const bool lit = std::any_of(targets.begin(), targets.end(), has_light);
  std::vector<MixtureState> states(kNodes, lit ? MixtureState::start() : MixtureState::without_light());
  for (int n = 0; n < kLightSteps; ++n) {
    tbb::parallel_for(std::size_t{0}, kNodes, [&](std::size_t i) { problems[i].follow_light(states[i]); });
    states = tied(states, kFirstTie * std::pow(kLastTie / kFirstTie, static_cast<double>(n) / kLightSteps));
  }
  SamplerTables tables{.nodes = std::vector<SamplerNode>(kNodes)};
  tbb::parallel_for(std::size_t{0}, kNodes, [&](std::size_t i) {
    problems[i].lower_variance(states[i], kVarianceSteps);
    tables.nodes[i] = states[i].node(spreads[i]);
  });
  return tables;
}

}  // namespace sklar::brdf
