#pragma once
/// What each row says of the margins that are estimated from it.

#include "copula/inference/margin_fit.hpp"

namespace sklar {

/// Of a margin of n rows with p parameters in the coordinates t: a mean itself, the logarithm of a positive parameter.
/// The estimates of t move from their true values by the sum of w_i influence(i), and the uniforms of row j with them
/// by slope(j) times that, but for what is of the order of 1/N.
struct MarginInfluence {
  bool ranks = false;              ///< the uniforms are pseudo-observations: no parameters
  Eigen::MatrixXd slope = {};      ///< n x p, dF(x_j) / dt
  Eigen::MatrixXd influence = {};  ///< n x p, J^-1 d log f(x_i) / dt, J the observed information of t
};

/// Of a margin fitted to x. Derivatives are central differences, relative error about 1e-6; NaN throughout where the
/// likelihood has no curvature. Precondition: not a kernel margin.
[[nodiscard]] MarginInfluence margin_influence(const MarginFit& margin, const ColumnRef& x, const ColumnRef& weights);

}  // namespace sklar
