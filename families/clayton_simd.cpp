// Vector kernels of the Clayton copula, theta > 0. Errors are counted in units of 2^-52; an exponent z is off by 2 z.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "families/clayton_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include "copula/simd/math-inl.h"
#include "copula/simd/rows-inl.h"
#include "families/clayton.hpp"

#ifndef SKLAR_FAMILIES_CLAYTON_SIMD_ONCE
#define SKLAR_FAMILIES_CLAYTON_SIMD_ONCE
namespace sklar::families::clayton {

/// What depends on theta and the dimension alone.
struct KernelConstants {
  double theta;
  std::vector<double> log_rising;  // entry k: sum_{i<k} log(1 + i theta)
};

}  // namespace sklar::families::clayton
#endif

HWY_BEFORE_NAMESPACE();
namespace sklar::families::clayton::HWY_NAMESPACE {

using namespace sklar::simd;
using namespace sklar::simd::HWY_NAMESPACE::formulas;

/// sum expm1(-theta log u_i) over some coordinates and what else the formulas take of them.
template <class D>
struct Sums {
  HWY_INLINE Sums(D d, const KernelConstants& c, const Columns<D>& rows, Index count)
      : growth(hn::Zero(d)), logs(growth), carried(growth), inside(rows.inside(0)) {
    const bool few = count <= 2;  // two terms need no compensation
    const Vec<D> theta = hn::Set(d, -c.theta), least = hn::Set(d, kLogPartError * c.theta);
    Sum<D> growths(d), log_sum(d);
    for (Index k = 0; k < count; ++k) {
      inside = hn::And(inside, rows.inside(k));
      const Vec<D> log_u = log(d, rows[k]), exponent = hn::Mul(theta, log_u);
      const Exponential<D> e = exponential(d, exponent);
      if (few) {
        growth = hn::Add(growth, e.expm1);
        logs = hn::Add(logs, log_u);
      } else {
        growths.add(d, e.expm1);
        log_sum.add(d, log_u);
        carried = hn::MulAdd(e.exp, hn::Add(exponent, hn::Min(exponent, least)), carried);
      }
    }
    if (few) return;
    growth = growths.value();
    logs = log_sum.value();
  }

  Vec<D> growth, logs;
  Vec<D> carried;  // of more than two: what their exponents add to the error of growth
  Mask<D> inside;

  /// The relative error of 1 + growth: of each expm1, 2.2, and the error of its exponent z times e^z.
  HWY_INLINE Vec<D> error(D d) const {
    return hn::Div(hn::MulAdd(hn::Set(d, 2.7), growth, carried), hn::Add(growth, hn::Set(d, 1.0)));
  }

