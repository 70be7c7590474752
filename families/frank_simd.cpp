// Vector kernels of the Frank copula.
//
// In dimension 2, with C of theta > 0 at hand, -theta has v - C(1-u, v) (Genest 1987, sec. 2): h and its inverse of
// -theta at u are those of theta at 1 - u, and so is the density. Errors are counted in units of 2^-52; an exponent
// theta u is off by theta u / 2.

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
  KernelConstants(double parameter, std::vector<Coefficients> coefficients)
      : theta(std::abs(parameter)),
        negative(parameter < 0),
        q(-std::expm1(-theta)),
        inverse_q(1 / q),
        tail(std::exp(-theta)),
        upper_scale(std::expm1(theta)),
        log_theta_by_q(std::log(-theta / std::expm1(-static_cast<long double>(theta)))),
        widening(std::max(1.0, 4 / theta)),
        polynomials(std::move(coefficients)) {}

  double theta;  // absolute value
  bool negative;
  double q;  // 1 - e^-theta
  double inverse_q;
  double tail;         // e^-theta
  double upper_scale;  // e^theta - 1
  long double log_theta_by_q;
  double widening;                        // theta u is a normal number from this multiple of the smallest on
  std::vector<Coefficients> polynomials;  // R_n at n
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
  const Vec<D> front =
      hn::NegMulAdd(hn::Set(d, c.theta), hn::Add(u, v), hn::Set(d, static_cast<double>(c.log_theta_by_q)));
  const Vec<D> log_complement = log(d, complement);
  const Vec<D> value = hn::NegMulAdd(hn::Set(d, 2.0), log_complement, front);
  const Vec<D> error = hn::Sub(hn::MulAdd(hn::Set(d, c.theta), hn::Add(u, v), hn::Set(d, 2 * c.theta + 15)),
                               hn::Mul(hn::Set(d, 3.0), log_complement));
  return log_within(d, {value, hn::Mul(hn::Set(d, Precision<D>::kUnit), error)}, inside);
}

/// x = q prod a_i, a_i = (1 - e^(-theta u_i)) / q, and w of some coordinates, with their errors.
template <class D>
struct Weights {
  HWY_INLINE Weights(D d, const KernelConstants& c, const Columns<D>& rows, Index count)
      : inside(is_inside(c, rows, 0)) {
    const auto n = static_cast<double>(count);
    const Vec<D> inverse_q = hn::Set(d, c.inverse_q);
    Product<D> product(d);
    Sum<D> sum_of_u(d);
    of_x = hn::Set(d, 3.0);
    for (Index k = 0; k < count; ++k) {
      const Vec<D> u = rows[k];
      inside = hn::And(inside, is_inside(c, rows, k));
      const Weight<D> a(d, c, u);
      const Vec<D> complement = hn::Mul(hn::Sub(a.rest, hn::Set(d, c.tail)), inverse_q);
      const Vec<D> of_complement = hn::MulAdd(hn::MulAdd(hn::Set(d, c.theta / 2), u, hn::Set(d, 2.5)), complement,
                                              hn::Set(d, c.tail * c.inverse_q * (c.theta / 2 + 1.5)));
      const Factor<D> factor(d, hn::Mul(a.value, inverse_q), 3.5, complement, of_complement);
      product.multiply(d, factor.value, factor.lost, complement);
      of_x = hn::Add(of_x, factor.error);
      sum_of_u.add(d, u);
    }
    sum = sum_of_u.value();
    const double of_complements = n / 2 + c.theta / 2 + 3;
    parts = product.parts(d, c.q, c.tail, of_x, hn::Set(d, of_complements));
    const Vec<D> of_difference = hn::Div(hn::Set(d, n * c.tail * (c.theta / 2 + 2)), parts.w);
    of_w = hn::Add(of_difference, hn::Set(d, of_complements));
  }

  HWY_INLINE Vec<D> of_odds() const { return error_of_odds(parts, of_x, of_w); }

  Mask<D> inside;
  Vec<D> sum;  // of u_i
  Parts<D> parts;
  Vec<D> of_x, of_w;
};

/// log c = (d-1) log(theta/q) - theta sum u_i + log R_d(x/w) - log w.
template <class D>
HWY_INLINE Vec<D> log_pdf_rows(D d, const KernelConstants& c, const Columns<D>& rows) {
  const Weights<D> all(d, c, rows, rows.size());
  const Coefficients& polynomial = c.polynomials[static_cast<std::size_t>(rows.size())];
  const Estimate<D> term = log_ratio_term(d, polynomial, all.parts, 1.0, all.of_x, all.of_w);
  const auto constant = static_cast<double>(static_cast<long double>(rows.size() - 1) * c.log_theta_by_q);
  const Vec<D> exponent = hn::Mul(hn::Set(d, c.theta), all.sum), front = hn::Sub(hn::Set(d, constant), exponent);
  const Vec<D> value = hn::Add(front, term.value);
  const Vec<D> rounding = hn::Mul(hn::Set(d, 0.5), hn::Add(hn::Abs(front), hn::Abs(value)));
  const Vec<D> error = hn::Add(hn::Add(exponent, hn::Set(d, constant / 2 + 1)), hn::Add(rounding, term.error));
  return log_within(d, {value, hn::Mul(hn::Set(d, Precision<D>::kUnit), error)}, all.inside);
}

template <class D>
HWY_INLINE Vec<D> log_pdf_row(D d, const KernelConstants& c, const Columns<D>& rows) {
  if (rows.size() == 2) return log_pdf_pair(d, c, rows);
  return log_pdf_rows(d, c, rows);
}

