// Vector kernels of the Ali-Mikhail-Haq copula. Errors are counted in units of 2^-52.
//
// In dimension 2, with G = 1 - theta (1-u)(1-v) and D(u) = 1 - theta (1-u):
//   c = (D(u) D(v) + theta u v) / G^3,  h = v D(v) / G^2,
//   1 - h = (1-v) (D(v) (1 - theta + 2 theta u) + theta^2 (1-v) u^2) / G^2 for theta > 0,
// each written as a sum of positive terms for either sign of theta.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "families/amh_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include <numbers>

#include "copula/simd/product-inl.h"
#include "copula/simd/rows-inl.h"
#include "families/amh.hpp"

#ifndef SKLAR_FAMILIES_AMH_SIMD_ONCE
#define SKLAR_FAMILIES_AMH_SIMD_ONCE
namespace sklar::families::amh {

/// What depends on theta and the dimension alone.
struct KernelConstants {
  KernelConstants(double parameter, std::vector<Coefficients> coefficients)
      : theta(parameter),
        size(std::abs(parameter)),
        rest(1 - parameter),
        lost_rest((1 - rest) - parameter),
        log_rest(std::log1p(-parameter)),
        balance(std::exp2(-std::round(log_rest / (2 * std::numbers::ln2)))),
        log_balance(static_cast<double>(std::log1p(-static_cast<long double>(parameter)) +
                                        2 * std::log(static_cast<long double>(balance)))),
        polynomials(std::move(coefficients)) {}

  double theta, size;  // theta and |theta|
  double rest;         // 1 - theta
  double lost_rest;    // 1 - theta - rest
  double log_rest;
  double balance;      // b: the power of 2 next to (1-theta)^(-1/2), the geometric mean of 1 / D at both ends
  double log_balance;  // log(b^2 (1-theta))
  std::vector<Coefficients> polynomials;  // R_n at n
};

}  // namespace sklar::families::amh
#endif

HWY_BEFORE_NAMESPACE();
namespace sklar::families::amh::HWY_NAMESPACE {

using namespace sklar::simd;
using namespace sklar::simd::HWY_NAMESPACE::formulas;

/// u, 1 - u and D(u).
template <class D>
struct Coordinate {
  HWY_INLINE Coordinate(D d, const KernelConstants& c, const Columns<D>& rows, Index k)
      : value(rows[k]),
        upper(rows.upper(k)),
        scaling(c.theta > 0 ? hn::MulAdd(hn::Set(d, c.theta), value, hn::Set(d, c.rest))
                            : hn::MulAdd(hn::Set(d, c.size), upper, hn::Set(d, 1.0))) {}

