// Vector kernels of the Joe copula. Errors are counted in units of 2^-52: exp, log, expm1 and log1p are within 1.5, an
// exponent z = theta log(1-u) by 2 |z|.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "families/joe_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include "copula/simd/product-inl.h"
#include "copula/simd/rows-inl.h"
#include "families/joe.hpp"

#ifndef SKLAR_FAMILIES_JOE_SIMD_ONCE
#define SKLAR_FAMILIES_JOE_SIMD_ONCE
namespace sklar::families::joe {

/// What depends on theta and the dimension alone.
struct KernelConstants {
  double theta;
  double rest;  // 1 - 1/theta
  double log_theta;
  Coefficients polynomial;  // R_d
};

constexpr int kMostSteps = 20;

}  // namespace sklar::families::joe
#endif

HWY_BEFORE_NAMESPACE();
namespace sklar::families::joe::HWY_NAMESPACE {

using namespace sklar::simd;
using namespace sklar::simd::HWY_NAMESPACE::formulas;

// Relative: the next step of a method of order 2 is below rounding.
template <class D>
constexpr double kLastStep = Precision<D>::kSingle ? 1e-4 : 1e-9;

/// log(1-u), q = (1-u)^theta and p = 1 - q.
template <class D>
struct Weight {
  HWY_INLINE Weight(D d, const KernelConstants& c, const Columns<D>& rows, Index k) : log_upper(rows.log_of_upper(k)) {
    const Exponential<D> e = exponential(d, hn::Mul(hn::Set(d, c.theta), log_upper));
    q = e.exp;
    p = hn::Neg(e.expm1);
  }

  Vec<D> log_upper, q, p;
};

/// log c = (d-1) log theta + (theta-1) sum log(1-u_i) - (1 - 1/theta) log w + log R_d(P/w), P = prod p_i, w = 1 - P.
template <bool kPair, class D>
HWY_INLINE Vec<D> log_pdf_rows(D d, const KernelConstants& c, const Columns<D>& rows) {
  const Index size = kPair ? 2 : rows.size();
  const auto n = static_cast<double>(size);
  Product<D, kPair> product(d);
  Sum<D, kPair> log_sum(d);
  auto inside = rows.inside(0);
  for (Index k = 0; k < size; ++k) {
    inside = hn::And(inside, rows.inside(k));
    const Weight<D> weight(d, c, rows, k);
    product.multiply(d, weight.p, weight.q);
    log_sum.add(d, weight.log_upper);
  }
  const auto parts = product.parts(d, 1.0, 0.0);
  inside = hn::And(inside, hn::Gt(parts.w, hn::Set(d, Precision<D>::kSmallestProbability)));
  // q |log q| is below 1 - q, and where q is below w, below w max(1, |log w|).
  const Vec<D> of_w =
      hn::MulAdd(hn::Set(d, 2.0), hn::Max(hn::Abs(log(d, parts.w)), hn::Set(d, 1.0)), hn::Set(d, n / 2 + 3));
  const Estimate<D> term = log_ratio_term(d, c.polynomial, parts, c.rest, hn::Set(d, 3.5 * n + 1), of_w);
  const Vec<D> upper = hn::Mul(hn::Set(d, c.theta - 1), log_sum.value());
  const Vec<D> value = hn::Add(hn::Add(hn::Set(d, (n - 1) * c.log_theta), upper), term.value);
  const Vec<D> error = hn::Add(hn::MulAdd(hn::Set(d, -2.5), upper, hn::Set(d, 2 * n * c.log_theta)), term.error);
  return log_within(d, {value, hn::Mul(hn::Set(d, Precision<D>::kUnit), error)}, inside);
}

template <class D>
HWY_INLINE Vec<D> log_pdf_row(D d, const KernelConstants& c, const Columns<D>& rows) {
  if (rows.size() == 2) return log_pdf_rows<true>(d, c, rows);
  return log_pdf_rows<false>(d, c, rows);
}

/// log h = log p_v - (1 - 1/theta) log1p(p_u q_v / q_u).
template <class D>
HWY_INLINE Vec<D> conditional_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Weight<D> u(d, c, rows, 0), v(d, c, rows, 1);
  const Vec<D> exponent = hn::Mul(hn::Set(d, c.theta), hn::Sub(v.log_upper, u.log_upper));
  const Vec<D> ratio = hn::Mul(u.p, exp(d, exponent)), log_growth = log1p(d, ratio);
  const Vec<D> log_p = log_of_complement(d, v.p, v.q);
  const Vec<D> y = hn::NegMulAdd(hn::Set(d, c.rest), log_growth, log_p);
  const Vec<D> sizes = hn::Mul(hn::Set(d, -c.theta), hn::Add(u.log_upper, v.log_upper));
  const Vec<D> of_ratio = hn::MulAdd(hn::Set(d, 2.5), sizes, hn::Set(d, 8.0));
  const Vec<D> share = hn::Min(log_growth, hn::Set(d, 1.0));
  const Vec<D> of_v = hn::MulAdd(hn::Set(d, -2.5 * c.theta), v.log_upper, hn::Set(d, 4.0));
  // Of log p: relative 2 z + 4 where q is small, and q z / p <= 1 + log p where it is not.
  const Vec<D> of_p = hn::Min(hn::Mul(of_v, hn::Neg(log_p)), hn::MulAdd(hn::Set(d, -2.0), log_p, hn::Set(d, 5.0)));
  const Vec<D> error = hn::Add(hn::MulAdd(of_ratio, share, of_p), hn::Mul(hn::Set(d, -2.0), y));
  return probability(d, tail, y, hn::Mul(hn::Set(d, Precision<D>::kUnit), error), kHTolerance,
                     hn::And(rows.inside(0), rows.inside(1)));
}

