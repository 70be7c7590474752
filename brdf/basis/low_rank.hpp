#pragma once
/// A matrix as a sum of products of columns, by weighted least squares.

#include <Eigen/Core>

namespace sklar::brdf {

struct LowRank {
  Eigen::MatrixXd rows;     ///< n x rank, orthonormal columns
  Eigen::MatrixXd columns;  ///< m x rank, orthogonal columns, the longest first; values ~ rows columns^T
};

/// The product of the given rank nearest to the values, sum of weights (values - product)^2 least. With equal weights
/// the truncated singular value decomposition (Eckart and Young 1936); otherwise alternating least squares from that of
/// sqrt(weights) values, a local minimum. Runs on all threads of oneTBB; the result does not depend on them.
/// @param values n x m. @param weights n x m, > 0. @param rank 1 to min(n, m). @param sweeps of the alternation, >= 0.
[[nodiscard]] LowRank low_rank(const Eigen::MatrixXd& values, const Eigen::MatrixXd& weights, int rank, int sweeps);

}  // namespace sklar::brdf
