#include "copula/copula.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "copula/error.hpp"
#include "copula/unit_interval.hpp"

namespace sklar {

namespace {

void require_points(const char* function, const PointsRef& u, Index lowest, Index highest) {
  require_columns(function, "u", u.cols(), lowest, highest);
  require_unit_cube(function, "u", u);
}

bool is_in_unit_cube(const PointsRef& u) {
  for (Index k = 0; k < u.cols(); ++k) {
    if (!none_outside_unit_interval(u.col(k).data(), u.rows())) return false;
  }
  return true;
}

constexpr Index kChunk = 4096;  // rows: a few columns of them fit the innermost caches

/// body(first row, number of rows) over chunks of rows, on all threads. Rows do not depend on each other, so neither
/// number nor order matters.
template <class Body>
void for_each_chunk(Index rows, const Body& body) {
  const Index chunks = (rows + kChunk - 1) / kChunk;
  const auto work = [&](Index chunk) { body(chunk * kChunk, std::min(kChunk, rows - chunk * kChunk)); };
  if (chunks == 1) return work(0);
  oneapi::tbb::parallel_for(Index{0}, chunks, work);
}

/// Eigen's own exp stays within the normal numbers: 5.6e-309 for -inf, 1.8e308 for inf.
Column exponential(const Column& x) {
  return x.unaryExpr([](double value) { return std::exp(value); });
}

}  // namespace

Copula::Copula(int dim) : dim_(dim) {
  if (dim < 2) throw std::invalid_argument("a copula needs dimension 2 or more, got " + std::to_string(dim));
}

void Copula::require_digits(int digits) {
  if (digits >= 1 && digits <= kMostDigits) return;
  throw std::invalid_argument("exact: digits must be from 1 to " + std::to_string(kMostDigits) + ", got " +
                              std::to_string(digits));
}

Column Copula::log_pdf(const PointsRef& u, Accuracy accuracy) const {
  require_columns("log_pdf", "u", u.cols(), dim_, dim_);
  return evaluate("log_pdf", Quantity::log_pdf, u, accuracy);
}

Column Copula::evaluate(const char* function, Quantity quantity, const PointsRef& u, Accuracy accuracy) const {
  Column out(u.rows());
  for_each_chunk(u.rows(), [&](Index first, Index count) {
    const auto rows = u.middleRows(first, count);
    auto values = out.segment(first, count);
    const Answered answered = quick_into(quantity, accuracy, rows, values.data());
    if (answered == Answered::all) return;  // an answer tells that the row is in the unit cube
    const bool inside = answered == Answered::some ? fill_left(quantity, rows, values) : is_in_unit_cube(rows);
    if (!inside) require_unit_cube(function, "u", u);
    if (answered == Answered::none) standard_into(quantity, rows, values);
  });
  return out;
}

Answered Copula::quick_into(Quantity /*quantity*/, Accuracy /*accuracy*/, const PointsRef& /*u*/,
                            double* /*out*/) const {
  return Answered::none;
}

bool Copula::fill_left(Quantity quantity, const PointsRef& u, ColumnOut out) const {
  constexpr Index kBlock = 64;
  std::vector<Index> left;
  for (Index first = 0; first < out.size(); first += kBlock) {
    const Index count = std::min(kBlock, out.size() - first);
    if (!std::isnan(out.segment(first, count).sum())) continue;
    for (Index i = first; i < first + count; ++i) {
      if (std::isnan(out(i))) left.push_back(i);
    }
  }
  const Points rows = u(left, Eigen::all);
  if (!is_in_unit_cube(rows)) return false;
  Column answers(rows.rows());
  standard_into(quantity, rows, answers);
  out(left) = answers;
  return true;
}

void Copula::standard_into(Quantity quantity, const PointsRef& u, const ColumnOut& out) const {
  switch (quantity) {
    case Quantity::log_pdf:
      return log_pdf_into(u, {}, out);
    case Quantity::log_cdf:
      return log_cdf_into(u, {}, out);
    case Quantity::h:
      return conditional_into(u, {}, Tail::lower, out);
    case Quantity::h_upper:
      return conditional_into(u, {}, Tail::upper, out);
    case Quantity::h_inv:
      return conditional_inverse_into(u, {}, Tail::lower, out);
    case Quantity::h_inv_upper:
      return conditional_inverse_into(u, {}, Tail::upper, out);
  }
}

double Copula::log_pdf_at(std::span<const double> u) const {
  assert(static_cast<int>(u.size()) == dim_);
  double out;
  log_pdf_into(Eigen::Map<const Points>(u.data(), 1, dim_), {}, Eigen::Map<Column>(&out, 1));
  return out;
}

Column Copula::pdf(const PointsRef& u) const {
  return exponential(log_pdf(u));
}

Column Copula::log_cdf(const PointsRef& u) const {
  require_columns("log_cdf", "u", u.cols(), dim_, dim_);
  return evaluate("log_cdf", Quantity::log_cdf, u, Accuracy::standard);
}

Column Copula::cdf(const PointsRef& u) const {
  return exponential(log_cdf(u));
}

Column Copula::h(const PointsRef& u, Accuracy accuracy) const {
  require_columns("h", "u", u.cols(), 1, dim_);
  return evaluate("h", Quantity::h, u, accuracy);
}

Column Copula::h_upper(const PointsRef& u, Accuracy accuracy) const {
  require_columns("h_upper", "u", u.cols(), 1, dim_);
  return evaluate("h_upper", Quantity::h_upper, u, accuracy);
}

Column Copula::log_conditional_pdf(const PointsRef& u) const {
  require_points("log_conditional_pdf", u, 1, dim_);
  Column joint(u.rows()), given = Column::Zero(u.rows());
  log_pdf_into(u, {}, joint);
  if (u.cols() > 1) log_pdf_into(u.leftCols(u.cols() - 1), {}, given);
  return joint - given;
}

Column Copula::h_inv(const PointsRef& u, Accuracy accuracy) const {
  require_columns("h_inv", "u", u.cols(), 1, dim_);
  return evaluate("h_inv", Quantity::h_inv, u, accuracy);
}

Column Copula::h_inv_upper(const PointsRef& u, Accuracy accuracy) const {
  require_columns("h_inv_upper", "u", u.cols(), 1, dim_);
  return evaluate("h_inv_upper", Quantity::h_inv_upper, u, accuracy);
}

Points Copula::rosenblatt(const PointsRef& u) const {
  require_points("rosenblatt", u, dim_, dim_);
  Points w(u.rows(), dim_);
  w.col(0) = u.col(0);
  for_each_chunk(u.rows(), [&](Index first, Index count) {
    for (int k = 1; k < dim_; ++k) {
      conditional_into(u.block(first, 0, count, k + 1), {}, Tail::lower, w.col(k).segment(first, count));
    }
  });
  return w;
}

Points Copula::inverse_rosenblatt(const PointsRef& w, const PointsRef& given) const {
  const Index fixed = given.cols();
  require_columns("inverse_rosenblatt", "given", fixed, 0, dim_ - 1);
  require_columns("inverse_rosenblatt", "w", w.cols(), dim_ - fixed, dim_ - fixed);
  if (given.rows() != 1) require_rows("inverse_rosenblatt", "given", given.rows(), w.rows());
  require_unit_cube("inverse_rosenblatt", "given", given);
  require_unit_cube("inverse_rosenblatt", "w", w);
  Points u(w.rows(), dim_);
  if (given.rows() == 1) {
    u.leftCols(fixed) = given.replicate(w.rows(), 1);
  } else {
    u.leftCols(fixed) = given;
  }
  u.rightCols(dim_ - fixed) = w;
  invert(u, fixed);
  return u;
}

void Copula::invert(Points& u, Index fixed) const {
  for_each_chunk(u.rows(), [&](Index first, Index count) {
    Column next(count);
    for (Index k = std::max(fixed, Index{1}); k < dim_; ++k) {
      conditional_inverse_into(u.block(first, 0, count, k + 1), {}, Tail::lower, next);
      u.col(k).segment(first, count) = next;
    }
  });
}

Points Copula::sample(Index n, Rng& rng, const PointsRef& given) const {
  if (n < 1) throw std::invalid_argument("sample: n must be 1 or more, got " + std::to_string(n));
  require_rows("sample", "given", given.rows(), 1);
  require_columns("sample", "given", given.cols(), 0, dim_ - 1);
  require_unit_cube("sample", "given", given);
  Points u(n, dim_);
  u.leftCols(given.cols()) = given.replicate(n, 1);
  fill_uniforms(rng, u.rightCols(dim_ - given.cols()));
  invert(u, given.cols());
  return u;
}

Points Copula::sample_by(Route route, Index n, Rng& rng) const {
  if (route == Route::conditional) return sample(n, rng);
  if (n < 1) throw std::invalid_argument("sample: n must be 1 or more, got " + std::to_string(n));
  if (route == Route::frailty && !has_frailty()) {
    throw std::domain_error("sample: this copula has no frailty; routes are conditional and radial");
  }
  Points u(n, dim_);
  std::vector<double> row(static_cast<std::size_t>(dim_));
  for (Index i = 0; i < n; ++i) {
    draw(route, {}, rng, row);
    for (Index k = 0; k < dim_; ++k) u(i, k) = row[static_cast<std::size_t>(k)];
  }
  return u;
}

std::vector<BigFloat> Copula::exact(Quantity quantity, const PointsRef& u, int digits) const {
  constexpr int kDigitsOfADouble = 17;
  require_digits(digits);
  const bool joint = quantity == Quantity::log_pdf || quantity == Quantity::log_cdf;
  require_points("exact", u, joint ? dim_ : 1, dim_);
  std::vector<BigFloat> values;
  for (Index i = 0; i < u.rows(); ++i) {
    const WorkingPrecision precision(kDigitsOfADouble);
    std::vector<BigFloat> row;
    for (Index k = 0; k < u.cols(); ++k) row.emplace_back(u(i, k));
    values.push_back(u.row(i).isNaN().any() ? std::numeric_limits<BigFloat>::quiet_NaN()
                                            : exact_row(quantity, row, {}, digits));
  }
  return values;
}

}  // namespace sklar