  /// At least log(1 + growth): prod x_i >= 1 + sum (x_i - 1) for x_i >= 1, with equality for one.
  HWY_INLINE Vec<D> log_bound(D d, const KernelConstants& c, Index count) const {
    if (count <= 2) return hn::Mul(hn::Set(d, -c.theta), logs);
    return log(d, hn::Add(growth, hn::Set(d, 1.0)));
  }
};

/// What the rounding of u to single precision adds to the relative error of 1 + growth and, a coordinate, to the error
/// of log u, in units.
template <class D>
HWY_INLINE double growth_rounding(const KernelConstants& c) {
  return Precision<D>::kSingle ? c.theta : 0;
}
template <class D>
constexpr double kLogRounding = Precision<D>::kSingle ? 1 : 0;

/// Error of log1p(x) in units of 2^-52, x of relative error e (1 + log1p(x)), by x/(1+x) <= min(1, log1p(x)).
template <class D>
HWY_INLINE Vec<D> error_of_log1p(D d, Vec<D> value, double e) {
  const Vec<D> of_x = hn::MulAdd(hn::Set(d, e), value, hn::Set(d, e));
  return hn::MulAdd(of_x, hn::Min(value, hn::Set(d, 1.0)), hn::Mul(hn::Set(d, 1.5), value));
}

/// log c = sum_{k<d} log(1 + k theta) - (1 + theta) sum log u_i - (d + 1/theta) log(1 + sum expm1(-theta log u_i)).
template <class D>
HWY_INLINE Vec<D> log_pdf_pair(D d, const KernelConstants& c, const Columns<D>& rows) {
  const Sums<D> sums(d, c, rows, 2);
  const double power = 2 + 1 / c.theta, rising = c.log_rising.back();
  const Vec<D> log_sum = log1p(d, sums.growth);
  const Vec<D> front = hn::NegMulAdd(hn::Set(d, 1 + c.theta), sums.logs, hn::Set(d, rising));
  const Vec<D> value = hn::NegMulAdd(hn::Set(d, power), log_sum, front);
  const double of_u = kLogRounding<D> * 2 * (1 + c.theta) + power * growth_rounding<D>(c);
  const Vec<D> of_logs = hn::MulAdd(hn::Set(d, -3 * (1 + c.theta)), sums.logs, hn::Set(d, 2 * rising + of_u));
  const Vec<D> error = hn::MulAdd(hn::Set(d, power), error_of_log1p(d, log_sum, 2.5), of_logs);
  return log_within(d, {value, hn::Mul(hn::Set(d, Precision<D>::kUnit), error)}, sums.inside);
}

/// A constant as the sum of two numbers.
struct Exactly {
  explicit Exactly(long double x) : value(static_cast<double>(x)), lost(static_cast<double>(x - value)) {}
  double value, lost;
};

template <class D>
HWY_INLINE Vec<D> log_pdf_rows(D d, const KernelConstants& c, const Columns<D>& rows) {
  constexpr double kProduct = HWY_NATIVE_FMA ? 0 : 0.5;
  const Sums<D> sums(d, c, rows, rows.size());
  const auto n = static_cast<double>(rows.size());
  const Exactly power(n + 1 / static_cast<long double>(c.theta)), slope(1 + static_cast<long double>(c.theta));
  const Vec<D> half = hn::Set(d, 0.5), log_sum = log1p(d, sums.growth), rising = hn::Set(d, c.log_rising.back());
  const Vec<D> lost = hn::MulAdd(hn::Set(d, power.lost), log_sum, hn::Mul(hn::Set(d, slope.lost), sums.logs));
  const Vec<D> front = hn::NegMulAdd(hn::Set(d, slope.value), sums.logs, rising);
  const Vec<D> value = hn::Sub(hn::NegMulAdd(hn::Set(d, power.value), log_sum, front), lost);
  // Of the sum of logarithms: that of each, and its own rounding.
  const Vec<D> scaled_logs = hn::Mul(hn::Set(d, -slope.value), sums.logs);
  const Vec<D> least = hn::Min(scaled_logs, hn::Set(d, n * slope.value * kLogPartError));
  const Vec<D> of_logs = hn::MulAdd(hn::Set(d, 1 + kProduct), scaled_logs, least);
  const Vec<D> of_log1p = hn::MulAdd(half, log_sum, hn::Min(hn::Add(log_sum, log_sum), hn::Set(d, kLog1pPartError)));
  const Vec<D> of_log_sum = hn::MulAdd(hn::Set(d, kProduct), log_sum, hn::Add(of_log1p, sums.error(d)));
  const Vec<D> of_terms = hn::MulAdd(hn::Set(d, power.value), of_log_sum, of_logs);
  const Vec<D> roundings = hn::MulAdd(half, hn::Add(hn::Abs(front), rising), hn::Abs(value));
  return log_within(d, {value, hn::Mul(hn::Set(d, Precision<D>::kUnit), hn::Add(of_terms, roundings))}, sums.inside);
}

template <class D>
HWY_INLINE Vec<D> log_pdf_row(D d, const KernelConstants& c, const Columns<D>& rows) {
  if (rows.size() == 2) return log_pdf_pair(d, c, rows);
  return log_pdf_rows(d, c, rows);
}

/// log h = -(j + 1/theta) log1p(E/S), E = expm1(-theta log v), S = 1 + the sum over the j given.
template <class D>
HWY_INLINE Vec<D> conditional_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Index last = rows.size() - 1;
  const Sums<D> given(d, c, rows, last);
  const double power = static_cast<double>(last) + 1 / c.theta;
  const Vec<D> sum = hn::Add(given.growth, hn::Set(d, 1.0));
  const Vec<D> exponent = hn::Mul(hn::Set(d, -c.theta), rows.log_of(last));
  const Vec<D> ratio = hn::Div(expm1(d, exponent), sum), log_growth = log1p(d, ratio);
  const Vec<D> y = hn::Mul(hn::Set(d, -power), log_growth);
  // Of E: 1.5 + 2 exponent e^exponent/E; of S: 2.5 (1 + log S) at most, log S <= exponent sizes of the given.
  const Vec<D> of_ratio =
      hn::MulAdd(hn::Set(d, 2.0), exponent,
                 hn::MulAdd(hn::Set(d, 2.5), given.log_bound(d, c, last), hn::Set(d, 8 + growth_rounding<D>(c))));
  const Vec<D> share = hn::Min(log_growth, hn::Set(d, 1.0));
  const Vec<D> error = hn::MulAdd(hn::Set(d, power), hn::Mul(of_ratio, share), hn::Mul(hn::Set(d, -2.0), y));
  return probability(d, tail, y, hn::Mul(hn::Set(d, Precision<D>::kUnit), error), kHTolerance,
                     hn::And(given.inside, rows.inside(last)));
}