/// h = a r / (r + X delta), 1 - h = delta / (r + X delta): r = e^(-theta u), X = 1 - r, a = (1 - e^(-theta v))/q and
/// delta = 1 - a = e^-theta expm1(theta (1-v)) / q.
template <class D>
HWY_INLINE Vec<D> conditional_pair(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
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

/// h = z R_j(y z) / R_j(y), y = x/w of the j given.
template <class D>
HWY_INLINE Vec<D> conditional_rows(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Index last = rows.size() - 1;
  const Weights<D> given(d, c, rows, last);
  const Vec<D> a = hn::Mul(Weight<D>(d, c, rows[last]).value, hn::Set(d, c.inverse_q));
  const Vec<D> growth = expm1(d, hn::Mul(hn::Set(d, c.theta), rows.upper(last)));
  const Vec<D> delta = hn::Mul(growth, hn::Set(d, c.tail * c.inverse_q));
  const NextFactor<D> next(d, given.parts, given.of_odds(), a, delta, 4, 0.75 * c.theta + 5);
  const Coefficients& r = c.polynomials[static_cast<std::size_t>(last)];
  const ScaledArgument<D> at(d, r, given.parts.x, given.parts.w);
  const Decrease<D> total = decrease_with_factor(d, r, at, next.z, next.distance, next.of);
  const auto inside = hn::And(hn::And(given.inside, total.inside), is_inside(c, rows, last));
  return total.fraction.probability(d, tail, kHTolerance, inside);
}

template <class D>
HWY_INLINE Vec<D> conditional_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  if constexpr (!Precision<D>::kSingle) {
    if (rows.size() > 2) return conditional_rows(d, c, tail, rows);
  }
  return conditional_pair(d, c, tail, rows);
}

/// v or 1 - v from a(v) and delta = 1 - a: v = -log(1 - q a) / theta with 1 - q a = e^-theta + q delta, 1 - v =
/// log(1 + expm1(theta) delta) / theta.
template <class D>
HWY_INLINE Vec<D> value_at(D d, const KernelConstants& c, Tail tail, Vec<D> a, Vec<D> delta) {
  if (tail == Tail::upper) {
    return hn::Mul(log1p(d, hn::Mul(hn::Set(d, c.upper_scale), delta)), hn::Set(d, 1 / c.theta));
  }
  const Vec<D> complement = hn::MulAdd(hn::Set(d, c.q), delta, hn::Set(d, c.tail));
  return hn::Mul(log_of_complement(d, complement, hn::Mul(a, hn::Set(d, c.q))), hn::Set(d, -1 / c.theta));
}

/// a = p / (p + r (1-p)), delta = r (1-p) / (p + r (1-p)).
template <class D>
HWY_INLINE Vec<D> conditional_inverse_pair(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Vec<D> u = c.negative ? rows.upper(0) : rows[0], p = rows[1];
  const auto inside = hn::And(is_inside(c, rows, 0), is_inside(c, rows, 1));
  const Vec<D> rest = hn::Mul(exp(d, hn::Mul(hn::Set(d, -c.theta), u)), rows.upper(1));
  const Vec<D> inverse_sum = hn::Div(hn::Set(d, 1.0), hn::Add(p, rest));
  const Vec<D> value = value_at(d, c, tail, hn::Mul(p, inverse_sum), hn::Mul(rest, inverse_sum));
  return probability_within(d, value, hn::Set(d, Precision<D>::kUnit * (2 * c.theta + 20)), kInverseTolerance, inside);
}

template <class D>
HWY_INLINE Vec<D> conditional_inverse_rows(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Index last = rows.size() - 1;
  const Weights<D> given(d, c, rows, last);
  const Vec<D> of_odds = given.of_odds();
  const Coefficients& r = c.polynomials[static_cast<std::size_t>(last)];
  const FactorTrial<D> trial(d, r, given.parts, of_odds, rows.log_of(last));
  const Root<D> root = find_root(d, hn::Zero(d), trial);
  const NextWeight<D> next(d, given.parts, of_odds, root);
  const Vec<D> value = value_at(d, c, tail, next.value, next.complement);
  // Both theta v and theta (1-v) change by q da / (1 - q a).
  const Vec<D> rest = hn::Mul(hn::MulAdd(hn::Set(d, c.q), next.complement, hn::Set(d, c.tail)), hn::Set(d, c.theta));
  const Vec<D> carried = hn::Div(hn::Mul(next.error, hn::Set(d, c.q)), hn::Mul(rest, value));
  const Vec<D> error = hn::Mul(hn::Add(carried, hn::Set(d, 20.0)), hn::Set(d, Precision<D>::kUnit));
  const auto inside = hn::And(hn::And(given.inside, root.found), rows.inside(last));
  return probability_within(d, value, error, kInverseTolerance, inside);
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
    return columns == 2 || (!c.negative && c.polynomials[static_cast<std::size_t>(columns)].usable());
  }
  static bool answers_conditional(const KernelConstants& c, Index columns) {
    return columns == 2 || (!c.negative && c.polynomials[static_cast<std::size_t>(columns) - 1].usable());
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

}  // namespace sklar::families::frank::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::families::frank {

HWY_EXPORT(table);

std::shared_ptr<const Kernels> kernels(double theta, std::vector<Coefficients> polynomials) {
  constexpr double kSmallest = 1e-150, kLargest = 500;  // e^theta and 1/theta are far within double
  if (!(std::abs(theta) > kSmallest && std::abs(theta) < kLargest)) return nullptr;
  return make_kernels(KernelConstants(theta, std::move(polynomials)), *HWY_DYNAMIC_DISPATCH(table)());
}

}  // namespace sklar::families::frank
#endif
