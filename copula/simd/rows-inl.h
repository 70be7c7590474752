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

/// What depends on the type of the lanes.
template <class D>
struct Precision {
  using Real = typename D::Scalar;
  static constexpr bool kSingle = sizeof(Real) == sizeof(float);

  /// The unit in which errors are counted. Counting takes every rounding at its worst; in single precision, whose bound
  /// is tested and not proved, at half of it.
  static constexpr double kUnit = kSingle ? 0x1p-24 : 0x1p-52;
  static constexpr double kSmallest = std::numeric_limits<Real>::min();
  /// e^x for less, as exponential has it, is far below the rounding of e^x here.
  static constexpr double kLowestExponent = kSingle ? -65 : -650;
  static constexpr double kSmallestProbability = kSingle ? 1e-30 : 1e-280;

  /// The tolerance of standard accuracy, or that of fast.
  static constexpr double tolerance(double standard) { return kSingle ? kFastTolerance : standard; }
};

/// The coordinates of a pack of points.
template <class D>
class Columns {
 public:
  Columns(D, const double* first, Index stride, Index size) : first_(first), stride_(stride), size_(size) {}

  [[nodiscard]] Index size() const { return size_; }

  /// u and 1 - u.
  HWY_INLINE Vec<D> operator[](Index k) const { return hn::load(D(), first_ + k * stride_); }
  HWY_INLINE Vec<D> upper(Index k) const { return hn::load(D(), first_ + k * stride_, pack::OneMinus()); }

  /// log u and log(1-u): in single precision from whichever of u and 1 - u is below 1/2, in double both are exact
  /// enough.
  HWY_INLINE Vec<D> log_of(Index k) const {
    if constexpr (Precision<D>::kSingle) return log_of_complement(D(), (*this)[k], upper(k));
    return log(D(), (*this)[k]);
  }
  HWY_INLINE Vec<D> log_of_upper(Index k) const {
    if constexpr (Precision<D>::kSingle) return log_of_complement(D(), upper(k), (*this)[k]);
    return log1p(D(), hn::Neg((*this)[k]));
  }

  /// Whether the coordinate is a normal number below 1.
  HWY_INLINE Mask<D> inside(Index k, double lowest = Precision<D>::kSmallest) const {
    return hn::And(hn::Ge((*this)[k], hn::Set(D(), lowest)), hn::Lt((*this)[k], hn::Set(D(), 1.0)));
  }

 private:
  const double* first_;
  Index stride_, size_;
};

/// Of log x = log m + k log 2, sqrt(1/2) <= m < sqrt(2): its last rounding, half a unit, and what log m is off by
/// before it, 0.11 and half of |log m| <= 0.35. log1p x rounds 1 + x once more. In double; relative to log x it is at
/// most 1.4.
constexpr double kLogPartError = 0.3, kLog1pPartError = 0.5;
template <class D>
HWY_INLINE Vec<D> error_of_log(D d, Vec<D> log_x) {
  const Vec<D> size = hn::Abs(log_x);
  return hn::MulAdd(hn::Set(d, 0.5), size, hn::Min(size, hn::Set(d, kLogPartError)));
}

/// A result with a bound of its absolute error.
template <class D>
struct Estimate {
  Vec<D> value, error;
};

/// The value where the point is inside and the error at most kLogTolerance max(1, |value|), else NaN.
template <class D>
HWY_INLINE Vec<D> log_within(D d, const Estimate<D>& x, Mask<D> inside) {
  const Vec<D> size = hn::Max(hn::Abs(x.value), hn::Set(d, 1.0));
  const auto good = hn::Le(x.error, hn::Mul(hn::Set(d, Precision<D>::tolerance(kLogTolerance)), size));
  return hn::IfThenElse(hn::And(good, inside), x.value, hn::NaN(d));
}

/// The value where the point is inside, the relative error at most the tolerance, and the value from
/// kSmallestProbability to 1, else NaN.
template <class D>
HWY_INLINE Vec<D> probability_within(D d, Vec<D> value, Vec<D> relative_error, double tolerance, Mask<D> inside) {
  const auto in_range =
      hn::And(hn::Ge(value, hn::Set(d, Precision<D>::kSmallestProbability)), hn::Le(value, hn::Set(d, 1.0)));
  const auto good = hn::And(in_range, hn::Le(relative_error, hn::Set(d, Precision<D>::tolerance(tolerance))));
  return hn::IfThenElse(hn::And(good, inside), value, hn::NaN(d));
}

