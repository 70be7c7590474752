#pragma once
/// Derivatives of a value a row by parameters, by central differences; internal to the library's sources.

#include <functional>
#include <utility>
#include <vector>

#include "copula/types.hpp"

namespace sklar {

/// Errors are of the order of the squares of the steps, and of the rounding of the values over a step (slope) or the
/// product of two (curvature).
class RowDerivatives {
 public:
  using Values = std::function<Column(const std::vector<double>& at)>;

  /// @param step of each parameter, > 0.
  RowDerivatives(Values values, std::vector<double> at, std::vector<double> step)
      : values_(std::move(values)), at_(std::move(at)), step_(std::move(step)) {}

  [[nodiscard]] Column slope(std::size_t a) const { return (moved(a, 1) - moved(a, -1)) / (2 * step_[a]); }

  [[nodiscard]] Column curvature(std::size_t a, std::size_t b) const {
    const double area = 4 * step_[a] * step_[b];
    if (a == b) return 4 * (moved(a, 1) - 2 * moved(a, 0) + moved(a, -1)) / area;
    return (moved(a, 1, b, 1) - moved(a, 1, b, -1) - moved(a, -1, b, 1) + moved(a, -1, b, -1)) / area;
  }

 private:
  [[nodiscard]] Column moved(std::size_t a, int by_a, std::size_t b = 0, int by_b = 0) const {
    std::vector<double> at = at_;
    at[a] += by_a * step_[a];
    at[b] += by_b * step_[b];
    return values_(at);
  }

  Values values_;
  std::vector<double> at_, step_;
};

}  // namespace sklar
