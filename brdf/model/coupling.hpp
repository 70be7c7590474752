#pragma once
/// The copula of one component of a refined model: log c(F(half | difference), G(azimuth | difference);
/// tau(difference)) at the nodes of the lattice.

#include <Eigen/Core>
#include <vector>

#include "brdf/model/lattice.hpp"
#include "brdf/model/refined_structure.hpp"
#include "copula/family.hpp"

namespace sklar::brdf {

/// Which components have a copula other than independence.
[[nodiscard]] std::vector<bool> coupled(const std::vector<FamilyInfo>& families);

/// The log margins and the coefficient of the dependence at the nodes.
struct CouplingInput {
  Eigen::MatrixXd half;        ///< log density, half x difference
  Eigen::MatrixXd azimuth;     ///< log density, azimuth x difference
  Eigen::VectorXd dependence;  ///< difference; 0 is independence or the weakest dependence sought
};

/// The splines of the coordinates of the lattice: rows are nodes, columns coefficients.
struct LatticeBases {
  explicit LatticeBases(const RefinedStructure& structure);
  Eigen::MatrixXd half, difference, colour_half, colour_difference, azimuth_difference, coupling_difference;
  Eigen::MatrixXd azimuth;  ///< Bernstein polynomials
};

/// What a component's coefficients (in the order of RefinedLayout) are at the nodes.
[[nodiscard]] CouplingInput coupling_input(const RefinedStructure& structure, const std::vector<double>& shape,
                                           const std::vector<double>& azimuth, const std::vector<double>& coupling);

/// log c, Lattice::plane x difference; and as a gradient the derivatives by the fields of CouplingInput.
using CouplingValues = Eigen::MatrixXd;

/// One family over the lattice. F and G are cdfs of the margins with a share of 1e-4 of uniform, at the middle of the
/// mass of a node, so that u is never 0 or 1.
class Coupling {
 public:
  /// Dependence is sought up to |tau| = 0.8 of what the family has, from 0 on where negative dependence has no density
  /// everywhere. @throws std::invalid_argument for a family without one parameter that tau determines.
  explicit Coupling(const FamilyInfo& family);

  [[nodiscard]] const FamilyInfo& family() const { return family_; }

  /// tau at a coefficient of the dependence.
  [[nodiscard]] double tau(double dependence) const;

  /// The coefficient at which tau is that, or the nearest in the middle 99 % of what is sought.
  [[nodiscard]] double dependence(double tau) const;

  [[nodiscard]] CouplingValues values(const CouplingInput& input) const;

  /// @param slopes of a function by the values. @return its derivatives by the input.
  [[nodiscard]] CouplingInput gradient(const CouplingInput& input, const CouplingValues& slopes) const;

 private:
  [[nodiscard]] double tau_slope(double dependence) const;

  FamilyInfo family_;
  double lowest_, highest_, start_;
};

}  // namespace sklar::brdf
