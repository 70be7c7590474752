#pragma once
/// Some columns of a joint distribution, others given.

#include <memory>
#include <span>
#include <vector>

#include "copula/inference/joint.hpp"

namespace sklar {

/// The columns of a joint distribution in another order, see copula/reordered.hpp.
/// @throws as reordered for copulas.
[[nodiscard]] JointDistribution reordered(const std::shared_ptr<const JointDistribution>& joint,
                                          std::span<const int> order);

/// The distribution of the columns of X that are not given, any of them. Of one of them alone it is that of the
/// margin of the given ones and this one: the others, unknown, take no part. Columns count from 0.
/// Values of a given column beyond what its margin has stand for the limit at the end of the margin; a row with NaN
/// gives NaN.
class Prediction {
 public:
  /// @param given   columns in any order, each once, none or more but not all.
  /// @throws std::invalid_argument for other columns, and as reordered.
  Prediction(const std::shared_ptr<const JointDistribution>& joint, std::vector<int> given);

  [[nodiscard]] const std::vector<int>& given() const noexcept { return given_; }
  [[nodiscard]] const std::vector<int>& missing() const noexcept { return missing_; }  ///< the others, rising

  /// P(X_m <= x | given), m a missing column. @param given n x g in the order of given(). @param x n values.
  /// @throws std::invalid_argument for a column that is not missing, and for shapes.
  [[nodiscard]] Column cdf(int column, const PointsRef& given, const ColumnRef& x) const;

  /// Its inverse. @param p n values in [0,1].
  [[nodiscard]] Column quantile(int column, const PointsRef& given, const ColumnRef& p) const;

  /// n points of X, all columns in their own order, jointly given. @param given 1 x g. @param n >= 1.
  [[nodiscard]] Points sample(Index n, Rng& rng, const PointsRef& given) const;

 private:
  [[nodiscard]] const JointDistribution& of(int column) const;
  [[nodiscard]] Points beside(const PointsRef& given, const ColumnRef& last) const;

  std::vector<int> given_, missing_;
  std::vector<JointDistribution> joints_;  ///< one a missing column: the given ones, this one, the others
};

}  // namespace sklar
