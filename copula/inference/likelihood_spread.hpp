#pragma once
/// The spread of maximum likelihood estimates of a copula from data with known or estimated margins.

#include <span>

#include "copula/inference/margin_influence.hpp"
#include "copula/inference/parameter_scale.hpp"

namespace sklar {

/// For k parameters, each k x k, in the coordinates z of a ParameterScale; NaN throughout where the likelihood has no
/// curvature or a row no finite density.
struct LikelihoodSpread {
  Eigen::MatrixXd inverse_information;  ///< of the observed information: the covariance of z if the margins are known
  Eigen::MatrixXd covariance;           ///< of z
};

/// The covariance of the z that maximises the likelihood of u. Of points with known margins it is the inverse of the
/// observed information B. Estimated margins make the rows depend on each other, which that does not see; then it is
///   B^-1 S B^-1,   S = sum_i w_i (N_i - mean N)(N_i - mean N)',
///   N_i = l_z(u_i) + sum_k sum_j w_j (d l_z(u_j) / d u_jk) I_k(i, j),   l_z = d log c / dz,
/// I_k(i, j) being what row i adds to the estimate of u_jk. Of ranks it is 1(u_ik <= u_jk) / N: Genest, Ghoudi and
/// Rivest (1995), Biometrika 82, 543, sec. 4 (two columns; Tsukahara 2005, Canad. J. Statist. 33, 357, for more). Of a
/// parametric margin it is slope(j) . influence(i) of MarginInfluence: the Godambe information of the inference
/// functions for margins, Joe (2005), J. Multivariate Anal. 94, 401. Weights are frequencies: what is written of n rows
/// holds for N = sum w_i. Derivatives are central differences, relative error about 1e-6. O(n d^2) and O(n d log n).
/// @param u       n x d in (0,1). @param weights n, or none for one each. @param z an interior maximum of the
/// likelihood. @param margins of u, one a column, or none for known margins.
[[nodiscard]] LikelihoodSpread likelihood_spread(const FamilyInfo& family, const ParameterScale& scale,
                                                 const std::vector<double>& z, const PointsRef& u,
                                                 const ColumnRef& weights, std::span<const MarginInfluence> margins);

}  // namespace sklar
