#pragma once
/// Ranks and rank measures of dependence.

#include <cstdint>
#include <vector>

#include "copula/types.hpp"

namespace sklar {

/// Kendall's tau-b of a pair in O(n log n): with s_x, s_y in {-1, 0, 1} the signs of the differences of a pair of rows,
///   sum w_i w_j s_x s_y / sqrt( sum w_i w_j s_x^2 * sum w_i w_j s_y^2 ),  all sums over i < j.
/// Kendall, Biometrika 33 (1945) 239; the weighted form counts a row of weight k as k tied rows.
/// @param x, y     n >= 2 finite values. @param weights n values >= 0, or none for one each.
/// @return         in [-1, 1]; NaN where x or y is constant (tau is not defined).
/// @throws std::invalid_argument (shapes, all weights zero), std::domain_error (a value or weight out of range).
[[nodiscard]] double kendall_tau(const ColumnRef& x, const ColumnRef& y, const ColumnRef& weights = Column());

/// The mean of kendall_tau over all d(d-1)/2 pairs of columns. @param x n x d, d >= 2. Throws as kendall_tau does.
[[nodiscard]] double mean_kendall_tau(const PointsRef& x, const ColumnRef& weights = Column());

/// Spearman's rho of a pair in O(n log n): the correlation of the ranks, tied values at their mean rank; a row of
/// weight k counts as k rows. @return in [-1, 1]; NaN where x or y is constant. Arguments and throws as kendall_tau.
[[nodiscard]] double spearman_rho(const ColumnRef& x, const ColumnRef& y, const ColumnRef& weights = Column());

/// The mean of spearman_rho over all d(d-1)/2 pairs of columns. @param x n x d, d >= 2. Throws as kendall_tau does.
[[nodiscard]] double mean_spearman_rho(const PointsRef& x, const ColumnRef& weights = Column());

/// Which rank tied values get. Their mean rank keeps the mean of the ranks, is what Spearman's rho takes, and does not
/// depend on the order of the rows; random ranks keep the ranks uniform, at the price of noise.
enum class Ties { average, lowest, highest, random };

/// How pseudo_observations ranks.
struct RankOptions {
  Ties ties = Ties::average;
  std::uint64_t seed = 1;  ///< of Ties::random
};

/// Ranks over N+1, column by column, N the number of rows or the sum of their weights. O(d n log n).
/// @param x        n x d, finite. @param weights n frequencies >= 0, or none for one each: a row of weight k
///                 counts as k tied rows, of which it takes the mean rank.
/// @return         n x d in (0,1). @throws std::invalid_argument (shapes, all weights zero), std::domain_error naming a
///                 value that is not finite or a weight out of range.
[[nodiscard]] Points pseudo_observations(const PointsRef& x, const ColumnRef& weights = Column(),
                                         const RankOptions& options = {});

/// For each column the number of rows that share their value with another row. @param x n x d, finite.
[[nodiscard]] std::vector<Index> tied_rows(const PointsRef& x);

}  // namespace sklar
