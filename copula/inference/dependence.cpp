#include "copula/inference/dependence.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "copula/error.hpp"
#include "copula/inference/checks.hpp"
#include "copula/inference/ranks.hpp"
#include "copula/random.hpp"

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

Column frequencies(const ColumnRef& weights, Index rows) {
  return weights.size() == 0 ? Column(Column::Ones(rows)) : Column(weights);
}

void shuffle(std::vector<Index>& order, std::size_t first, std::size_t last, Rng& rng) {
  for (std::size_t i = last; i > first + 1; --i) {
    const auto drawn = static_cast<std::size_t>(uniform(rng) * static_cast<double>(i - first));
    std::swap(order[i - 1], order[first + drawn]);
  }
}

/// Rows of weight k as k tied rows.
Column ranks(const ColumnRef& x, const ColumnRef& w, Ties ties, Rng& rng) {
  std::vector<Index> order = sorted_order(x);
  Column rank(x.size());
  double below = 0;
  for_each_run(x, order, [&](std::size_t first, std::size_t last) {
    if (ties == Ties::random) shuffle(order, first, last, rng);
    double run = 0;
    for (std::size_t i = first; i < last; ++i) run += w[order[i]];
    double before = below;
    for (std::size_t i = first; i < last; ++i) {
      const double own = w[order[i]];
      const double lowest = ties == Ties::random ? before : ties == Ties::highest ? below + run - own : below;
      rank[order[i]] = lowest + 0.5 * ((ties == Ties::average ? run : own) + 1);
      before += own;
    }
    below += run;
  });
  return rank;
}

double rank_correlation(const ColumnRef& x, const ColumnRef& y, const ColumnRef& w) {
  Rng unused;
  Column a = ranks(x, w, Ties::average, unused), b = ranks(y, w, Ties::average, unused);
  a -= (w * a).sum() / w.sum();
  b -= (w * b).sum() / w.sum();
  return (w * a * b).sum() / std::sqrt((w * a.square()).sum() * (w * b.square()).sum());
}

void require_pair(std::string_view function, const ColumnRef& x, const ColumnRef& y, const ColumnRef& weights) {
  require_enough_rows(function, "x", x.rows(), 2);
  require_rows(function, "y", y.rows(), x.rows());
  require_finite(function, "x", x);
  require_finite(function, "y", y);
  require_weights(function, weights, x.rows());
}

/// The mean of measure(x_i, x_j, w) over all pairs of columns.
template <class Measure>
double mean_over_pairs(std::string_view function, const PointsRef& x, const ColumnRef& weights, Measure measure) {
  require_enough_rows(function, "x", x.rows(), 2);
  if (x.cols() < 2) {
    throw std::invalid_argument(std::string(function) + ": x must have 2 or more columns, got " +
                                std::to_string(x.cols()));
  }
  require_finite(function, "x", x);
  require_weights(function, weights, x.rows());
  const Column w = relative_weights(weights, x.rows());
  double sum = 0;
  for (Index i = 0; i < x.cols(); ++i) {
    for (Index j = i + 1; j < x.cols(); ++j) sum += measure(x.col(i), x.col(j), w);
  }
  return sum / (static_cast<double>(x.cols() * (x.cols() - 1)) / 2);
}

}  // namespace

double kendall_tau(const ColumnRef& x, const ColumnRef& y, const ColumnRef& weights) {
  require_pair("kendall_tau", x, y, weights);
  return tau_b(x, y, relative_weights(weights, x.rows()));
}

double mean_kendall_tau(const PointsRef& x, const ColumnRef& weights) {
  return mean_over_pairs("mean_kendall_tau", x, weights, tau_b);
}

double spearman_rho(const ColumnRef& x, const ColumnRef& y, const ColumnRef& weights) {
  require_pair("spearman_rho", x, y, weights);
  return rank_correlation(x, y, relative_weights(weights, x.rows()));
}

double mean_spearman_rho(const PointsRef& x, const ColumnRef& weights) {
  return mean_over_pairs("mean_spearman_rho", x, weights, rank_correlation);
}

Points pseudo_observations(const PointsRef& x, const ColumnRef& weights, const RankOptions& options) {
  require_enough_rows("pseudo_observations", "x", x.rows(), 1);
  require_finite("pseudo_observations", "x", x);
  require_weights("pseudo_observations", weights, x.rows());
  const Column w = frequencies(weights, x.rows());
  Rng rng(options.seed);
  Points u(x.rows(), x.cols());
  for (Index column = 0; column < x.cols(); ++column) {
    u.col(column) = ranks(x.col(column), w, options.ties, rng) / (w.sum() + 1);
  }
  return u;
}

std::vector<Index> tied_rows(const PointsRef& x) {
  require_finite("tied_rows", "x", x);
  std::vector<Index> tied(static_cast<std::size_t>(x.cols()), 0);
  for (Index column = 0; column < x.cols(); ++column) {
    for_each_run(x.col(column), sorted_order(x.col(column)), [&](std::size_t first, std::size_t last) {
      if (last - first > 1) tied[static_cast<std::size_t>(column)] += static_cast<Index>(last - first);
    });
  }
  return tied;
}

}  // namespace sklar