/// s = -log p_v by Newton's iteration for the concave s + (1 - 1/theta) log1p(k (1 - e^-s)) = -log p, k = p_u / q_u,
/// from a point below the root; q_v = 1 - e^-s, 1 - v = q_v^(1/theta).
template <class D>
HWY_INLINE Vec<D> conditional_inverse_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Weight<D> u(d, c, rows, 0);
  const Vec<D> rest = hn::Set(d, c.rest), one = hn::Set(d, 1.0);
  const Vec<D> odds = hn::Div(u.p, u.q), target = hn::Neg(rows.log_of(1));
  Vec<D> s = hn::Div(target, hn::MulAdd(rest, odds, one)), slope = one;
  Exponential<D> e = exponential(d, hn::Neg(s));
  auto moving = hn::Gt(s, hn::Zero(d));  // a lane that has arrived stays, whatever its neighbours do
  for (int i = 0; i < kMostSteps && !hn::AllFalse(d, moving); ++i) {
    const Vec<D> ratio = hn::Mul(odds, hn::Neg(e.expm1)), sum = hn::Add(ratio, one);
    const Vec<D> missing = hn::Sub(target, hn::MulAdd(rest, log1p(d, ratio), s));
    const Vec<D> new_slope = hn::Add(one, hn::Div(hn::Mul(hn::Mul(rest, odds), e.exp), sum));
    const Vec<D> step = hn::Div(missing, new_slope);
    slope = hn::IfThenElse(moving, new_slope, slope);
    s = hn::Add(s, hn::IfThenElseZero(moving, step));
    e = exponential(d, hn::Neg(s));
    moving = hn::And(moving, hn::Gt(hn::Abs(step), hn::Mul(hn::Set(d, kLastStep<D>), s)));
  }
  const Vec<D> q = hn::Neg(e.expm1), log_upper = hn::Mul(log_of_complement(d, q, e.exp), hn::Set(d, 1 / c.theta));
  // Of s: what odds carry, and the target's 1.5 by how much s answers it; log q moves by s e^-s / q <= 1 of that. The
  // logarithm adds 2 and what q and e^-s carry, 1.5 / q where q is above 1/2.
  const Vec<D> of_odds = hn::MulAdd(hn::Set(d, -2.5 * c.theta), u.log_upper, hn::Set(d, 12.0));
  const Vec<D> of_s = hn::MulAdd(hn::Set(d, 4.0), hn::Div(target, hn::Mul(slope, s)), of_odds);
  const Vec<D> of_q = hn::Mul(of_s, hn::Div(hn::Mul(s, e.exp), q));
  const Vec<D> error = hn::MulAdd(of_q, hn::Set(d, 1 / c.theta), hn::Mul(hn::Set(d, -5.0), log_upper));
  const auto in_range = hn::And(hn::Gt(u.q, hn::Set(d, Precision<D>::kSmallestProbability)),
                                hn::Gt(q, hn::Set(d, Precision<D>::kSmallestProbability)));
  return probability(d, tail == Tail::lower ? Tail::upper : Tail::lower, log_upper,
                     hn::Mul(hn::Set(d, Precision<D>::kUnit), error), kInverseTolerance,
                     hn::And(hn::And(in_range, hn::Not(moving)), hn::And(rows.inside(0), rows.inside(1))));
}

struct Formulas {
  static constexpr int kPartsSingle = 4;

  static bool answers_log_pdf(const KernelConstants& c, [[maybe_unused]] Index columns) {
    return c.polynomial.usable();
  }
  static bool answers_conditional(const KernelConstants&, Index columns) { return columns == 2; }

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

}  // namespace sklar::families::joe::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::families::joe {

HWY_EXPORT(table);

std::shared_ptr<const Kernels> kernels(double theta, Coefficients polynomial) {
  if (!(theta < 1e6)) return nullptr;
  return make_kernels(KernelConstants{theta, (theta - 1) / theta, std::log(theta), std::move(polynomial)},
                      *HWY_DYNAMIC_DISPATCH(table)());
}

}  // namespace sklar::families::joe
#endif
