#pragma once
/// Non-negative factors of a matrix with weights, and of its rows as products.

#include <Eigen/Core>
#include <vector>

namespace sklar::brdf {

/// values ~ outer inner, all >= 0.
struct NonNegativeFactors {
  Eigen::MatrixXd outer;  ///< n x rank
  Eigen::MatrixXd inner;  ///< rank x m
};

/// Lessens the generalised Kullback-Leibler divergence, the sum of weights (y ln(y / z) - y + z), by the multiplicative
/// updates of Lee and Seung 2001, "Algorithms for Non-negative Matrix Factorization", Theorem 2, with weights, from
/// bands of rows. @param values n x m, >= 0. @param weights n x m, >= 0. @param rank 1 to n. @param updates >= 0.
[[nodiscard]] NonNegativeFactors non_negative_factors(const Eigen::MatrixXd& values, const Eigen::MatrixXd& weights,
                                                      int rank, int updates);

/// Each row of `inner` as a sum of products u v^T over its points.
struct SeparatedFactors {
  Eigen::MatrixXd outer;           ///< n x rank
  std::vector<Eigen::MatrixXd> u;  ///< of each of the rank rows: rows of the image x terms
  std::vector<Eigen::MatrixXd> v;  ///< columns of the image x terms
};

/// Factors as above whose inner rows, images of the given rows and columns in row-major order, are sums of `terms`
/// products; first the ones, then the others, then together.
[[nodiscard]] SeparatedFactors separated_factors(const Eigen::MatrixXd& values, const Eigen::MatrixXd& weights,
                                                 int rank, int image_rows, int terms);

}  // namespace sklar::brdf
