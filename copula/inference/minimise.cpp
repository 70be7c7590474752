#include "copula/inference/minimise.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>

namespace sklar {
namespace {

using Optimiser = std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)>;

/// What NLopt's callback needs. C code must not see an exception: it is kept, and the search told to stop.
struct Search {
  const Objective& objective;
  const Gradient& gradient;
  nlopt_opt optimiser;
  double step;   ///< the first step along a slope
  double scale;  ///< of the objective as NLopt sees it; 0 until the first slope
  Minimum result = {};
  std::exception_ptr thrown = {};
  double last = std::numeric_limits<double>::max();

  void evaluate(const std::vector<double>& z) {
    const Evaluation evaluation = objective(z);
    if (result.evaluations == 0) result.first = evaluation.value;
    if (result.evaluations++ == 0 || evaluation.better_than(result.best)) {
      result.best = evaluation;
      result.z = z;
    }
    last = evaluation.value;
  }

  /// SLSQP starts from the Hessian 1: the objective is scaled so that its first step is not longer than asked for.
  void differentiate(const std::vector<double>& z, double* slopes) {
    const std::vector<double> found = gradient(z);
    double steepest = 0;
    for (const double slope : found) {
      if (!std::isfinite(slope)) nlopt_force_stop(optimiser);
      steepest = std::max(steepest, std::abs(slope));
    }
    if (scale == 0) scale = steepest > step ? step / steepest : 1;
    for (const double slope : found) *slopes++ = scale * slope;
  }
};

double callback(unsigned n, const double* z, double* slopes, void* data) noexcept {
  Search& search = *static_cast<Search*>(data);
  try {
    const std::vector<double> at(z, z + n);
    search.evaluate(at);
    if (slopes != nullptr) search.differentiate(at, slopes);
  } catch (...) {
    search.thrown = std::current_exception();
    nlopt_force_stop(search.optimiser);
  }
  return search.scale * search.last;
}

MinimiseStop stop_reason(nlopt_result code) {
  if (code == NLOPT_MAXEVAL_REACHED) return MinimiseStop::max_evaluations;
  if (code > 0 || code == NLOPT_ROUNDOFF_LIMITED) return MinimiseStop::tolerance;
  return MinimiseStop::failed;
}

}  // namespace

Minimum minimise(const Objective& objective, const std::vector<double>& start, const Box& box,
                 const MinimiseOptions& options, const Gradient& gradient) {
  const auto n = static_cast<unsigned>(start.size());
  const nlopt_algorithm algorithm = gradient ? NLOPT_LD_SLSQP : NLOPT_LN_BOBYQA;
  Optimiser optimiser(n > 0 ? nlopt_create(algorithm, n) : nullptr, &nlopt_destroy);
  Search search{.objective = objective,
                .gradient = gradient,
                .optimiser = optimiser.get(),
                .step = options.step,
                .scale = gradient ? 0.0 : 1.0};
  if (n == 0) {
    search.evaluate(start);
    return search.result;
  }
  nlopt_set_min_objective(optimiser.get(), callback, &search);
  nlopt_set_lower_bounds(optimiser.get(), box.lower.data());
  nlopt_set_upper_bounds(optimiser.get(), box.upper.data());
  std::vector<double> step(n);
  for (unsigned i = 0; i < n; ++i) step[i] = std::min(options.step, 0.25 * (box.upper[i] - box.lower[i]));
  nlopt_set_initial_step(optimiser.get(), step.data());
  nlopt_set_xtol_abs1(optimiser.get(), options.tolerance);
  nlopt_set_maxeval(optimiser.get(), options.max_evaluations);
  std::vector<double> z = start;
  double value = 0;
  const nlopt_result code = nlopt_optimize(optimiser.get(), z.data(), &value);
  if (search.thrown) std::rethrow_exception(search.thrown);
  search.result.stop = stop_reason(code);
  if (search.result.evaluations == 0) search.evaluate(start);
  return search.result;
}

namespace {

struct SmoothSearch {
  const SmoothObjective& objective;
  nlopt_opt optimiser;
  Minimum result = {};
  std::exception_ptr thrown = {};
};

double smooth_callback(unsigned n, const double* z, double* slopes, void* data) noexcept {
  SmoothSearch& search = *static_cast<SmoothSearch*>(data);
  try {
    const std::vector<double> at(z, z + n);
    std::vector<double> gradient(n);
    const double value = search.objective(at, gradient);
    if (slopes != nullptr) std::copy(gradient.begin(), gradient.end(), slopes);
    if (search.result.evaluations == 0) search.result.first = value;
    if (search.result.evaluations++ == 0 || value < search.result.best.value) {
      search.result.best.value = value;
      search.result.z = at;
    }
    return value;
  } catch (...) {
    search.thrown = std::current_exception();
    nlopt_force_stop(search.optimiser);
    return std::numeric_limits<double>::max();
  }
}

}  // namespace

Minimum minimise_smooth(const SmoothObjective& objective, const std::vector<double>& start, int max_evaluations) {
  constexpr unsigned kPairs = 30;
  constexpr double kTolerance = 1e-9;
  const auto n = static_cast<unsigned>(start.size());
  Optimiser optimiser(nlopt_create(NLOPT_LD_LBFGS, n), &nlopt_destroy);
  SmoothSearch search{.objective = objective, .optimiser = optimiser.get()};
  nlopt_set_min_objective(optimiser.get(), smooth_callback, &search);
  nlopt_set_vector_storage(optimiser.get(), kPairs);
  nlopt_set_ftol_rel(optimiser.get(), kTolerance);
  nlopt_set_maxeval(optimiser.get(), max_evaluations);
  std::vector<double> z = start;
  double value = 0;
  const nlopt_result code = nlopt_optimize(optimiser.get(), z.data(), &value);
  if (search.thrown) std::rethrow_exception(search.thrown);
  search.result.stop = stop_reason(code);
  return search.result;
}

}  // namespace sklar
