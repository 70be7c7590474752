// Vector kernels of the Frank copula.
//
// In dimension 2, with C of theta > 0 at hand, -theta has v - C(1-u, v) (Genest 1987, sec. 2): h and its inverse of
// -theta at u are those of theta at 1 - u, and so is the density. Errors are counted in units of 2^-52: exp, log and
// log1p are within 1.5, an exponent theta u is off by theta u / 2.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "families/frank_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include "copula/simd/product-inl.h"
#include "copula/simd/rows-inl.h"
#include "families/frank.hpp"

#ifndef SKLAR_FAMILIES_FRANK_SIMD_ONCE
#define SKLAR_FAMILIES_FRANK_SIMD_ONCE
namespace sklar::families::frank {

/// What depends on theta and the dimension alone.
struct KernelConstants {
  KernelConstants(double parameter, Coefficients coefficients)
      : theta(std::abs(parameter)),
        negative(parameter < 0),
        q(-std::expm1(-theta)),
        inverse_q(1 / q),
        tail(std::exp(-theta)),
        upper_scale(std::expm1(theta)),
        log_theta_by_q(std::log(theta / q)),
        widening(std::max(1.0, 4 / theta)),
        polynomial(std::move(coefficients)) {}

  double theta;  // absolute value
  bool negative;
  double q;  // 1 - e^-theta
  double inverse_q;
  double tail;         // e^-theta
  double upper_scale;  // e^theta - 1
  double log_theta_by_q;
  double widening;  // theta u is a normal number from this multiple of the smallest on
  Coefficients polynomial;
};

}  // namespace sklar::families::frank
#endif

HWY_BEFORE_NAMESPACE();
namespace sklar::families::frank::HWY_NAMESPACE {

using namespace sklar::simd;
using namespace sklar::simd::HWY_NAMESPACE::formulas;

/// Whether u is inside and theta u and e^(-theta u) are normal numbers.
template <class D>
HWY_INLINE Mask<D> is_inside(const KernelConstants& c, const Columns<D>& rows, Index k) {
  if (c.theta > -Precision<D>::kLowestExponent) return rows.inside(k, 2.0);  // none
  return rows.inside(k, Precision<D>::kSmallest * c.widening);
}

/// exp(-theta u) and 1 - exp(-theta u).
template <class D>
struct Weight {
  HWY_INLINE Weight(D d, const KernelConstants& c, Vec<D> u) {
    const Exponential<D> e = exponential(d, hn::Mul(hn::Set(d, -c.theta), u));
    rest = e.exp;
    value = hn::Neg(e.expm1);
  }

