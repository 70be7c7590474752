// Vector kernels of the Gumbel copula. Errors are counted in units of 2^-52: exp, log, expm1 and log1p are within 1.5,
// x = -log u and log x by 1.5 and 1.5 (1 + |log x|), an exponent z by 2 z beside what its factors carry.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "families/gumbel_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include "copula/simd/polynomial-inl.h"
#include "copula/simd/rows-inl.h"
#include "families/gumbel.hpp"

#ifndef SKLAR_FAMILIES_GUMBEL_SIMD_ONCE
#define SKLAR_FAMILIES_GUMBEL_SIMD_ONCE
namespace sklar::families::gumbel {

/// What depends on theta and the dimension alone.
struct KernelConstants {
  double theta;
  Coefficients polynomial;  // R_d
};

constexpr int kMostSteps = 8;

}  // namespace sklar::families::gumbel
#endif

HWY_BEFORE_NAMESPACE();
namespace sklar::families::gumbel::HWY_NAMESPACE {

using namespace sklar::simd;
using namespace sklar::simd::HWY_NAMESPACE::formulas;

// Relative: the next step of a method of order 3 is far below rounding.
template <class D>
constexpr double kLastStep = Precision<D>::kSingle ? 2e-3 : 1e-6;

/// log c = (theta-1) (sum log x_i - d log s) + sum x_i - s + log R_d(1/s), s^theta = sum x_i^theta.
template <bool kPair, class D>
HWY_INLINE Vec<D> log_pdf_rows(D d, const KernelConstants& c, const Columns<D>& rows) {
  const Index size = kPair ? 2 : rows.size();
  const auto n = static_cast<double>(size);
  const double excess = c.theta - 1;
  Sum<D, kPair> powers(d), x_sum(d), log_sum(d);
  Vec<D> sizes = hn::Zero(d);  // sum |log x_i|
  auto inside = rows.inside(0);
  for (Index k = 0; k < size; ++k) {
    inside = hn::And(inside, rows.inside(k));
    const Vec<D> x = hn::Neg(rows.log_of(k)), log_x = log(d, x), exponent = hn::Mul(hn::Set(d, c.theta), log_x);
    powers.add(d, exp(d, exponent));
    x_sum.add(d, x);
    log_sum.add(d, log_x);
    sizes = hn::Add(sizes, hn::Abs(log_x));
  }
  const Vec<D> log_power = log(d, powers.value()), log_s = hn::Mul(log_power, hn::Set(d, 1 / c.theta));
  inside = hn::And(inside, hn::Gt(log_power, hn::Set(d, Precision<D>::kLowestExponent)));
  const Vec<D> s = exp(d, log_s);
  const LogPolynomial<D> polynomial = log_polynomial(d, c.polynomial, hn::Set(d, 1.0), s);
  const Vec<D> ratios = hn::NegMulAdd(hn::Set(d, n), log_s, log_sum.value());
  const Vec<D> gap = hn::Sub(x_sum.value(), s);
  const Vec<D> value = hn::MulAdd(hn::Set(d, excess), ratios, hn::Add(gap, polynomial.log));
  // log s: a power t is off by t (3 theta + 2.5 |log t|), t |log t| <= sum max(1, |log sum|).
  const Vec<D> of_log_s = hn::MulAdd(hn::Set(d, 3.0), hn::Abs(log_s), hn::Set(d, 3 + 4 / c.theta));
  const Vec<D> weight = hn::Add(hn::Add(s, polynomial.slope), hn::Set(d, excess * n));
  const Vec<D> of_ratios = hn::MulAdd(hn::Set(d, 2.5 * excess), sizes, hn::Set(d, 1.5 * excess * n));
  const Vec<D> of_rest =
      hn::MulAdd(hn::Set(d, 2.5), hn::Add(x_sum.value(), s), hn::Abs(hn::Add(polynomial.log, polynomial.log)));
  const Vec<D> steps = hn::Set(d, n + 2 + c.polynomial.relative_error / Precision<D>::kUnit);
  const Vec<D> error = hn::MulAdd(of_log_s, weight, hn::Add(hn::Add(of_ratios, of_rest), steps));
  return log_within(d, {value, hn::Mul(hn::Set(d, Precision<D>::kUnit), error)}, inside);
}

template <class D>
HWY_INLINE Vec<D> log_pdf_row(D d, const KernelConstants& c, const Columns<D>& rows) {
  if (rows.size() == 2) return log_pdf_rows<true>(d, c, rows);
  return log_pdf_rows<false>(d, c, rows);
}

/// -log h = x expm1(l) + (theta-1) l, l = log1p((y/x)^theta) / theta.
template <class D>
HWY_INLINE Vec<D> conditional_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Vec<D> x = hn::Neg(rows.log_of(0)), log_ratio = log(d, hn::Div(hn::Neg(rows.log_of(1)), x));
  const Vec<D> exponent = hn::Mul(hn::Set(d, c.theta), log_ratio);
  const auto in_range = hn::Gt(exponent, hn::Set(d, Precision<D>::kLowestExponent));
  const Vec<D> l = hn::Mul(log1p(d, exp(d, exponent)), hn::Set(d, 1 / c.theta));
  const Vec<D> growth = expm1(d, l), slope = hn::MulAdd(x, hn::Add(growth, hn::Set(d, 1.0)), hn::Set(d, c.theta - 1));
  const Vec<D> y = hn::Neg(hn::MulAdd(x, growth, hn::Mul(hn::Set(d, c.theta - 1), l)));
  // Of l: relative 3 theta + 2 |exponent| + 3 of the power, weighed by its share in the logarithm.
  const Vec<D> share = hn::Min(l, hn::Set(d, 1 / c.theta));
  const Vec<D> of_power = hn::MulAdd(hn::Set(d, 2.5), hn::Abs(exponent), hn::Set(d, 4.0 * c.theta + 4));
  const Vec<D> of_l = hn::MulAdd(of_power, share, hn::Mul(hn::Set(d, 2.0), l));
  const Vec<D> error = hn::MulAdd(of_l, slope, hn::Mul(hn::Set(d, -4.0), y));
  return probability(d, tail, y, hn::Mul(hn::Set(d, Precision<D>::kUnit), error), kHTolerance,
                     hn::And(in_range, hn::And(rows.inside(0), rows.inside(1))));
}

