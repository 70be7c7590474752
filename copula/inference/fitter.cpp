#include "copula/inference/fitter.hpp"

#include <algorithm>
#include <cmath>

#include "copula/error.hpp"
#include "copula/inference/information.hpp"

namespace sklar {
namespace {

/// A result within this many tolerances of a bound is at the bound.
constexpr double kAtBound = 10;

void require_options(const FitOptions& options) {
  const auto require = [](bool valid, const char* what) {
    if (!valid) throw std::invalid_argument(std::string("fit options: ") + what);
  };
  require(options.tolerance > 0 && std::isfinite(options.tolerance), "tolerance must be finite and above 0");
  require(options.max_evaluations >= 1, "max_evaluations must be 1 or more");
  require(options.start_rows >= 2, "start_rows must be 2 or more");
}

}  // namespace

double total_weight(const ColumnRef& weights, Index rows) {
  return weights.size() == 0 ? static_cast<double>(rows) : weights.sum();
}

Fitter::Fitter(const FamilyInfo& family, FitMethod method, int dim, const FitOptions& options)
    : family_(family), dim_(dim), options_(options), scale_(family, dim) {
  family.require_dimension(dim);
  require_options(options);
  result_.family = family.name;
  result_.method = method;
}

std::vector<double> Fitter::best_of_lattice(const CopulaObjective& objective) const {
  return best_of_lattice([&](const std::vector<double>& z) { return objective(*copula(scale_.theta(z))); });
}

std::vector<double> Fitter::best_of_lattice(const Objective& objective) const {
  std::vector<double> best;
  Evaluation lowest;
  for (const std::vector<double>& z : scale_.lattice()) {
    const Evaluation evaluation = objective(z);
    if (!best.empty() && !evaluation.better_than(lowest)) continue;
    best = z;
    lowest = evaluation;
  }
  return best;
}

void Fitter::search(const CopulaObjective& objective, const std::vector<double>& start, double step,
                    const Score& score) {
  const auto at = [&](const std::vector<double>& z) {
    ++result_.evaluations;
    return objective(*copula(scale_.theta(z)));
  };
  const MinimiseOptions options{
      .step = step, .tolerance = options_.tolerance, .max_evaluations = options_.max_evaluations};
  const Gradient gradient = [&](const std::vector<double>& z) {
    std::vector<double> slopes = score(scale_.theta(z));
    const std::vector<double> by_z = scale_.slope(z);
    for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] *= -by_z[i];
    return slopes;
  };
  Minimum minimum = minimise(at, start, scale_.box(), options, score ? gradient : Gradient());
  if (score && minimum.stop == MinimiseStop::failed) minimum = minimise(at, minimum.z, scale_.box(), options);
  // Broken rows have no slope to follow: look elsewhere.
  if (minimum.best.nonfinite > 0 && scale_.size() > 0) {
    minimum = minimise(at, best_of_lattice(at), scale_.box(), options);
  }
  z_ = minimum.z;
  set_theta(scale_.theta(z_));
  result_.objective = minimum.best.value;
  judge(minimum);
}

void Fitter::set_theta(Theta theta) {
  result_.theta = std::move(theta);
  result_.tau = family_.tau(result_.theta);
  result_.standard_error.assign(result_.theta.size(), FitResult::kNone);
}

void Fitter::add_likelihood(const PointsRef& u, const ColumnRef& weights) {
  const RowSum sum = log_likelihood(*copula(result_.theta), u, weights, chunking());
  result_.nonfinite = sum.nonfinite;
  set_likelihood(sum.or_nothing(), total_weight(weights, u.rows()));
}

void Fitter::set_likelihood(double log_likelihood, double total_weight) {
  const auto k = static_cast<double>(result_.theta.size());
  result_.log_likelihood = log_likelihood;
  result_.aic = 2 * k - 2 * log_likelihood;
  result_.bic = k * std::log(total_weight) - 2 * log_likelihood;
}

void Fitter::add_standard_error(const CopulaObjective& objective, double total_weight) {
  if (result_.status != FitStatus::converged) return;
  // A third of z's sampling error: the sum moves by 1/20, far above its rounding, and the five-point formula for the
  // second derivative (Abramowitz and Stegun 25.3.24) is off by the fourth power of the step.
  const double room = 0.5 * std::min(z_[0] - scale_.box().lower[0], scale_.box().upper[0] - z_[0]);
  const double step = std::min(std::clamp(0.2 / std::sqrt(total_weight), 1e-5, 0.02), room);
  const auto rise = [&](double distance) {
    const Evaluation evaluation = objective(*copula(scale_.theta({z_[0] + distance})));
    return evaluation.nonfinite == 0 ? evaluation.value - result_.objective : FitResult::kNone;
  };
  const double near = rise(step) + rise(-step), far = rise(2 * step) + rise(-2 * step);
  const double information = (16 * near - far) / (12 * step * step);
  constexpr double kStep = 1e-4;
  if (information > 0) result_.standard_error = {std::abs(theta_steps(kStep)[0]) / kStep / std::sqrt(information)};
}

void Fitter::add_standard_errors(const Score& score) {
  if (result_.status != FitStatus::converged) return;
  constexpr double kStep = 1e-4;  // of z: the information is off by its square, and by rounding over it
  result_.standard_error = standard_errors(score, result_.theta, scale_.domain(), theta_steps(kStep));
}

void Fitter::judge(const Minimum& minimum) {
  result_.nonfinite = minimum.best.nonfinite;
  result_.status = FitStatus::converged;
  const double reach = kAtBound * options_.tolerance;
  for (std::size_t i = 0; i < scale_.size(); ++i) {
    const bool low = z_[i] <= scale_.box().lower[i] + reach;
    if (!low && z_[i] < scale_.box().upper[i] - reach) continue;
    result_.status = FitStatus::at_bound;
    result_.message = family_.parameters[i].name + " = " + to_text(result_.theta[i]) + " is at the " +
                      (low ? "lower" : "upper") + " end of the range searched";
  }
  if (minimum.stop == MinimiseStop::max_evaluations) {
    result_.status = FitStatus::max_evaluations;
    result_.message = "stopped after " + std::to_string(minimum.evaluations) + " evaluations";
  }
  if (minimum.stop == MinimiseStop::failed) fail("the search ended without a minimum");
  if (result_.nonfinite > 0) {
    fail(std::to_string(result_.nonfinite) + " rows have no finite density at the best parameters found");
  }
}

void Fitter::fail(std::string message) {
  result_.status = FitStatus::failed;
  result_.message = std::move(message);
}

/// Half the way that theta moves when z moves by one step to either side, within the box.
std::vector<double> Fitter::theta_steps(double z_step) const {
  std::vector<double> steps;
  for (std::size_t i = 0; i < scale_.size(); ++i) {
    std::vector<double> low = z_;
    std::vector<double> high = z_;
    low[i] = std::max(low[i] - z_step, scale_.box().lower[i]);
    high[i] = std::min(high[i] + z_step, scale_.box().upper[i]);
    steps.push_back(0.5 * (scale_.theta(high)[i] - scale_.theta(low)[i]));
  }
  return steps;
}

}  // namespace sklar
