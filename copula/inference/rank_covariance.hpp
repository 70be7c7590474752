#pragma once
/// The spread of maximum likelihood estimates from pseudo-observations.

#include "copula/inference/parameter_scale.hpp"

namespace sklar {

/// For k parameters, each k x k, in the coordinates z of a ParameterScale; NaN throughout where the likelihood has no
/// curvature or a row no finite density.
struct LikelihoodSpread {
  Eigen::MatrixXd inverse_information;  ///< of the observed information: the covariance of z if the margins are known
  Eigen::MatrixXd covariance;           ///< of z
};

/// The covariance of the z that maximises the likelihood of u. Of points with known margins it is the inverse of the
/// observed information B. Ranks depend on each other, which that does not see; of pseudo-observations it is
///   B^-1 S B^-1,   S = sum_i (N_i - mean N)(N_i - mean N)',
///   N_i = l_z(u_i) + (1/n) sum_k sum_j 1(u_ik <= u_jk) d l_z(u_j) / d u_jk,   l_z = d log c / dz,
/// Genest, Ghoudi and Rivest (1995), Biometrika 82, 543, sec. 4 (two columns; Tsukahara 2005, Canad. J. Statist. 33,
/// 357, for more). Derivatives are central differences, relative error about 1e-6. O(n d^2) and O(n d log n).
/// @param u       n x d in (0,1). @param z an interior maximum of the likelihood. @param ranks u are ranks / (n + 1).
[[nodiscard]] LikelihoodSpread likelihood_spread(const FamilyInfo& family, const ParameterScale& scale,
                                                 const std::vector<double>& z, const PointsRef& u, bool ranks);

}  // namespace sklar
