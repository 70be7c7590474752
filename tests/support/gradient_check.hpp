#pragma once
/// The gradient of a fit's objective against differences of its values.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "brdf/model/refined_loss.hpp"
#include "copula/random.hpp"

namespace sklar::test {

/// At a point around the start: every step-th coefficient and the last ones, for objectives of every kind.
template <class Problem>
void expect_gradient_of_objective(const Problem& problem, std::size_t step, std::size_t last, const std::string& what) {
  using brdf::LossWeights;
  constexpr double kStep = 2e-3, kTolerance = 0.01;  // relative to the largest; the objective is in single precision
  std::vector<double> x = problem.start();
  Rng rng(3);
  for (double& value : x) value += 0.3 * (uniform(rng) - 0.5);
  for (const LossWeights& weights : {LossWeights{.log1p = 4, .log_relative = 1, .softness = 0.1F},
                                     LossWeights{.cube_root = 1}, LossWeights{.likelihood = 1, .image = 1}}) {
    std::vector<double> gradient, unused;
    (void)problem.evaluate(weights, x, gradient);
    double largest = 0;
    for (const double slope : gradient) largest = std::max(largest, std::abs(slope));
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (i % step != 0 && x.size() - i > last) continue;
      std::vector<double> up = x, down = x;
      up[i] += kStep;
      down[i] -= kStep;
      const double slope =
          (problem.evaluate(weights, up, unused) - problem.evaluate(weights, down, unused)) / (2 * kStep);
      EXPECT_NEAR(gradient[i], slope, kTolerance * largest) << what << " coefficient " << i << " of " << x.size();
    }
  }
}

}  // namespace sklar::test