/// e^y or 1 - e^y from y <= 0 with its absolute error.
template <class D>
HWY_INLINE Vec<D> probability(D d, Tail tail, Vec<D> y, Vec<D> error, double tolerance, Mask<D> inside) {
  const Exponential<D> e = exponential(d, y);
  const Vec<D> rounding = hn::Set(d, 2 * Precision<D>::kUnit);
  if (tail == Tail::lower) return probability_within(d, e.exp, hn::Add(error, rounding), tolerance, inside);
  const Vec<D> share = hn::Div(hn::Sub(y, hn::Set(d, 1.0)), y);  // |d log(1 - e^y)| <= (1 - 1/y) |dy|
  return probability_within(d, hn::Neg(e.expm1), hn::MulAdd(error, share, rounding), tolerance, inside);
}

template <class D>
HWY_INLINE Vec<D> sum_rounded(D, Vec<D> a, Vec<D> b, Vec<D>& lost) {
  const Vec<D> sum = hn::Add(a, b), b_rounded = hn::Sub(sum, a);
  lost = hn::Add(lost, hn::Add(hn::Sub(a, hn::Sub(sum, b_rounded)), hn::Sub(b, b_rounded)));
  return sum;
}

/// A sum that loses no digits, by Knuth's two-sum, or where kPlain one of two terms, which needs no such care.
template <class D, bool kPlain = false>
class Sum {
 public:
  explicit Sum(D d) : sum_(hn::Zero(d)), lost_(sum_) {}
  HWY_INLINE void add(D d, Vec<D> x) { sum_ = kPlain ? hn::Add(sum_, x) : sum_rounded(d, sum_, x, lost_); }
  HWY_INLINE Vec<D> value() const { return kPlain ? sum_ : hn::Add(sum_, lost_); }

 private:
  Vec<D> sum_, lost_;
};

/// a b - product, product the rounded a b: exact, unless it is below the smallest number.
template <class D>
HWY_INLINE Vec<D> lost_of_product([[maybe_unused]] D d, Vec<D> a, Vec<D> b, Vec<D> product) {
#if HWY_NATIVE_FMA
  return hn::Neg(hn::NegMulAdd(a, b, product));
#else  // Dekker's product of halves
  const Vec<D> splitter = hn::Set(d, Precision<D>::kSingle ? 0x1p12 + 1 : 0x1p27 + 1);
  const Vec<D> a_scaled = hn::Mul(splitter, a), b_scaled = hn::Mul(splitter, b);
  const Vec<D> a_high = hn::Sub(a_scaled, hn::Sub(a_scaled, a)), a_low = hn::Sub(a, a_high);
  const Vec<D> b_high = hn::Sub(b_scaled, hn::Sub(b_scaled, b)), b_low = hn::Sub(b, b_high);
  const Vec<D> high = hn::Sub(hn::Mul(a_high, b_high), product);
  return hn::Add(hn::Add(hn::Add(high, hn::Mul(a_high, b_low)), hn::Mul(a_low, b_high)), hn::Mul(a_low, b_low));
#endif
}

/// A product that loses no digits, of factors x + lost with lost about the rounding of x, or where kPlain one of two
/// factors without what they lost.
template <class D, bool kPlain = false>
class ExactProduct {
 public:
  explicit ExactProduct(D d) : product_(hn::Set(d, 1.0)), lost_(hn::Zero(d)) {}
  HWY_INLINE void multiply(D d, Vec<D> x, Vec<D> lost) {
    const Vec<D> next = hn::Mul(product_, x);
    if constexpr (kPlain) {
      product_ = next;
      return;
    }
    const Vec<D> of_this = hn::MulAdd(product_, lost, lost_of_product(d, product_, x, next));
    lost_ = hn::MulAdd(lost_, x, of_this);
    product_ = next;
  }
  HWY_INLINE Vec<D> value() const { return kPlain ? product_ : hn::Add(product_, lost_); }

 private:
  Vec<D> product_, lost_;
};

