// Vector kernels of the Joe copula. Errors are counted in units of 2^-52; an exponent z = theta log(1-u) is off by
// 2 |z|.

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
  std::vector<Coefficients> polynomials;  // R_n at n
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

/// P = prod p_i and w = 1 - P of some coordinates, with their errors; kPair: of two.
template <class D, bool kPair = false>
struct Weights {
  HWY_INLINE Weights(D d, const KernelConstants& c, const Columns<D>& rows, Index count) : inside(rows.inside(0)) {
    const auto n = static_cast<double>(count);
    Product<D, kPair> product(d);
    Sum<D, kPair> log_sum(d);
    of_x = hn::Set(d, kPair ? 8.0 : 2.0);
    for (Index k = 0; k < count; ++k) {
      inside = hn::And(inside, rows.inside(k));
      const Weight<D> weight(d, c, rows, k);
      if constexpr (kPair) {
        product.multiply(d, weight.p, weight.q);
      } else {
        const Vec<D> size = hn::MulAdd(hn::Set(d, -2 * c.theta), weight.log_upper, hn::Set(d, 1.0));
        const Factor<D> factor(d, weight.p, 3.5, weight.q, hn::Mul(weight.q, size));
        product.multiply(d, factor.value, factor.lost, weight.q);
        of_x = hn::Add(of_x, factor.error);
      }
      log_sum.add(d, weight.log_upper);
    }
    log_uppers = log_sum.value();
    const double of_complements = n / 2 + 3;
    parts = product.parts(d, 1.0, 0.0, of_x, hn::Set(d, of_complements + 2));
    inside = hn::And(inside, hn::Gt(parts.w, hn::Set(d, Precision<D>::kSmallestProbability)));
    // q |log q| is below 1 - q, and where q is below w, below w max(1, |log w|).
    const Vec<D> log_size = hn::Max(hn::Abs(log(d, parts.w)), hn::Set(d, 1.0));
    of_w = hn::MulAdd(hn::Set(d, 2.0), log_size, hn::Set(d, of_complements));
  }

  HWY_INLINE Vec<D> of_odds() const { return error_of_odds(parts, of_x, of_w); }

  Mask<D> inside;
  Vec<D> log_uppers;  // sum log(1-u_i)
  Parts<D> parts;
  Vec<D> of_x, of_w;
};

/// log c = (d-1) log theta + (theta-1) sum log(1-u_i) - (1 - 1/theta) log w + log R_d(P/w).
template <bool kPair, class D>
HWY_INLINE Vec<D> log_pdf_rows(D d, const KernelConstants& c, const Columns<D>& rows) {
  const Index size = kPair ? 2 : rows.size();
  const auto n = static_cast<double>(size);
  const Weights<D, kPair> all(d, c, rows, size);
  const Coefficients& polynomial = c.polynomials[static_cast<std::size_t>(size)];
  const Estimate<D> term = log_ratio_term(d, polynomial, all.parts, c.rest, all.of_x, all.of_w);
  const Vec<D> upper = hn::Mul(hn::Set(d, c.theta - 1), all.log_uppers);
  const Vec<D> front = hn::Add(hn::Set(d, (n - 1) * c.log_theta), upper), value = hn::Add(front, term.value);
  // Each log(1-u) by half of it and kLog1pPartError; the constant by 1.5.
  const Vec<D> least = hn::Min(hn::Neg(upper), hn::Set(d, n * (c.theta - 1) * kLog1pPartError));
  const Vec<D> of_upper = hn::NegMulAdd(hn::Set(d, 1.5), upper, least);
  const Vec<D> rounding = hn::Mul(hn::Set(d, 0.5), hn::Add(hn::Abs(front), hn::Abs(value)));
  const Vec<D> of_front = hn::Add(hn::Add(of_upper, rounding), hn::Set(d, 1.5 * n * c.log_theta));
  const Vec<D> error = hn::Add(of_front, term.error);
  return log_within(d, {value, hn::Mul(hn::Set(d, Precision<D>::kUnit), error)}, all.inside);
}

template <class D>
HWY_INLINE Vec<D> log_pdf_row(D d, const KernelConstants& c, const Columns<D>& rows) {
  if (rows.size() == 2) return log_pdf_rows<true>(d, c, rows);
  return log_pdf_rows<false>(d, c, rows);
}

