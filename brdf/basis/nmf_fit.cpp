#include "brdf/basis/nmf_fit.hpp"

#include <algorithm>

namespace sklar::brdf {
namespace {

using Eigen::MatrixXd;

constexpr double kTiny = 1e-12;  ///< keeps quotients finite where all is black
constexpr int kUpdates = 200;    ///< of each step

/// Weighted y / z.
MatrixXd quotients(const MatrixXd& values, const MatrixXd& weights, const MatrixXd& product) {
  return (weights.array() * values.array() / (product.array() + kTiny)).matrix();
}

void multiply(MatrixXd& factor, const MatrixXd& numerator, const MatrixXd& denominator) {
  factor.array() *= numerator.array() / (denominator.array() + kTiny);
}

/// Bands of rows as a start: inner row r is the mean of band r, outer column r is 1 there and small elsewhere.
NonNegativeFactors banded_start(const MatrixXd& values, const MatrixXd& weights, int rank) {
  constexpr double kElsewhere = 0.1;
  const Eigen::Index n = values.rows();
  NonNegativeFactors start{MatrixXd::Constant(n, rank, kElsewhere), MatrixXd::Zero(rank, values.cols())};
  const double mean = values.sum() / std::max(weights.sum(), 1.0);
  for (Eigen::Index r = 0; r < rank; ++r) {
    const Eigen::Index first = r * n / rank, count = (r + 1) * n / rank - first;
    start.outer.col(r).segment(first, count).setOnes();
    const MatrixXd seen = weights.middleRows(first, count);
    const Eigen::RowVectorXd sum = values.middleRows(first, count).cwiseProduct(seen).colwise().sum();
    start.inner.row(r) = (sum.array() + kElsewhere * mean) / (seen.colwise().sum().array() + kElsewhere);
  }
  return start;
}

/// The image that a row of the matrix is.
MatrixXd image(const Eigen::RowVectorXd& row, Eigen::Index image_rows) {
  const Eigen::Index columns = row.size() / image_rows;
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(row.data(),
                                                                                                  image_rows, columns);
}

Eigen::RowVectorXd row_of(const MatrixXd& image) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> ordered = image;
  return Eigen::Map<const Eigen::RowVectorXd>(ordered.data(), ordered.size());
}

MatrixXd inner_of(const SeparatedFactors& factors, Eigen::Index columns) {
  MatrixXd inner(factors.outer.cols(), columns);
  for (std::size_t j = 0; j < factors.u.size(); ++j) {
    inner.row(static_cast<Eigen::Index>(j)) = row_of(factors.u[j] * factors.v[j].transpose());
  }
  return inner;
}

/// One update of all factors together.
void update(SeparatedFactors& factors, const MatrixXd& values, const MatrixXd& weights) {
  MatrixXd inner = inner_of(factors, values.cols());
  multiply(factors.outer, quotients(values, weights, factors.outer * inner) * inner.transpose(),
           weights * inner.transpose());
  const MatrixXd denominator = factors.outer.transpose() * weights;
  for (const bool along_u : {true, false}) {
    const MatrixXd numerator = factors.outer.transpose() * quotients(values, weights, factors.outer * inner);
    for (std::size_t j = 0; j < factors.u.size(); ++j) {
      MatrixXd &u = factors.u[j], &v = factors.v[j];
      const MatrixXd up = image(numerator.row(static_cast<Eigen::Index>(j)), u.rows());
      const MatrixXd down = image(denominator.row(static_cast<Eigen::Index>(j)), u.rows());
      if (along_u) {
        multiply(u, up * v, down * v);
      } else {
        multiply(v, up.transpose() * u, down.transpose() * u);
      }
    }
    inner = inner_of(factors, values.cols());
  }
}

}  // namespace

NonNegativeFactors non_negative_factors(const MatrixXd& values, const MatrixXd& weights, int rank, int updates) {
  NonNegativeFactors factors = banded_start(values, weights, rank);
  for (int n = 0; n < updates; ++n) {
    multiply(factors.inner, factors.outer.transpose() * quotients(values, weights, factors.outer * factors.inner),
             factors.outer.transpose() * weights);
    multiply(factors.outer, quotients(values, weights, factors.outer * factors.inner) * factors.inner.transpose(),
             weights * factors.inner.transpose());
  }
  return factors;
}

SeparatedFactors separated_factors(const MatrixXd& values, const MatrixXd& weights, int rank, int image_rows,
                                   int terms) {
  const NonNegativeFactors first = non_negative_factors(values, weights, rank, kUpdates);
  SeparatedFactors result{.outer = first.outer, .u = {}, .v = {}};
  const Eigen::RowVectorXd seen = weights.colwise().maxCoeff();
  for (Eigen::Index j = 0; j < rank; ++j) {
    const NonNegativeFactors second =
        non_negative_factors(image(first.inner.row(j), image_rows), image(seen, image_rows), terms, kUpdates);
    result.u.push_back(second.outer);
    result.v.emplace_back(second.inner.transpose());
  }
  for (int n = 0; n < kUpdates; ++n) update(result, values, weights);
  return result;
}

}  // namespace sklar::brdf
