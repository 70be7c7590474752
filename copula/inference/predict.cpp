#include "copula/inference/predict.hpp"

#include <algorithm>
#include <string>

#include "copula/error.hpp"
#include "copula/reordered.hpp"

namespace sklar {
namespace {

void require_given(int dim, const std::vector<int>& given) {
  std::vector<bool> seen(static_cast<std::size_t>(dim));
  for (const int column : given) {
    if (column < 0 || column >= dim || seen[static_cast<std::size_t>(column)]) {
      throw std::invalid_argument("prediction: given columns must be from 0 to " + std::to_string(dim - 1) +
                                  ", each once, got " + std::to_string(column));
    }
    seen[static_cast<std::size_t>(column)] = true;
  }
  if (given.size() == static_cast<std::size_t>(dim)) {
    throw std::invalid_argument("prediction: all " + std::to_string(dim) + " columns are given, none is left");
  }
}

}  // namespace

JointDistribution reordered(const std::shared_ptr<const JointDistribution>& joint, std::span<const int> order) {
  const CopulaPtr copula = reordered(CopulaPtr(joint, &joint->copula()), order);
  std::vector<std::shared_ptr<const Marginal>> margins;
  for (const int column : order) margins.emplace_back(joint, &joint->margin(column));
  return {std::move(margins), copula};
}

Prediction::Prediction(const std::shared_ptr<const JointDistribution>& joint, std::vector<int> given)
    : given_(std::move(given)) {
  require_given(joint->dim(), given_);
  for (int column = 0; column < joint->dim(); ++column) {
    if (std::ranges::find(given_, column) == given_.end()) missing_.push_back(column);
  }
  for (const int column : missing_) {
    std::vector<int> order = given_;
    order.push_back(column);
    std::ranges::copy_if(missing_, std::back_inserter(order), [column](int other) { return other != column; });
    joints_.push_back(reordered(joint, order));
  }
}

Column Prediction::cdf(int column, const PointsRef& given, const ColumnRef& x) const {
  return of(column).conditional_cdf(beside(given, x));
}

Column Prediction::quantile(int column, const PointsRef& given, const ColumnRef& p) const {
  return of(column).conditional_quantile(beside(given, p));
}

Points Prediction::sample(Index n, Rng& rng, const PointsRef& given) const {
  const Points x = joints_.front().sample(n, rng, given);
  Points columns(x.rows(), x.cols());
  Index next = 0;
  for (const int column : given_) columns.col(column) = x.col(next++);
  for (const int column : missing_) columns.col(column) = x.col(next++);
  return columns;
}

const JointDistribution& Prediction::of(int column) const {
  const auto found = std::ranges::find(missing_, column);
  if (found == missing_.end()) {
    throw std::invalid_argument("prediction: column " + std::to_string(column) + " is given or not there");
  }
  return joints_[static_cast<std::size_t>(found - missing_.begin())];
}

Points Prediction::beside(const PointsRef& given, const ColumnRef& last) const {
  const auto columns = static_cast<Index>(given_.size());
  require_columns("prediction", "given", given.cols(), columns, columns);
  require_rows("prediction", "given", given.rows(), last.rows());
  Points x(last.rows(), columns + 1);
  x.leftCols(columns) = given;
  x.col(columns) = last;
  return x;
}

}  // namespace sklar
