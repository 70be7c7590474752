#include "brdf/basis/low_rank.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace sklar::brdf {
namespace {

using Eigen::MatrixXd;

constexpr double kRidge = 1e-10;  ///< relative to the mean diagonal: columns that the weights do not tell apart

/// The directions of most weight of the rows, n x rank, orthonormal.
MatrixXd leading_rows(const MatrixXd& values, int rank) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(values * values.transpose());
  return solver.eigenvectors().rowwise().reverse().leftCols(rank);  // eigenvalues ascend
}

/// For each column of the values its best coefficients over the basis. @param basis n x rank. @return m x rank.
MatrixXd coefficients(const MatrixXd& values, const MatrixXd& weights, const MatrixXd& basis) {
  MatrixXd result(values.cols(), basis.cols());
  tbb::parallel_for(Eigen::Index{0}, values.cols(), [&](Eigen::Index column) {
    const MatrixXd weighted = basis.array().colwise() * weights.col(column).array();
    MatrixXd normal = basis.transpose() * weighted;
    normal.diagonal().array() += kRidge * normal.trace() / static_cast<double>(basis.cols()) + 1e-300;
    result.row(column) = normal.ldlt().solve(weighted.transpose() * values.col(column)).transpose();
  });
  return result;
}

/// The same product with orthonormal rows and orthogonal columns in order.
LowRank canonical(const MatrixXd& rows, const MatrixXd& columns) {
  const Eigen::Index rank = rows.cols();
  const Eigen::HouseholderQR<MatrixXd> qr(rows);
  const MatrixXd orthonormal = qr.householderQ() * MatrixXd::Identity(rows.rows(), rank);
  const MatrixXd scaled = columns * (orthonormal.transpose() * rows).transpose();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(scaled.transpose() * scaled);
  const MatrixXd turn = solver.eigenvectors().rowwise().reverse();
  return {.rows = orthonormal * turn, .columns = scaled * turn};
}

}  // namespace

LowRank low_rank(const MatrixXd& values, const MatrixXd& weights, int rank, int sweeps) {
  MatrixXd rows = leading_rows((values.array() * weights.array().sqrt()).matrix(), rank);
  MatrixXd columns = coefficients(values, weights, rows);
  const MatrixXd turned = values.transpose(), turned_weights = weights.transpose();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    rows = coefficients(turned, turned_weights, columns);
    columns = coefficients(values, weights, rows);
  }
  return canonical(rows, columns);
}

}  // namespace sklar::brdf
