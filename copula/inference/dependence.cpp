#include "copula/inference/dependence.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "copula/error.hpp"
#include "copula/inference/checks.hpp"
#include "copula/inference/ranks.hpp"

namespace sklar {

std::vector<Index> sorted_order(const ColumnRef& x) {
  std::vector<Index> order(static_cast<std::size_t>(x.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&x](Index a, Index b) { return x[a] < x[b]; });
  return order;
}

namespace {

/// Sums of weights by rank: add and prefix sum in O(log n) (Fenwick 1994).
class WeightsByRank {
 public:
  explicit WeightsByRank(std::size_t ranks) : tree_(ranks + 1, 0.0) {}

  void add(std::size_t rank, double weight) {
    for (std::size_t i = rank + 1; i < tree_.size(); i += i & (~i + 1)) tree_[i] += weight;
  }

  /// Weight of the ranks below `rank`.
  [[nodiscard]] double below(std::size_t rank) const {
    double sum = 0;
    for (std::size_t i = rank; i > 0; i -= i & (~i + 1)) sum += tree_[i];
    return sum;
  }

 private:
  std::vector<double> tree_;
};

struct DenseRanks {
  std::vector<std::size_t> rank;
  std::size_t count = 0;
  double untied = 0;  ///< sum of w_i w_j over the pairs with different values
};

DenseRanks dense_ranks(const ColumnRef& y, const ColumnRef& w) {
  DenseRanks ranks{std::vector<std::size_t>(static_cast<std::size_t>(y.size()))};
  const std::vector<Index> order = sorted_order(y);
  double before = 0;
  for_each_run(y, order, [&](std::size_t first, std::size_t last) {
    double run = 0;
    for (std::size_t i = first; i < last; ++i) {
      ranks.rank[static_cast<std::size_t>(order[i])] = ranks.count;
      run += w[order[i]];
    }
    ranks.untied += before * run;
    before += run;
    ++ranks.count;
  });
  return ranks;
}

double tau_b(const ColumnRef& x, const ColumnRef& y, const ColumnRef& w) {
  const DenseRanks ranks = dense_ranks(y, w);
  const std::vector<Index> order = sorted_order(x);
  WeightsByRank seen(ranks.count);
  double before = 0;
  double untied = 0;
  double score = 0;
  for_each_run(x, order, [&](std::size_t first, std::size_t last) {
    double run = 0;
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t rank = ranks.rank[static_cast<std::size_t>(order[i])];
      const double above = before - seen.below(rank + 1);
      score += w[order[i]] * (seen.below(rank) - above);
      run += w[order[i]];
    }
    for (std::size_t i = first; i < last; ++i) seen.add(ranks.rank[static_cast<std::size_t>(order[i])], w[order[i]]);
    untied += before * run;
    before += run;
  });
  return score / std::sqrt(untied * ranks.untied);
}

/// Scaled to a largest weight of 1: tau does not depend on the scale, and products of weights stay in range.
Column relative_weights(const ColumnRef& weights, Index rows) {
  return weights.size() == 0 ? Column(Column::Ones(rows)) : Column(weights / weights.maxCoeff());
}

}  // namespace

double kendall_tau(const ColumnRef& x, const ColumnRef& y, const ColumnRef& weights) {
  require_enough_rows("kendall_tau", "x", x.rows(), 2);
  require_rows("kendall_tau", "y", y.rows(), x.rows());
  require_finite("kendall_tau", "x", x);
  require_finite("kendall_tau", "y", y);
  require_weights("kendall_tau", weights, x.rows());
  return tau_b(x, y, relative_weights(weights, x.rows()));
}

double mean_kendall_tau(const PointsRef& x, const ColumnRef& weights) {
  require_enough_rows("mean_kendall_tau", "x", x.rows(), 2);
  if (x.cols() < 2) {
    throw std::invalid_argument("mean_kendall_tau: x must have 2 or more columns, got " + std::to_string(x.cols()));
  }
  require_finite("mean_kendall_tau", "x", x);
  require_weights("mean_kendall_tau", weights, x.rows());
  const Column w = relative_weights(weights, x.rows());
  double sum = 0;
  for (Index i = 0; i < x.cols(); ++i) {
    for (Index j = i + 1; j < x.cols(); ++j) sum += tau_b(x.col(i), x.col(j), w);
  }
  return sum / (static_cast<double>(x.cols() * (x.cols() - 1)) / 2);
}

Points pseudo_observations(const PointsRef& x) {
  require_enough_rows("pseudo_observations", "x", x.rows(), 1);
  require_finite("pseudo_observations", "x", x);
  Points u(x.rows(), x.cols());
  for (Index column = 0; column < x.cols(); ++column) {
    const std::vector<Index> order = sorted_order(x.col(column));
    for_each_run(x.col(column), order, [&](std::size_t first, std::size_t last) {
      const double mean_rank = 0.5 * static_cast<double>(first + 1 + last);
      for (std::size_t i = first; i < last; ++i) u(order[i], column) = mean_rank / static_cast<double>(x.rows() + 1);
    });
  }
  return u;
}

}  // namespace sklar
