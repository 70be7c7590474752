#pragma once
/// The lattice over the coordinates of Warped between whose nodes colour, azimuth and copula of a refined model are
/// linear: its splines are evaluated there once, when a model is made.

#include <Eigen/Core>

#include "brdf/data/interpolation.hpp"

namespace sklar::brdf {

/// Nodes at i/(n-1) along each axis.
struct Lattice {
  static constexpr int half = 33;
  static constexpr int azimuth = 17;
  static constexpr int difference = 25;
  static constexpr int plane = half * azimuth;

  /// Of a node in a plane of one difference.
  static constexpr int index(int half_node, int azimuth_node) { return half_node * azimuth + azimuth_node; }
};

/// @param x in [0,1].
[[nodiscard]] inline Between on_lattice(double x, int nodes) {
  return between_clamped(x * (nodes - 1), nodes);
}

/// Row i: the shares of the nodes at x(i).
[[nodiscard]] Eigen::MatrixXd lattice_shares(const Eigen::ArrayXd& x, int nodes);

/// What a spline is at x once it is linear between the nodes: row i holds the shares of its `count` coefficients.
[[nodiscard]] Eigen::MatrixXd lattice_basis(const Eigen::ArrayXd& x, int nodes, int count);

}  // namespace sklar::brdf
