#include "copula/inference/rank_covariance.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "copula/inference/ranks.hpp"

namespace sklar {
namespace {

/// Steps of z, and of u relative to the distance from the nearer end: a mixed difference is off by their squares, and
/// by the rounding of log c over their product.
constexpr double kStep = 1e-3;

/// Values and derivatives of log c(u_i) by z, row by row.
class RowLikelihood {
 public:
  RowLikelihood(const FamilyInfo& family, const ParameterScale& scale, const std::vector<double>& z, int dim)
      : family_(family), scale_(scale), z_(z), dim_(dim) {
    for (std::size_t a = 0; a < z.size(); ++a) {
      step_.push_back(std::min(kStep, 0.5 * std::min(z[a] - scale.box().lower[a], scale.box().upper[a] - z[a])));
    }
  }

  /// d log c(u_i) / d z_a.
  [[nodiscard]] Column score(const PointsRef& u, std::size_t a) const {
    return (moved(u, a, 1) - moved(u, a, -1)) / (2 * step_[a]);
  }

  /// d^2 sum_i log c(u_i) / d z_a d z_b.
  [[nodiscard]] double curvature(const PointsRef& u, std::size_t a, std::size_t b) const {
    const double area = 4 * step_[a] * step_[b];
    if (a == b) return 4 * (moved(u, a, 1) - 2 * moved(u, a, 0) + moved(u, a, -1)).sum() / area;
    return (moved(u, a, 1, b, 1) - moved(u, a, 1, b, -1) - moved(u, a, -1, b, 1) + moved(u, a, -1, b, -1)).sum() / area;
  }

 private:
  [[nodiscard]] Column moved(const PointsRef& u, std::size_t a, int by_a, std::size_t b = 0, int by_b = 0) const {
    std::vector<double> z = z_;
    z[a] += by_a * step_[a];
    z[b] += by_b * step_[b];
    return family_.make_unchecked(dim_, scale_.theta(z))->log_pdf(u);
  }

  const FamilyInfo& family_;
  const ParameterScale& scale_;
  std::vector<double> z_, step_;
  int dim_;
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

/// What the ranks of column k add to the influence of each row on the score.
Column rank_term(const RowLikelihood& likelihood, const PointsRef& u, Index k, std::size_t a) {
  const Column step = kStep * u.col(k).min(1 - u.col(k));
  Points low = u, high = u;
  low.col(k) -= step;
  high.col(k) += step;
  const Column slope = (likelihood.score(high, a) - likelihood.score(low, a)) / (high.col(k) - low.col(k));
  return sums_from(u.col(k), slope) / static_cast<double>(u.rows());
}

}  // namespace

LikelihoodSpread likelihood_spread(const FamilyInfo& family, const ParameterScale& scale, const std::vector<double>& z,
                                   const PointsRef& u, bool ranks) {
  const RowLikelihood likelihood(family, scale, z, static_cast<int>(u.cols()));
  const auto k = static_cast<Index>(z.size());
  Eigen::MatrixXd information(k, k), influence(u.rows(), k);
  for (Index a = 0; a < k; ++a) {
    const auto parameter = static_cast<std::size_t>(a);
    for (Index b = 0; b <= a; ++b) {
      information(a, b) = -likelihood.curvature(u, parameter, static_cast<std::size_t>(b));
      information(b, a) = information(a, b);
    }
    if (!ranks) continue;
    influence.col(a) = likelihood.score(u, parameter);
    for (Index column = 0; column < u.cols(); ++column) {
      influence.col(a).array() += rank_term(likelihood, u, column, parameter);
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(information);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Constant(k, k, std::numeric_limits<double>::quiet_NaN());
  if (!information.allFinite() || factor.info() != Eigen::Success) return {none, none};
  const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(k, k));
  if (!ranks) return {inverse, inverse};
  influence.rowwise() -= influence.colwise().mean().eval();
  return {inverse, inverse * (influence.transpose() * influence) * inverse};
}

}  // namespace sklar
