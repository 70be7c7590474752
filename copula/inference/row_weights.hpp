#pragma once
/// Sums over weighted rows; internal to the library's sources.

#include <cmath>

#include "copula/types.hpp"

namespace sklar {

/// Frequencies of n rows. A row of frequency 0 does not count, whatever its value.
class RowWeights {
 public:
  /// @param weights n, or none for one each.
  RowWeights(const ColumnRef& weights, Index rows)
      : weights_(weights.size() > 0 ? Column(weights) : Column(Column::Ones(rows))) {}

  [[nodiscard]] double total() const { return weights_.sum(); }

  /// w_i y_i.
  [[nodiscard]] Column times(const Column& y) const { return (weights_ > 0).select(weights_ * y, 0.0); }

  /// sum w_i y_i.
  [[nodiscard]] double sum(const Column& y) const { return times(y).sum(); }

  /// sum w_i (y_i - m)(y_i - m)', m the mean row.
  [[nodiscard]] Eigen::MatrixXd scatter(const Eigen::MatrixXd& y) const {
    Eigen::MatrixXd deviations(y.rows(), y.cols());
    for (Index a = 0; a < y.cols(); ++a) {
      const Column column = y.col(a);
      deviations.col(a) = (weights_ > 0).select(weights_.sqrt() * (column - sum(column) / total()), 0.0);
    }
    return deviations.transpose() * deviations;
  }

 private:
  Column weights_;
};

}  // namespace sklar
