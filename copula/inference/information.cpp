#include "copula/inference/information.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sklar {
namespace {

std::vector<double> score_at(const Score& score, Theta theta, std::size_t i, double step) {
  theta[i] += step;
  return score(theta);
}

}  // namespace

std::vector<double> standard_errors(const Score& score, const Theta& theta, const std::vector<Interval>& domain,
                                    std::vector<double> step) {
  const auto k = static_cast<Index>(theta.size());
  Eigen::MatrixXd information(k, k);
  for (std::size_t i = 0; i < theta.size(); ++i) {
    step[i] = std::min(step[i], 0.5 * std::min(theta[i] - domain[i].lowest, domain[i].highest - theta[i]));
    const std::vector<double> high = score_at(score, theta, i, step[i]), low = score_at(score, theta, i, -step[i]);
    const double distance = (theta[i] + step[i]) - (theta[i] - step[i]);
    for (std::size_t j = 0; j < theta.size(); ++j) {
      information(static_cast<Index>(i), static_cast<Index>(j)) = (low[j] - high[j]) / distance;
    }
  }
  information = 0.5 * (information + information.transpose()).eval();
  const Eigen::LLT<Eigen::MatrixXd> factor(information);
  std::vector<double> errors(theta.size(), std::numeric_limits<double>::quiet_NaN());
  if (!information.allFinite() || factor.info() != Eigen::Success) return errors;
  const Eigen::MatrixXd covariance = factor.solve(Eigen::MatrixXd::Identity(k, k));
  for (std::size_t i = 0; i < theta.size(); ++i) {
    errors[i] = std::sqrt(covariance(static_cast<Index>(i), static_cast<Index>(i)));
  }
  return errors;
}

}  // namespace sklar
