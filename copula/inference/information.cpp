#include "copula/inference/information.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sklar {
namespace {

constexpr double kDrop = 0.005;    ///< (0.1)^2 / 2
constexpr double kDropRatio = 10;  ///< how far from kDrop a step is still used
constexpr int kMostAdjustments = 8;

using LogLikelihood = std::function<double(const Theta&)>;

double at(const LogLikelihood& l, Theta theta, std::size_t i, double step_i, std::size_t j, double step_j) {
  theta[i] += step_i;
  theta[j] += step_j;
  return l(theta);
}

/// Adjusts the step of parameter i. @return the mean drop of l one step to either side, NaN if no step will do.
double drop_at_good_step(const LogLikelihood& l, const Theta& theta, double at_maximum, std::size_t i,
                         const Interval& domain, double& step) {
  // Steps of both signs stay inside.
  const double room = 0.5 * std::min(theta[i] - domain.lowest, domain.highest - theta[i]);
  for (int attempt = 0;; ++attempt) {
    step = std::min(step, room);
    const double drop = at_maximum - 0.5 * (at(l, theta, i, step, i, 0.0) + at(l, theta, i, -step, i, 0.0));
    const bool close = drop > kDrop / kDropRatio && drop < kDrop * kDropRatio;
    const bool last = attempt == kMostAdjustments || (drop < kDrop && step == room);
    if (close || last) return drop > 0 ? drop : std::numeric_limits<double>::quiet_NaN();
    step *= drop > 0 ? std::clamp(std::sqrt(kDrop / drop), 0.01, 100.0) : (drop <= 0 ? 10.0 : 0.1);
  }
}

}  // namespace

std::vector<double> standard_errors(const LogLikelihood& log_likelihood, const Theta& theta, double at_maximum,
                                    const std::vector<Interval>& domain, std::vector<double> step) {
  const std::size_t k = theta.size();
  std::vector<double> none(k, std::numeric_limits<double>::quiet_NaN());
  Eigen::MatrixXd information(static_cast<Index>(k), static_cast<Index>(k));
  for (std::size_t i = 0; i < k; ++i) {
    const double drop = drop_at_good_step(log_likelihood, theta, at_maximum, i, domain[i], step[i]);
    if (!std::isfinite(drop)) return none;
    information(static_cast<Index>(i), static_cast<Index>(i)) = 2 * drop / (step[i] * step[i]);
  }
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double mixed =
          at(log_likelihood, theta, i, step[i], j, step[j]) - at(log_likelihood, theta, i, step[i], j, -step[j]) -
          at(log_likelihood, theta, i, -step[i], j, step[j]) + at(log_likelihood, theta, i, -step[i], j, -step[j]);
      const double entry = -mixed / (4 * step[i] * step[j]);
      information(static_cast<Index>(i), static_cast<Index>(j)) = entry;
      information(static_cast<Index>(j), static_cast<Index>(i)) = entry;
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(information);
  if (factor.info() != Eigen::Success) return none;
  const Eigen::MatrixXd covariance =
      factor.solve(Eigen::MatrixXd::Identity(static_cast<Index>(k), static_cast<Index>(k)));
  std::vector<double> errors(k);
  for (std::size_t i = 0; i < k; ++i) errors[i] = std::sqrt(covariance(static_cast<Index>(i), static_cast<Index>(i)));
  return errors;
}

}  // namespace sklar