  Vec<D> value, upper, scaling;
};

/// G: 1 - theta + theta (u + v (1-u)) or 1 + |theta| (1-u)(1-v).
template <class D>
HWY_INLINE Vec<D> denominator(D d, const KernelConstants& c, const Coordinate<D>& u, const Coordinate<D>& v) {
  if (c.theta > 0) {
    return hn::MulAdd(hn::Set(d, c.theta), hn::MulAdd(v.value, u.upper, u.value), hn::Set(d, c.rest));
  }
  return hn::MulAdd(hn::Mul(hn::Set(d, c.size), u.upper), v.upper, hn::Set(d, 1.0));
}

template <class D>
HWY_INLINE Vec<D> log_pdf_pair(D d, const KernelConstants& c, const Columns<D>& rows) {
  const Coordinate<D> u(d, c, rows, 0), v(d, c, rows, 1);
  Vec<D> numerator;
  if (c.theta > 0) {
    numerator = hn::MulAdd(u.scaling, v.scaling, hn::Mul(hn::Mul(hn::Set(d, c.theta), u.value), v.value));
  } else {  // 1 - s + s ((1-u) + (1-v) + (1-uv)) + s^2 (1-u)(1-v), s = |theta|
    const Vec<D> size = hn::Set(d, c.size), upper = hn::MulAdd(u.value, v.upper, u.upper);
    const Vec<D> inner = hn::MulAdd(hn::Mul(size, u.upper), v.upper, hn::Add(hn::Add(u.upper, v.upper), upper));
    numerator = hn::MulAdd(size, inner, hn::Set(d, 1 - c.size));
  }
  const Vec<D> g = denominator(d, c, u, v);
  const Vec<D> value = log(d, hn::Div(numerator, hn::Mul(hn::Mul(g, g), g)));
  const Vec<D> error = hn::MulAdd(hn::Set(d, 2.0), hn::Abs(value), hn::Set(d, 20.0));
  return log_within(d, {value, hn::Mul(hn::Set(d, Precision<D>::kUnit), error)},
                    hn::And(rows.inside(0), rows.inside(1)));
}

/// D(u) and a = u / D(u) for theta > 0, each with what is lost by its rounding, and 1 - a.
template <class D>
struct Weight {
  HWY_INLINE Weight(D d, const KernelConstants& c, Vec<D> u, Vec<D> upper) : lost_scaling(hn::Set(d, c.lost_rest)) {
    const Vec<D> theta = hn::Set(d, c.theta), rest = hn::Set(d, c.rest), product = hn::Mul(theta, u);
    lost_scaling = hn::Add(lost_scaling, lost_of_product(d, theta, u, product));
    scaling = sum_rounded(d, rest, product, lost_scaling);
    const Vec<D> inverse = hn::Div(hn::Set(d, 1.0), scaling);
    a = hn::Mul(u, inverse);
    const Vec<D> back = hn::Mul(a, scaling);
    const Vec<D> missing = hn::Sub(hn::Sub(u, back), lost_of_product(d, a, scaling, back));
    lost_a = hn::Mul(hn::NegMulAdd(a, lost_scaling, missing), inverse);
    complement = hn::Mul(hn::Mul(rest, upper), inverse);
  }

  Vec<D> scaling, lost_scaling, a, lost_a, complement;
};

/// x = theta prod a_i and w = 1 - x of some coordinates for theta > 0, with their errors, and prod b D(u_i), b a power
/// of 2 that keeps it near 1.
template <class D>
struct Weights {
  HWY_INLINE Weights(D d, const KernelConstants& c, const Columns<D>& rows, Index count) : inside(rows.inside(0)) {
    Product<D> product(d);
    ExactProduct<D> all_scalings(d);
    const Vec<D> balance = hn::Set(d, c.balance);
    for (Index k = 0; k < count; ++k) {
      inside = hn::And(inside, rows.inside(k));
      const Weight<D> weight(d, c, rows[k], rows.upper(k));
      product.multiply(d, weight.a, weight.lost_a, weight.complement);
      all_scalings.multiply(d, hn::Mul(weight.scaling, balance), hn::Mul(weight.lost_scaling, balance));
    }
    of_x = hn::Set(d, 2.0);
    of_w = hn::Set(d, static_cast<double>(count) / 2 + 5);
    parts = product.parts(d, c.theta, c.rest, of_x, of_w);
    scalings = all_scalings.value();
  }

  HWY_INLINE Vec<D> of_odds() const { return error_of_odds(parts, of_x, of_w); }

