#pragma once
/// Minimisation within bounds. The one place that uses NLopt.

#include <functional>
#include <vector>

#include "copula/types.hpp"

namespace sklar {

/// A value to be minimised. What has fewer broken rows is better, then what has the smaller value.
struct Evaluation {
  double value = 0;     ///< finite
  Index nonfinite = 0;  ///< rows that could not be evaluated, already punished in value

  [[nodiscard]] bool better_than(const Evaluation& other) const noexcept {
    return nonfinite != other.nonfinite ? nonfinite < other.nonfinite : value < other.value;
  }
};

/// What is minimised.
using Objective = std::function<Evaluation(const std::vector<double>& z)>;

/// The derivative of the value by each coordinate; where it is not finite the search gives up.
using Gradient = std::function<std::vector<double>(const std::vector<double>& z)>;

/// The domain of the search, ends included.
struct Box {
  std::vector<double> lower;
  std::vector<double> upper;
};

/// How long and how to search.
struct MinimiseOptions {
  double step;          ///< first step along each coordinate
  double tolerance;     ///< stop when the steps are smaller
  int max_evaluations;  ///< >= 1
};

/// What ended the search.
enum class MinimiseStop { tolerance, max_evaluations, failed };

/// What the search found.
struct Minimum {
  std::vector<double> z;  ///< the best point evaluated, whatever stopped the search
  Evaluation best;
  double first = 0;  ///< the value at the start
  int evaluations = 0;
  MinimiseStop stop = MinimiseStop::tolerance;
};

/// Local minimum, without a gradient by quadratic models in a trust region (BOBYQA, Powell 2009; in one dimension too,
/// where it takes about ten evaluations from a good start), with one by sequential quadratic programming (SLSQP, Kraft
/// 1994), which takes about as many in any number of dimensions. Rounding that stops progress counts as reaching the
/// tolerance.
/// @param start   inside the box. For no coordinates the objective is evaluated once.
/// @throws what the objective throws.
[[nodiscard]] Minimum minimise(const Objective& objective, const std::vector<double>& start, const Box& box,
                               const MinimiseOptions& options, const Gradient& gradient = {});

/// A smooth function of many variables: returns the value and sets the gradient, of the size of z.
using SmoothObjective = std::function<double(const std::vector<double>& z, std::vector<double>& gradient)>;

/// Local minimum without bounds, for hundreds of variables and more: L-BFGS (Nocedal 1980) with 30 pairs. Ends when a
/// step gains less than a relative 1e-9. @throws what the objective throws.
[[nodiscard]] Minimum minimise_smooth(const SmoothObjective& objective, const std::vector<double>& start,
                                      int max_evaluations);

}  // namespace sklar