/// l by Halley's iteration for the convex x expm1(l) + (theta-1) l = -log p from a point below the root, then
/// y = x e^l (1 - e^(-theta l))^(1/theta), v = e^-y.
template <class D>
HWY_INLINE Vec<D> conditional_inverse_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Vec<D> excess = hn::Set(d, c.theta - 1);
  const Vec<D> x = hn::Neg(rows.log_of(0)), target = hn::Neg(rows.log_of(1));
  Vec<D> l = log1p(d, hn::Div(target, hn::Add(x, excess)));
  Exponential<D> e = exponential(d, l);
  auto moving = hn::Gt(l, hn::Zero(d));  // a lane that has arrived stays, whatever its neighbours do
  for (int i = 0; i < kMostSteps && !hn::AllFalse(d, moving); ++i) {
    const Vec<D> excess_value = hn::Sub(hn::MulAdd(x, e.expm1, hn::Mul(excess, l)), target);
    const Vec<D> second = hn::Mul(x, e.exp), slope = hn::Add(second, excess);
    const Vec<D> twice = hn::Add(excess_value, excess_value);
    const Vec<D> step =
        hn::Div(hn::Mul(twice, slope), hn::NegMulAdd(excess_value, second, hn::Mul(hn::Add(slope, slope), slope)));
    l = hn::Sub(l, hn::IfThenElseZero(moving, step));
    e = exponential(d, l);
    moving = hn::And(moving, hn::Gt(hn::Abs(step), hn::Mul(hn::Set(d, kLastStep<D>), l)));
  }
  const Vec<D> log_loss = log(d, hn::Neg(expm1(d, hn::Mul(hn::Set(d, -c.theta), l))));
  const Vec<D> factor = exp(d, hn::Mul(log_loss, hn::Set(d, 1 / c.theta)));
  const Vec<D> y = hn::Neg(hn::Mul(hn::Mul(x, e.exp), factor));
  // Of l: 6 relative, from both sides of the equation, times max(1, theta l) / theta l of log y.
  const Vec<D> of_log = hn::Add(hn::MulAdd(hn::Set(d, 8.0), l, hn::Set(d, 20.0)), hn::Abs(log_loss));
  const Vec<D> error = hn::Mul(of_log, hn::Neg(y));
  const auto found = hn::And(hn::Gt(l, hn::Set(d, Precision<D>::kSmallest)), hn::Not(moving));
  return probability(d, tail, y, hn::Mul(hn::Set(d, Precision<D>::kUnit), error), kInverseTolerance,
                     hn::And(found, hn::And(rows.inside(0), rows.inside(1))));
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

}  // namespace sklar::families::gumbel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::families::gumbel {

HWY_EXPORT(table);

std::shared_ptr<const Kernels> kernels(double theta, Coefficients polynomial) {
  if (!(theta < 1e6)) return nullptr;
  return make_kernels(KernelConstants{theta, std::move(polynomial)}, *HWY_DYNAMIC_DISPATCH(table)());
}

}  // namespace sklar::families::gumbel
#endif