  Mask<D> inside;
  Vec<D> scalings;  // prod b D(u_i)
  Parts<D> parts;
  Vec<D> of_x, of_w;
};

/// log c = log(1-theta) + d log(b^2 (1-theta)) - 2 log prod b D(u_i) - log w + log R_(d+1)(x/w).
template <class D>
HWY_INLINE Vec<D> log_pdf_rows(D d, const KernelConstants& c, const Columns<D>& rows) {
  const Weights<D> all(d, c, rows, rows.size());
  const Coefficients& polynomial = c.polynomials[static_cast<std::size_t>(rows.size()) + 1];
  const Estimate<D> term = log_ratio_term(d, polynomial, all.parts, 1.0, all.of_x, all.of_w);
  const Vec<D> log_scalings = log(d, all.scalings);
  const double balances = static_cast<double>(rows.size()) * c.log_balance;
  const Vec<D> front = hn::NegMulAdd(hn::Set(d, 2.0), log_scalings, hn::Set(d, c.log_rest + balances));
  const Vec<D> value = hn::Add(front, term.value);
  const double of_constant = 1.5 * std::abs(balances) - 1.5 * c.log_rest + 3;
  const Vec<D> of_front = hn::MulAdd(hn::Set(d, 4.0), hn::Abs(log_scalings), hn::Set(d, of_constant));
  const Vec<D> error = hn::Add(of_front, term.error);
  return log_within(d, {value, hn::Mul(hn::Set(d, Precision<D>::kUnit), error)}, all.inside);
}

template <class D>
HWY_INLINE Vec<D> log_pdf_row(D d, const KernelConstants& c, const Columns<D>& rows) {
  if (rows.size() == 2) return log_pdf_pair(d, c, rows);
  return log_pdf_rows(d, c, rows);
}

template <class D>
HWY_INLINE Vec<D> conditional_pair(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Coordinate<D> u(d, c, rows, 0), v(d, c, rows, 1);
  const Vec<D> inverse_g = hn::Div(hn::Set(d, 1.0), denominator(d, c, u, v)), square = hn::Mul(inverse_g, inverse_g);
  Vec<D> value;
  if (tail == Tail::lower) {
    value = hn::Mul(hn::Mul(v.value, v.scaling), square);
  } else if (c.theta > 0) {
    const Vec<D> first = hn::Mul(v.scaling, hn::MulAdd(hn::Set(d, 2 * c.theta), u.value, hn::Set(d, c.rest)));
    const Vec<D> second = hn::Mul(hn::Mul(hn::Set(d, c.theta * c.theta), v.upper), hn::Mul(u.value, u.value));
    value = hn::Mul(hn::Mul(v.upper, hn::Add(first, second)), square);
  } else {  // 1 - s + 2 s (1-u) + s (1-v) (1 + s (1-u)^2), s = |theta|
    const Vec<D> size = hn::Set(d, c.size);
    const Vec<D> last = hn::MulAdd(hn::Mul(size, u.upper), u.upper, hn::Set(d, 1.0));
    const Vec<D> inner = hn::MulAdd(v.upper, last, hn::Add(u.upper, u.upper));
    value = hn::Mul(hn::Mul(v.upper, hn::MulAdd(size, inner, hn::Set(d, 1 - c.size))), square);
  }
  return probability_within(d, value, hn::Set(d, 20 * Precision<D>::kUnit), kHTolerance,
                            hn::And(rows.inside(0), rows.inside(1)));
}

/// h = z R_(j+1)(y z) / R_(j+1)(y) for theta > 0, y = x/w of the j given.
template <class D>
HWY_INLINE Vec<D> conditional_rows(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Index last = rows.size() - 1;
  const Weights<D> given(d, c, rows, last);
  const Coordinate<D> v(d, c, rows, last);
  const Vec<D> inverse = hn::Div(hn::Set(d, 1.0), v.scaling);
  const Vec<D> delta = hn::Mul(hn::Mul(hn::Set(d, c.rest), v.upper), inverse);
  const NextFactor<D> next(d, given.parts, given.of_odds(), hn::Mul(v.value, inverse), delta, 4, 4);
  const Coefficients& r = c.polynomials[static_cast<std::size_t>(last) + 1];
  const ScaledArgument<D> at(d, r, given.parts.x, given.parts.w);
  const Decrease<D> total = decrease_with_factor(d, r, at, next.z, next.distance, next.of);
  const auto inside = hn::And(hn::And(given.inside, total.inside), rows.inside(last));
  return total.fraction.probability(d, tail, kHTolerance, inside);
}

template <class D>
HWY_INLINE Vec<D> conditional_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  if constexpr (!Precision<D>::kSingle) {
    if (rows.size() > 2) return conditional_rows(d, c, tail, rows);
  }
  return conditional_pair(d, c, tail, rows);
}