  Vec<D> rest, value;
};

/// log c = log(theta/q) - theta (u+v) - 2 log(1 - x), with X = 1 - e^(-theta u), Y alike, u >= v:
/// 1 - x = 1 - X Y / q or (X e^(-theta v) + e^(-theta u) - e^-theta) / q, whichever does not cancel.
template <class D>
HWY_INLINE Vec<D> log_pdf_pair(D d, const KernelConstants& c, const Columns<D>& rows) {
  const Vec<D> u = c.negative ? rows.upper(0) : rows[0], v = rows[1];
  const auto inside = hn::And(is_inside(c, rows, 0), is_inside(c, rows, 1));
  const Weight<D> larger(d, c, hn::Max(u, v)), smaller(d, c, hn::Min(u, v));
  const Vec<D> scaled = hn::Mul(larger.value, hn::Set(d, c.inverse_q));
  const Vec<D> direct = hn::NegMulAdd(scaled, smaller.value, hn::Set(d, 1.0));
  const Vec<D> difference = hn::Mul(hn::Sub(larger.rest, hn::Set(d, c.tail)), hn::Set(d, c.inverse_q));
  const Vec<D> sum = hn::MulAdd(scaled, smaller.rest, difference);
  const Vec<D> complement = hn::IfThenElse(hn::Gt(larger.value, hn::Set(d, 0.5)), sum, direct);
  const Vec<D> front = hn::NegMulAdd(hn::Set(d, c.theta), hn::Add(u, v), hn::Set(d, c.log_theta_by_q));
  const Vec<D> log_complement = log(d, complement);
  const Vec<D> value = hn::NegMulAdd(hn::Set(d, 2.0), log_complement, front);
  const Vec<D> error = hn::Sub(hn::MulAdd(hn::Set(d, c.theta), hn::Add(u, v), hn::Set(d, 2 * c.theta + 15)),
                               hn::Mul(hn::Set(d, 3.0), log_complement));
  return log_within(d, {value, hn::Mul(hn::Set(d, Precision<D>::kUnit), error)}, inside);
}

/// log c = (d-1) log(theta/q) - theta sum u_i + log R_d(x/w) - log w, x = q prod a_i, a_i = (1 - e^(-theta u_i)) / q.
template <class D>
HWY_INLINE Vec<D> log_pdf_rows(D d, const KernelConstants& c, const Columns<D>& rows) {
  const auto n = static_cast<double>(rows.size());
  const Vec<D> inverse_q = hn::Set(d, c.inverse_q);
  Product<D> product(d);
  Sum<D> sum(d);
  auto inside = is_inside(c, rows, 0);
  for (Index k = 0; k < rows.size(); ++k) {
    const Vec<D> u = rows[k];
    inside = hn::And(inside, is_inside(c, rows, k));
    const Weight<D> a(d, c, u);
    product.multiply(d, hn::Mul(a.value, inverse_q), hn::Mul(hn::Sub(a.rest, hn::Set(d, c.tail)), inverse_q));
    sum.add(d, u);
  }
  const auto parts = product.parts(d, c.q, c.tail);
  const Vec<D> of_difference = hn::Div(hn::Set(d, n * c.tail * (c.theta / 2 + 2)), parts.w);
  const Vec<D> of_w = hn::Add(of_difference, hn::Set(d, n / 2 + c.theta / 2 + 3));
  const Estimate<D> term = log_ratio_term(d, c.polynomial, parts, 1.0, hn::Set(d, 2.3 * n + 2), of_w);
  const double constant = (n - 1) * c.log_theta_by_q;
  const Vec<D> exponent = hn::Mul(hn::Set(d, c.theta), sum.value());
  const Vec<D> value = hn::Add(hn::Sub(hn::Set(d, constant), exponent), term.value);
  const Vec<D> error = hn::Add(hn::MulAdd(hn::Set(d, 1.5), exponent, hn::Set(d, 2 * constant)), term.error);
  return log_within(d, {value, hn::Mul(hn::Set(d, Precision<D>::kUnit), error)}, inside);
}

template <class D>
HWY_INLINE Vec<D> log_pdf_row(D d, const KernelConstants& c, const Columns<D>& rows) {
  if (rows.size() == 2) return log_pdf_pair(d, c, rows);
  return log_pdf_rows(d, c, rows);
}

/// h = a r / (r + X delta), 1 - h = delta / (r + X delta): r = e^(-theta u), X = 1 - r, a = (1 - e^(-theta v))/q and
/// delta = 1 - a = e^-theta expm1(theta (1-v)) / q.
template <class D>
HWY_INLINE Vec<D> conditional_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const auto inside = hn::And(is_inside(c, rows, 0), is_inside(c, rows, 1));
  const Weight<D> given(d, c, c.negative ? rows.upper(0) : rows[0]);
  Vec<D> value;
  if (tail == Tail::lower) {
    const Weight<D> a(d, c, rows[1]);
    const Vec<D> delta = hn::Mul(hn::Sub(a.rest, hn::Set(d, c.tail)), hn::Set(d, c.inverse_q));
    const Vec<D> divisor = hn::MulAdd(given.value, delta, given.rest);
    value = hn::Div(hn::Mul(hn::Mul(a.value, hn::Set(d, c.inverse_q)), given.rest), divisor);
  } else {
    const Vec<D> growth = expm1(d, hn::Mul(hn::Set(d, c.theta), rows.upper(1)));
    const Vec<D> delta = hn::Mul(growth, hn::Set(d, c.tail * c.inverse_q));
    value = hn::Div(delta, hn::MulAdd(given.value, delta, given.rest));
  }
  return probability_within(d, value, hn::Set(d, Precision<D>::kUnit * (3 * c.theta + 12)), kHTolerance, inside);
}

/// a = p / (p + r (1-p)), delta = r (1-p) / (p + r (1-p)); v = -log(1 - q a) / theta with 1 - q a = e^-theta + q delta,
/// 1 - v = log(1 + expm1(theta) delta) / theta.
template <class D>
HWY_INLINE Vec<D> conditional_inverse_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Vec<D> one = hn::Set(d, 1.0);
  const Vec<D> u = c.negative ? rows.upper(0) : rows[0], p = rows[1];
  const auto inside = hn::And(is_inside(c, rows, 0), is_inside(c, rows, 1));
  const Vec<D> rest = hn::Mul(exp(d, hn::Mul(hn::Set(d, -c.theta), u)), rows.upper(1));
  const Vec<D> inverse_sum = hn::Div(one, hn::Add(p, rest)), delta = hn::Mul(rest, inverse_sum);
  Vec<D> value;
  if (tail == Tail::lower) {
    const Vec<D> x = hn::Mul(hn::Mul(p, inverse_sum), hn::Set(d, c.q));
    const Vec<D> complement = hn::MulAdd(hn::Set(d, c.q), delta, hn::Set(d, c.tail));
    value = hn::Mul(log_of_complement(d, complement, x), hn::Set(d, -1 / c.theta));
  } else {
    value = hn::Mul(log1p(d, hn::Mul(hn::Set(d, c.upper_scale), delta)), hn::Set(d, 1 / c.theta));
  }
  return probability_within(d, value, hn::Set(d, Precision<D>::kUnit * (2 * c.theta + 20)), kInverseTolerance, inside);
}

struct Formulas {
  static constexpr int kPartsSingle = 4;

  static bool answers_log_pdf(const KernelConstants& c, Index columns) {
    return columns == 2 || (!c.negative && c.polynomial.usable());
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

}  // namespace sklar::families::frank::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::families::frank {

HWY_EXPORT(table);

std::shared_ptr<const Kernels> kernels(double theta, Coefficients polynomial) {
  constexpr double kSmallest = 1e-150, kLargest = 500;  // e^theta and 1/theta are far within double
  if (!(std::abs(theta) > kSmallest && std::abs(theta) < kLargest)) return nullptr;
  return make_kernels(KernelConstants(theta, std::move(polynomial)), *HWY_DYNAMIC_DISPATCH(table)());
}

}  // namespace sklar::families::frank
#endif
