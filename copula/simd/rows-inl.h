/// Loops over the rows of a batch for one instruction set, and what the formulas of families share; included once for
/// each (see Highway's foreach_target.h).

#if defined(SKLAR_COPULA_SIMD_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKLAR_COPULA_SIMD_ROWS_INL_H_
#undef SKLAR_COPULA_SIMD_ROWS_INL_H_
#else
#define SKLAR_COPULA_SIMD_ROWS_INL_H_
#endif

#include <algorithm>
#include <limits>
#include <vector>

#include "copula/kernels.hpp"
#include "copula/simd/pack-inl.h"
#include "copula/tolerance.hpp"

HWY_BEFORE_NAMESPACE();
namespace sklar::simd::HWY_NAMESPACE::formulas {

/// The coordinates of one vector of points.
template <class D>
class Columns {
 public:
  Columns(D, const double* first, Index stride, Index size) : first_(first), stride_(stride), size_(size) {}

  [[nodiscard]] Index size() const { return size_; }
  HWY_INLINE Vec<D> operator[](Index k) const { return hn::LoadU(D(), first_ + k * stride_); }

 private:
  const double* first_;
  Index stride_, size_;
};

/// A result with a bound of its absolute error.
template <class D>
struct Estimate {
  Vec<D> value, error;
};

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
inline constexpr double kLowestExponent = -650;  ///< e^x for less, as exponential has it, is below 1e-25 of e^x here
inline constexpr double kSmallestProbability = 1e-280;  ///< what is below is left to the exact route

/// The value where the point is inside and the error at most kLogTolerance max(1, |value|), else NaN.
template <class D>
HWY_INLINE Vec<D> log_within(D d, const Estimate<D>& x, Mask<D> inside) {
  const Vec<D> size = hn::Max(hn::Abs(x.value), hn::Set(d, 1.0));
  const auto good = hn::Le(x.error, hn::Mul(hn::Set(d, kLogTolerance), size));
  return hn::IfThenElse(hn::And(good, inside), x.value, hn::NaN(d));
}

/// The value where the point is inside, the relative error at most the tolerance, and the value from
/// kSmallestProbability to 1, else NaN.
template <class D>
HWY_INLINE Vec<D> probability_within(D d, Vec<D> value, Vec<D> relative_error, double tolerance, Mask<D> inside) {
  const auto in_range = hn::And(hn::Ge(value, hn::Set(d, kSmallestProbability)), hn::Le(value, hn::Set(d, 1.0)));
  const auto good = hn::And(in_range, hn::Le(relative_error, hn::Set(d, tolerance)));
  return hn::IfThenElse(hn::And(good, inside), value, hn::NaN(d));
}

/// e^y or 1 - e^y from y <= 0 with its absolute error.
template <class D>
HWY_INLINE Vec<D> probability(D d, Tail tail, Vec<D> y, Vec<D> error, double tolerance, Mask<D> inside) {
  const Exponential<D> e = exponential(d, y);
  const Vec<D> rounding = hn::Set(d, 2 * kEpsilon);
  if (tail == Tail::lower) return probability_within(d, e.exp, hn::Add(error, rounding), tolerance, inside);
  const Vec<D> share = hn::Div(hn::Sub(y, hn::Set(d, 1.0)), y);  // |d log(1 - e^y)| <= (1 - 1/y) |dy|
  return probability_within(d, hn::Neg(e.expm1), hn::MulAdd(error, share, rounding), tolerance, inside);
}

/// Whether the coordinate is a normal number below 1.
template <class D>
HWY_INLINE Mask<D> is_inside(D d, Vec<D> u) {
  return hn::And(hn::Ge(u, hn::Set(d, std::numeric_limits<double>::min())), hn::Lt(u, hn::Set(d, 1.0)));
}

template <class D>
HWY_INLINE Vec<D> sum_rounded(D, Vec<D> a, Vec<D> b, Vec<D>& lost) {
  const Vec<D> sum = hn::Add(a, b), b_rounded = hn::Sub(sum, a);
  lost = hn::Add(lost, hn::Add(hn::Sub(a, hn::Sub(sum, b_rounded)), hn::Sub(b, b_rounded)));
  return sum;
}

/// A sum that loses no digits, by Knuth's two-sum.
template <class D>
class Sum {
 public:
  explicit Sum(D d) : sum_(hn::Zero(d)), lost_(sum_) {}
  HWY_INLINE void add(D d, Vec<D> x) { sum_ = sum_rounded(d, sum_, x, lost_); }
  HWY_INLINE Vec<D> value() const { return hn::Add(sum_, lost_); }

 private:
  Vec<D> sum_, lost_;
};

/// out[i] = formula(d, columns of row i) for rows from first in steps of a pack; returns the first row left.
template <class D, class Formula>
Index fill(D d, Index first, const Rows& rows, double* out, const Formula& formula) {
  for (; first + hn::size(d) <= rows.count; first += hn::size(d)) {
    hn::StoreU(formula(d, Columns<D>(d, rows.first + first, rows.stride, rows.columns)), d, out + first);
  }
  return first;
}

/// out[i] = formula(d, columns of row i). A row's value does not depend on its place.
template <class Formula>
void for_each_row(const Rows& rows, double* out, const Formula& formula) {
  constexpr int kParts = 4;
  constexpr Index kMostLanes = 8, kOnStack = 16;
  const pack::Tag<double, 1> d;
  Index row = fill(pack::Tag<double, kParts>(), 0, rows, out, formula);
  row = fill(d, row, rows, out, formula);
  if (row == rows.count) return;
  // A last vector, filled up with its last row.
  const Index lanes = hn::size(d), left = rows.count - row;
  double small[kMostLanes * kOnStack], results[kMostLanes];
  std::vector<double> large(static_cast<std::size_t>(rows.columns > kOnStack ? rows.columns * lanes : 0));
  double* const padded = large.empty() ? small : large.data();
  for (Index k = 0; k < rows.columns; ++k) {
    const double* column = rows.first + row + k * rows.stride;
    for (Index lane = 0; lane < lanes; ++lane) padded[k * lanes + lane] = column[std::min(lane, left - 1)];
  }
  using D = pack::Tag<double, 1>;
  hn::StoreU(formula(d, Columns<D>(d, padded, lanes, rows.columns)), d, results);
  std::copy_n(results, left, out + row);
}

inline void leave_all(const Rows& rows, double* out) {
  std::fill_n(out, rows.count, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace sklar::simd::HWY_NAMESPACE::formulas
HWY_AFTER_NAMESPACE();

#endif
