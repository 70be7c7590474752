#pragma once
/// The copula of one component of a refined model: log c(F(half | difference), G(azimuth | difference);
/// tau(difference)) on a lattice, between whose nodes log c is trilinear.

#include <Eigen/Core>
#include <vector>

#include "brdf/model/refined_structure.hpp"
#include "copula/family.hpp"

namespace sklar::brdf {

/// Nodes of the lattice at i/(n-1) along each axis of Warped.
struct CouplingLattice {
  static constexpr int half = 33;
  static constexpr int azimuth = 17;
  static constexpr int difference = 25;
  static constexpr int plane = half * azimuth;

  static constexpr int index(int half_node, int azimuth_node) { return half_node * azimuth + azimuth_node; }
};

/// The log margins and the coefficient of the dependence at the nodes.
struct CouplingInput {
  Eigen::MatrixXd half;        ///< log density, half x difference
  Eigen::MatrixXd azimuth;     ///< log density, azimuth x difference
  Eigen::VectorXd dependence;  ///< difference; 0 is independence or the weakest dependence sought
};

/// The splines of the coordinates of the lattice: rows are nodes, columns coefficients.
struct CouplingBases {
  explicit CouplingBases(const RefinedStructure& structure);
  Eigen::MatrixXd half, difference, azimuth, azimuth_difference,
      coupling_difference;  ///< azimuth: Bernstein polynomials
};

/// What a component's coefficients (in the order of RefinedLayout) are at the nodes.
[[nodiscard]] CouplingInput coupling_input(const RefinedStructure& structure, const std::vector<double>& shape,
                                           const std::vector<double>& azimuth, const std::vector<double>& coupling);

/// log c, CouplingLattice::plane x difference; and as a gradient the derivatives by the fields of CouplingInput.
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

  [[nodiscard]] CouplingValues values(const CouplingInput& input) const;

  /// @param slopes of a function by the values. @return its derivatives by the input.
  [[nodiscard]] CouplingInput gradient(const CouplingInput& input, const CouplingValues& slopes) const;

 private:
  [[nodiscard]] double tau_slope(double dependence) const;

  FamilyInfo family_;
  double lowest_, highest_, start_;
};

}  // namespace sklar::brdf