/// The root z of y z (1 + y z) = p y (1 + y), y = x/w, of x = theta u / D(u), w = (1-theta) / D(u), and from it
/// v = (1-theta) z / ((1-theta) (w + x z) + theta w (1-z)).
template <class D>
HWY_INLINE Vec<D> conditional_inverse_pair(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Vec<D> one = hn::Set(d, 1.0), two = hn::Set(d, 2.0), four = hn::Set(d, 4.0), rest = hn::Set(d, c.rest);
  const Coordinate<D> u(d, c, rows, 0);
  const Vec<D> p = rows[1], upper_p = rows.upper(1), inverse = hn::Div(one, u.scaling);
  const Vec<D> x = hn::Mul(hn::Mul(hn::Set(d, c.theta), u.value), inverse), w = hn::Mul(rest, inverse);
  const Vec<D> sum = c.theta > 0
                         ? hn::Add(one, x)
                         : hn::Mul(hn::MulAdd(hn::Set(d, 2 * c.size), u.upper, hn::Set(d, 1 - c.size)), inverse);
  const Vec<D> square = c.theta > 0 ? hn::MulAdd(w, w, hn::Mul(hn::Mul(four, x), p))
                                    : hn::NegMulAdd(hn::Mul(four, x), upper_p, hn::Mul(sum, sum));
  const Vec<D> root = hn::Sqrt(square);
  const Vec<D> z = hn::Div(hn::Mul(two, p), hn::Add(w, root));
  const Vec<D> distance = hn::Div(hn::Mul(two, upper_p), hn::Add(sum, root));
  const Vec<D> divisor = c.theta > 0 ? hn::MulAdd(x, z, w) : hn::NegMulAdd(x, distance, one);
  Vec<D> scaled;  // (w + x z) (1 - theta a(v))
  if (c.theta > 0) {
    scaled = hn::MulAdd(rest, divisor, hn::Mul(hn::Mul(hn::Set(d, c.theta), w), distance));
  } else {
    scaled = hn::MulAdd(hn::Set(d, c.size), z, divisor);
  }
  const Vec<D> value = hn::Div(tail == Tail::lower ? hn::Mul(rest, z) : hn::Mul(distance, w), scaled);
  return probability_within(d, value, hn::Set(d, 40 * Precision<D>::kUnit), kInverseTolerance,
                            hn::And(rows.inside(0), rows.inside(1)));
}

/// v = (1-theta) a / (1 - theta a) and 1 - v = delta / (1 - theta a), 1 - theta a = 1 - theta + theta delta.
template <class D>
HWY_INLINE Vec<D> conditional_inverse_rows(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Index last = rows.size() - 1;
  const Vec<D> rest = hn::Set(d, c.rest);
  const Weights<D> given(d, c, rows, last);
  const Vec<D> of_odds = given.of_odds();
  const Coefficients& r = c.polynomials[static_cast<std::size_t>(last) + 1];
  const FactorTrial<D> trial(d, r, given.parts, of_odds, rows.log_of(last));
  const Root<D> root = find_root(d, hn::Zero(d), trial);
  const NextWeight<D> next(d, given.parts, of_odds, root);
  const Vec<D> divisor = hn::MulAdd(hn::Set(d, c.theta), next.complement, rest);
  const Vec<D> carried = hn::Mul(next.error, rest);
  // dv = (1-theta) da / (1 - theta a)^2
  const Vec<D> numerator = tail == Tail::lower ? hn::Mul(rest, next.value) : next.complement;
  const Vec<D> value = hn::Div(numerator, divisor);
  const Vec<D> of_value = hn::Div(carried, hn::Mul(numerator, divisor));
  const Vec<D> error = hn::Mul(hn::Add(of_value, hn::Set(d, 20.0)), hn::Set(d, Precision<D>::kUnit));
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
  static constexpr int kPartsSingle = 2;

  static bool answers_log_pdf(const KernelConstants& c, Index columns) {
    return columns == 2 || (c.theta > 0 && c.polynomials[static_cast<std::size_t>(columns) + 1].usable());
  }
  static bool answers_conditional(const KernelConstants& c, Index columns) {
    return columns == 2 || (c.theta > 0 && c.polynomials[static_cast<std::size_t>(columns)].usable());
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

}  // namespace sklar::families::amh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::families::amh {

HWY_EXPORT(table);

std::shared_ptr<const Kernels> kernels(double theta, std::vector<Coefficients> polynomials) {
  constexpr double kSmallest = 1e-100, kRange = 1e-290;  // x, and (1-theta)^d <= prod D(u_i), are normal numbers
  const auto dim = static_cast<double>(polynomials.size()) - 2;
  if (!(std::abs(theta) > kSmallest && std::pow(1 - theta, std::max(dim, 4.0)) > kRange)) return nullptr;
  return make_kernels(KernelConstants(theta, std::move(polynomials)), *HWY_DYNAMIC_DISPATCH(table)());
}

}  // namespace sklar::families::amh
#endif
