#include "brdf/model/lattice.hpp"

#include "brdf/model/spline.hpp"

namespace sklar::brdf {

Eigen::MatrixXd lattice_shares(const Eigen::ArrayXd& x, int nodes) {
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(x.size(), nodes);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Between node = on_lattice(x(i), nodes);
    shares(i, node.low) += 1 - node.share;
    shares(i, node.high) += node.share;
  }
  return shares;
}

Eigen::MatrixXd lattice_basis(const Eigen::ArrayXd& x, int nodes, int count) {
  return lattice_shares(x, nodes) * spline_basis(Eigen::ArrayXd::LinSpaced(nodes, 0, 1), count);
}

}  // namespace sklar::brdf