/// log v = -log1p(S expm1(-log p / (j + 1/theta))) / theta.
template <class D>
HWY_INLINE Vec<D> conditional_inverse_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Index last = rows.size() - 1;
  const Sums<D> given(d, c, rows, last);
  const double power = static_cast<double>(last) + 1 / c.theta;
  const Vec<D> sum = hn::Add(given.growth, hn::Set(d, 1.0));
  const Vec<D> exponent = hn::Mul(hn::Set(d, -1 / power), rows.log_of(last));
  const Vec<D> growth = hn::Mul(expm1(d, exponent), sum), log_growth = log1p(d, growth);
  const Vec<D> y = hn::Mul(hn::Set(d, -1 / c.theta), log_growth);
  const Vec<D> of_growth = hn::MulAdd(hn::Set(d, 2.5), given.log_bound(d, c, last),
                                      hn::MulAdd(hn::Set(d, 2.0), exponent, hn::Set(d, 8 + growth_rounding<D>(c))));
  const Vec<D> share = hn::Min(log_growth, hn::Set(d, 1.0));
  const Vec<D> error = hn::MulAdd(hn::Set(d, 1 / c.theta), hn::Mul(of_growth, share), hn::Mul(hn::Set(d, -2.0), y));
  return probability(d, tail, y, hn::Mul(hn::Set(d, Precision<D>::kUnit), error), kInverseTolerance,
                     hn::And(given.inside, rows.inside(last)));
}

struct Formulas {
  static constexpr int kPartsSingle = 4;

  static bool answers_log_pdf([[maybe_unused]] const KernelConstants& c, [[maybe_unused]] Index columns) {
    return true;
  }
  static bool answers_conditional(const KernelConstants&, [[maybe_unused]] Index columns) { return true; }

  template <class D>
  static HWY_INLINE Vec<D> log_pdf(D d, const KernelConstants& c, const Columns<D>& rows) {
    return log_pdf_row(d, c, rows);
  }
  template <class D>
  static HWY_INLINE Vec<D> conditional(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
    return conditional_row(d, c, tail, rows);
  }
  template <class D>
  static HWY_INLINE Vec<D> conditional_inverse(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
    return conditional_inverse_row(d, c, tail, rows);
  }
};

const KernelTable<KernelConstants>* table() {
  return table_of<Formulas, KernelConstants>();
}

}  // namespace sklar::families::clayton::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::families::clayton {

HWY_EXPORT(table);

std::shared_ptr<const Kernels> kernels(double theta, std::vector<double> log_rising) {
  constexpr double kSmallest = 1e-100;  // far above it 1/theta leaves the range of double
  if (!(theta > kSmallest)) return nullptr;
  return make_kernels(KernelConstants{theta, std::move(log_rising)}, *HWY_DYNAMIC_DISPATCH(table)());
}

}  // namespace sklar::families::clayton
#endif