/// log h = log p_v - (1 - 1/theta) log1p(p_u q_v / q_u).
template <class D>
HWY_INLINE Vec<D> conditional_pair(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
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

/// -log h from z, 1 - z and its parts: -log p - (1 - 1/theta) log D - log( R_j(y z) / R_j(y) ), all positive, D = w + P
/// z = 1 / (1 + P q/w).
template <class D>
struct Level {
  HWY_INLINE Level(D d, const KernelConstants& c, const Coefficients& r, const ScaledArgument<D>& at, Vec<D> log_p,
                   Vec<D> log_divisor, Vec<D> z, Vec<D> distance, const RatioErrors<D>& of)
      : ratio(decrease(d, r, at, z, distance, of)) {
    const Estimate<D> rest = ratio.fraction.minus_log(d);
    value = hn::Sub(rest.value, hn::MulAdd(hn::Set(d, c.rest), log_divisor, log_p));
    error = hn::MulAdd(hn::Set(d, 3.0), value, rest.error);
  }

  Decrease<D> ratio;
  Vec<D> value, error;  // error: of the ratio and what the logarithms add
};

template <class D>
HWY_INLINE Vec<D> conditional_rows(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Index last = rows.size() - 1;
  const Weights<D> given(d, c, rows, last);
  const Parts<D>& parts = given.parts;
  const Vec<D> of_odds = given.of_odds();
  const Weight<D> v(d, c, rows, last);
  const Vec<D> of_q = hn::MulAdd(hn::Set(d, -2 * c.theta), v.log_upper, hn::Set(d, 3.0));
  const Vec<D> growth = hn::Mul(parts.x, v.q), inverse = hn::Div(hn::Set(d, 1.0), hn::Add(growth, parts.w));
  const Vec<D> share = hn::Mul(parts.w, inverse);  // D
  const Vec<D> z = hn::Mul(v.p, share), distance = hn::Mul(v.q, inverse), lost = hn::Mul(growth, inverse);
  const Vec<D> log_p = log_of_complement(d, v.p, v.q), log_divisor = log_of_complement(d, share, lost);
  // p is off by 3.5, or where q is below 1/2, by q of_q.
  const Vec<D> of_growth = hn::Add(of_odds, of_q), of_lost = hn::Mul(lost, of_growth);
  const Vec<D> of_p = hn::MulAdd(hn::Add(of_q, of_q), v.q, hn::Mul(hn::Set(d, 8.0), lost));
  const RatioErrors<D> of{of_odds, hn::Add(of_lost, hn::Set(d, 7.0)),
                          hn::MulAdd(hn::Mul(parts.x, z), of_odds, hn::Add(of_q, hn::Set(d, 4.0)))};
  const Coefficients& r = c.polynomials[static_cast<std::size_t>(last)];
  const ScaledArgument<D> at(d, r, parts.x, parts.w);
  const Level<D> level(d, c, r, at, log_p, log_divisor, z, distance, of);
  const Vec<D> error = hn::Mul(hn::Set(d, Precision<D>::kUnit), hn::Add(level.error, hn::Add(of_lost, of_p)));
  const auto in_range = hn::Gt(v.q, hn::Set(d, Precision<D>::kSmallestProbability));
  return probability(d, tail, hn::Neg(level.value), error, kHTolerance,
                     hn::And(hn::And(in_range, given.inside), hn::And(level.ratio.inside, rows.inside(last))));
}

template <class D>
HWY_INLINE Vec<D> conditional_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  if constexpr (!Precision<D>::kSingle) {
    if (rows.size() > 2) return conditional_rows(d, c, tail, rows);
  }
  return conditional_pair(d, c, tail, rows);
}

