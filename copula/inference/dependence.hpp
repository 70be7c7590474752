#pragma once
/// Rank measures of dependence.

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

/// Ranks over n+1, column by column; tied values share their mean rank. O(d n log n).
/// @param x n x d, finite. @return n x d in (0,1). @throws std::domain_error naming a value that is not finite.
[[nodiscard]] Points pseudo_observations(const PointsRef& x);

}  // namespace sklar