/// out[i] = formula(d, columns of row i) for rows from first in steps of a pack; returns the first row left over.
/// @param all cleared where a value is NaN.
template <class D, class Formula>
Index fill(D d, Index first, const Rows& rows, double* out, const Formula& formula, bool& all) {
  const Vec<D> zero = hn::Zero(d);
  auto answered = hn::Le(zero, zero);
  for (; first + hn::size(d) <= rows.count; first += hn::size(d)) {
    const Vec<D> value = formula(d, Columns<D>(d, rows.first + first, rows.stride, rows.columns));
    answered = hn::And(answered, hn::Le(value, value));
    hn::store(value, d, out + first);
  }
  all = all && hn::AllFalse(d, hn::Not(answered));
  return first;
}

/// out[i] = formula(d, columns of row i). A row's value does not depend on its place.
template <class Real, int kParts, class Formula>
Answered for_each_row(const Rows& rows, double* out, const Formula& formula) {
  constexpr Index kMostLanes = 16, kOnStack = 16;
  using D = pack::Tag<Real, 1>;
  const D d;
  bool all = true;
  Index row = fill(pack::Tag<Real, kParts>(), 0, rows, out, formula, all);
  row = fill(d, row, rows, out, formula, all);
  if (row < rows.count) {  // a last vector, filled up with its last row
    const Index lanes = hn::size(d), left = rows.count - row;
    double small[kMostLanes * kOnStack], results[kMostLanes];
    std::vector<double> large(static_cast<std::size_t>(rows.columns > kOnStack ? rows.columns * lanes : 0));
    double* const padded = large.empty() ? small : large.data();
    for (Index k = 0; k < rows.columns; ++k) {
      const double* column = rows.first + row + k * rows.stride;
      for (Index lane = 0; lane < lanes; ++lane) padded[k * lanes + lane] = column[std::min(lane, left - 1)];
    }
    Rows last = rows;
    last.first = padded;
    last.stride = last.count = lanes;
    fill(d, 0, last, results, formula, all);
    std::copy_n(results, left, out + row);
  }
  return all ? Answered::all : Answered::some;
}

/// The functions of a family in one precision. Formulas has, static:
///   answers_log_pdf(c, columns), answers_conditional(c, columns)   whether the formulas hold
///   log_pdf(d, c, columns), conditional(d, c, tail, columns), conditional_inverse(d, c, tail, columns)
///   kPartsSingle   vectors of a pack in single precision, as many as measured best
/// Single precision is for points of two coordinates: the coefficients of more leave its range.
template <class Real, class Formulas, class Constants>
constexpr KernelFunctions<Constants> functions_of() {
  constexpr bool kSingle = sizeof(Real) == sizeof(float);
  constexpr Index kMostColumns = kSingle ? 2 : std::numeric_limits<Index>::max();
  constexpr int kParts = kSingle ? Formulas::kPartsSingle : 4;
  return {.log_pdf =
              [](const Constants& c, const Rows& rows, double* out) {
                if (rows.columns > kMostColumns || !Formulas::answers_log_pdf(c, rows.columns)) return Answered::none;
                return for_each_row<Real, kParts>(
                    rows, out, [&](auto d, const auto& columns) HWY_ATTR { return Formulas::log_pdf(d, c, columns); });
              },
          .conditional =
              [](const Constants& c, const Rows& rows, Tail tail, double* out) {
                if (rows.columns > kMostColumns || !Formulas::answers_conditional(c, rows.columns))
                  return Answered::none;
                return for_each_row<Real, kParts>(rows, out, [&](auto d, const auto& columns) HWY_ATTR {
                  return Formulas::conditional(d, c, tail, columns);
                });
              },
          .conditional_inverse =
              [](const Constants& c, const Rows& rows, Tail tail, double* out) {
                if (rows.columns > kMostColumns || !Formulas::answers_conditional(c, rows.columns))
                  return Answered::none;
                return for_each_row<Real, kParts>(rows, out, [&](auto d, const auto& columns) HWY_ATTR {
                  const auto value = Formulas::conditional_inverse(d, c, tail, columns);
                  // Whether 1 is the nearest double is for the exact route to say.
                  return hn::IfThenElse(hn::Lt(value, hn::Set(d, 1.0)), value, hn::NaN(d));
                });
              }};
}

/// What one instruction set offers for a family.
template <class Formulas, class Constants>
const KernelTable<Constants>* table_of() {
  static constexpr KernelTable<Constants> kTable = {.standard = functions_of<double, Formulas, Constants>(),
                                                    .fast = functions_of<float, Formulas, Constants>()};
  return &kTable;
}

}  // namespace sklar::simd::HWY_NAMESPACE::formulas
HWY_AFTER_NAMESPACE();

#endif