/// s = -log p_v by Newton's iteration for the concave s + (1 - 1/theta) log1p(k (1 - e^-s)) = -log p, k = p_u / q_u,
/// from a point below the root; q_v = 1 - e^-s, 1 - v = q_v^(1/theta).
template <class D>
HWY_INLINE Vec<D> conditional_inverse_pair(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
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

/// The step of Newton's method for s = -log z.
template <class D>
class LevelTrial {
 public:
  HWY_INLINE LevelTrial(D d, const KernelConstants& c, const Coefficients& r, const Parts<D>& parts, Vec<D> of_odds,
                        Vec<D> log_target)
      : c_(c), r_(r), at_(d, r, parts.x, parts.w), parts_(parts), of_odds_(of_odds), log_target_(log_target) {}

  HWY_INLINE Trial<D> operator()(D d, Vec<D> s) const {
    const Exponential<D> e = exponential(d, hn::Neg(s));
    const Vec<D> one = hn::Set(d, 1.0), rounding = hn::Set(d, 1.5), distance = hn::Neg(e.expm1);
    const Vec<D> divisor = hn::MulAdd(parts_.x, e.exp, parts_.w), inverse = hn::Div(one, divisor);
    const Vec<D> lost = hn::Mul(parts_.x, distance), w = hn::Mul(parts_.w, inverse);
    const Vec<D> p = hn::Mul(e.exp, inverse), q = hn::Mul(distance, w);
    const Level<D> level(d, c_, r_, at_, log_of_complement(d, p, q), log_of_complement(d, divisor, lost), e.exp,
                         distance, RatioErrors<D>{of_odds_, rounding, rounding});
    const Vec<D> slope =
        hn::Add(level.ratio.slope, hn::MulAdd(hn::Mul(hn::Set(d, c_.rest), e.exp), hn::Mul(parts_.x, inverse), w));
    // log p and log D change by x q dy/y.
    const Vec<D> of_odds = hn::Mul(hn::Mul(parts_.x, q), hn::Add(of_odds_, of_odds_));
    const Vec<D> of_logs = hn::MulAdd(hn::Set(d, 12.0), hn::Min(one, hn::Add(q, lost)), of_odds);
    const Vec<D> error = hn::NegMulAdd(rounding, log_target_, hn::Add(level.error, of_logs));
    return {hn::Neg(hn::Div(hn::Add(log_target_, level.value), slope)), hn::Div(error, slope), level.ratio.inside};
  }

 private:
  const KernelConstants& c_;
  const Coefficients& r_;
  ScaledArgument<D> at_;
  Parts<D> parts_;
  Vec<D> of_odds_, log_target_;
};

/// 1 - v = q^(1/theta).
template <class D>
HWY_INLINE Vec<D> conditional_inverse_rows(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Index last = rows.size() - 1;
  const Weights<D> given(d, c, rows, last);
  const Vec<D> of_odds = given.of_odds();
  const Coefficients& r = c.polynomials[static_cast<std::size_t>(last)];
  const LevelTrial<D> trial(d, c, r, given.parts, of_odds, rows.log_of(last));
  const Root<D> root = find_root(d, hn::Zero(d), trial);
  const NextWeight<D> next(d, given.parts, of_odds, root);
  const Vec<D> q = next.complement;
  const Vec<D> log_upper = hn::Mul(log_of_complement(d, q, next.value), hn::Set(d, 1 / c.theta));
  const Vec<D> carried = hn::Div(hn::Mul(next.error, hn::Set(d, 1 / c.theta)), q);
  const Vec<D> error = hn::Mul(hn::NegMulAdd(hn::Set(d, 14.0), log_upper, carried), hn::Set(d, Precision<D>::kUnit));
  const auto in_range = hn::Gt(q, hn::Set(d, Precision<D>::kSmallestProbability));
  return probability(d, tail == Tail::lower ? Tail::upper : Tail::lower, log_upper, error, kInverseTolerance,
                     hn::And(hn::And(in_range, given.inside), hn::And(root.found, rows.inside(last))));
}

template <class D>
HWY_INLINE Vec<D> conditional_inverse_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  if constexpr (!Precision<D>::kSingle) {
    if (rows.size() > 2) return conditional_inverse_rows(d, c, tail, rows);
  }
  return conditional_inverse_pair(d, c, tail, rows);
}

struct Formulas {
  static constexpr int kPartsSingle = 4;

  static bool answers_log_pdf(const KernelConstants& c, Index columns) {
    return c.polynomials[static_cast<std::size_t>(columns)].usable();
  }
  static bool answers_conditional(const KernelConstants& c, Index columns) {
    return columns == 2 || c.polynomials[static_cast<std::size_t>(columns) - 1].usable();
  }

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

std::shared_ptr<const Kernels> kernels(double theta, std::vector<Coefficients> polynomials) {
  if (!(theta < 1e6)) return nullptr;
  return make_kernels(KernelConstants{theta, (theta - 1) / theta, std::log(theta), std::move(polynomials)},
                      *HWY_DYNAMIC_DISPATCH(table)());
}

}  // namespace sklar::families::joe
#endif
