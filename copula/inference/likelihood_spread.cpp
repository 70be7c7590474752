#include "copula/inference/likelihood_spread.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "copula/inference/ranks.hpp"
#include "copula/inference/row_derivatives.hpp"
#include "copula/inference/row_weights.hpp"

namespace sklar {
namespace {

/// Steps of z, and of u relative to the distance from the nearer end: a mixed difference is off by their squares, and
/// by the rounding of log c over their product.
constexpr double kStep = 1e-3;

/// log c(u_i) and its derivatives by z.
class CopulaRows {
 public:
  CopulaRows(const FamilyInfo& family, const ParameterScale& scale, const std::vector<double>& z)
      : family_(family), scale_(scale), z_(z) {
    for (std::size_t a = 0; a < z.size(); ++a) {
      step_.push_back(std::min(kStep, 0.5 * std::min(z[a] - scale.box().lower[a], scale.box().upper[a] - z[a])));
    }
  }

  [[nodiscard]] RowDerivatives at(const PointsRef& u) const {
    const auto log_pdf = [this, u](const std::vector<double>& z) {
      return family_.make_unchecked(static_cast<int>(u.cols()), scale_.theta(z))->log_pdf(u);
    };
    return {log_pdf, z_, step_};
  }

  /// d^2 log c(u_i) / d z_a d u_ik.
  [[nodiscard]] Column mixed(const PointsRef& u, std::size_t a, Index k) const {
    const Column step = kStep * u.col(k).min(1 - u.col(k));
    Points low = u, high = u;
    low.col(k) -= step;
    high.col(k) += step;
    return (at(high).slope(a) - at(low).slope(a)) / (high.col(k) - low.col(k));
  }

 private:
  const FamilyInfo& family_;
  const ParameterScale& scale_;
  std::vector<double> z_, step_;
};

/// sum_j 1(x_i <= x_j) y_j for every i.
Column sums_from(const ColumnRef& x, const Column& y) {
  const std::vector<Index> order = sorted_order(x);
  Column sums(y.size());
  double below = 0;
  const double all = y.sum();
  for_each_run(x, order, [&](std::size_t first, std::size_t last) {
    const double from = all - below;
    for (std::size_t i = first; i < last; ++i) {
      sums[order[i]] = from;
      below += y[order[i]];
    }
  });
  return sums;
}

/// What the estimate of column k adds to the influence of each row: sum_j w_j slope_j I_k(i, j).
Column through_margin(const MarginInfluence& margin, const ColumnRef& u, const Column& weighted_slope, double total) {
  if (margin.ranks) return sums_from(u, weighted_slope) / total;
  return (margin.influence * (margin.slope.transpose() * weighted_slope.matrix())).array();
}

}  // namespace

LikelihoodSpread likelihood_spread(const FamilyInfo& family, const ParameterScale& scale, const std::vector<double>& z,
                                   const PointsRef& u, const ColumnRef& weights,
                                   std::span<const MarginInfluence> margins) {
  const CopulaRows copula(family, scale, z);
  const RowDerivatives likelihood = copula.at(u);
  const RowWeights rows(weights, u.rows());
  const auto k = static_cast<Index>(z.size());
  Eigen::MatrixXd information(k, k), influence(u.rows(), k);
  for (Index a = 0; a < k; ++a) {
    const auto parameter = static_cast<std::size_t>(a);
    for (Index b = 0; b <= a; ++b) {
      information(a, b) = -rows.sum(likelihood.curvature(parameter, static_cast<std::size_t>(b)));
      information(b, a) = information(a, b);
    }
    if (margins.empty()) continue;
    influence.col(a) = likelihood.slope(parameter);
    for (Index column = 0; column < u.cols(); ++column) {
      const Column slope = rows.times(copula.mixed(u, parameter, column));
      influence.col(a).array() +=
          through_margin(margins[static_cast<std::size_t>(column)], u.col(column), slope, rows.total());
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(information);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Constant(k, k, std::numeric_limits<double>::quiet_NaN());
  if (!information.allFinite() || factor.info() != Eigen::Success) return {none, none};
  const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(k, k));
  if (margins.empty()) return {inverse, inverse};
  return {inverse, inverse * rows.scatter(influence) * inverse};
}

}  // namespace sklar
