/// Ratios of polynomials with positive coefficients at two arguments, and the roots of functions of them, for one
/// instruction set; included once for each (see Highway's foreach_target.h). Errors are counted in units of 2^-52.

#if defined(SKLAR_COPULA_SIMD_DECREASE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKLAR_COPULA_SIMD_DECREASE_INL_H_
#undef SKLAR_COPULA_SIMD_DECREASE_INL_H_
#else
#define SKLAR_COPULA_SIMD_DECREASE_INL_H_
#endif

#include "copula/coefficients.hpp"
#include "copula/simd/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sklar::simd::HWY_NAMESPACE::formulas {

/// y = p/w by the scale of the coefficients, as x / rest, the larger of which is 1.
template <class D>
struct ScaledArgument {
  HWY_INLINE ScaledArgument(D d, const Coefficients& r, Vec<D> p, Vec<D> w) {
    const Vec<D> one = hn::Set(d, 1.0), scaled = hn::Mul(p, hn::Set(d, r.scale));
    const Vec<D> inverse = hn::Div(one, hn::Max(scaled, w));
    leads = hn::Gt(scaled, w);
    some_lead = !hn::AllFalse(d, leads);
    x = hn::IfThenElse(leads, one, hn::Mul(scaled, inverse));
    rest = hn::IfThenElse(leads, hn::Mul(w, inverse), one);
  }

  Vec<D> x, rest;
  Mask<D> leads;
  bool some_lead;
};

/// Sums over the terms t_k of R(y), from the last on: here = sum t_k, there = sum t_k z^k, (here - there) / (x (1-z)),
/// and the derivatives of here in x, of there in z x.
template <class D>
struct RatioSums {
  HWY_INLINE RatioSums(D d, const Coefficients& r, const ScaledArgument<D>& at, Vec<D> z)
      : moved(hn::Mul(z, at.x)), power(hn::Set(d, 1.0)), here(hn::Zero(d)) {
    there = difference = rise = slope = here;
    if (at.some_lead) {
      for (std::size_t k = r.c.size(); k-- > 0; power = hn::Mul(power, at.rest)) {
        add(at.x, hn::Mul(power, hn::Set(d, r.c[k])));
      }
    } else {
      for (std::size_t k = r.c.size(); k-- > 0;) add(at.x, hn::Set(d, r.c[k]));
    }
  }

  HWY_INLINE void add(Vec<D> x, Vec<D> term) {
    difference = hn::MulAdd(difference, moved, here);
    rise = hn::MulAdd(rise, x, here);
    slope = hn::MulAdd(slope, moved, there);
    here = hn::MulAdd(here, x, term);
    there = hn::MulAdd(there, moved, term);
  }

  Vec<D> moved, power, here, there, difference, rise, slope;
};

/// A fraction f in (0,1), as it is and as 1 - f, with its relative error and the absolute one of 1 - f.
template <class D>
struct Fraction {
  Vec<D> value, loss, error, loss_error;

  /// -log f and its absolute error.
  HWY_INLINE Estimate<D> minus_log(D d) const {
    const Vec<D> result = hn::Neg(log_of_complement(d, value, loss));
    const auto near_one = hn::Lt(loss, hn::Set(d, 0.5));
    const Vec<D> carried = hn::IfThenElse(near_one, hn::Add(loss_error, loss_error), error);
    return {result, hn::MulAdd(hn::Set(d, 1.5), result, carried)};
  }

  /// f or 1 - f.
  HWY_INLINE Vec<D> probability(D d, Tail tail, double tolerance, Mask<D> inside) const {
    const Vec<D> one = hn::Set(d, 1.0), half = hn::Set(d, 0.5);
    Vec<D> result, relative_error;
    if (tail == Tail::lower) {
      const auto near_one = hn::Lt(loss, half);
      result = hn::IfThenElse(near_one, hn::Sub(one, loss), value);
      relative_error = hn::IfThenElse(near_one, hn::Add(loss_error, loss_error), error);
    } else {
      const auto near_one = hn::Lt(value, half);
      result = hn::IfThenElse(near_one, hn::Sub(one, value), loss);
      relative_error = hn::Div(hn::IfThenElse(near_one, hn::Mul(value, error), loss_error), result);
    }
    return probability_within(d, result, hn::Mul(hn::Set(d, Precision<D>::kUnit), hn::Add(relative_error, one)),
                              tolerance, inside);
  }
};

/// Relative errors of y, of z, and of 1 - z.
template <class D>
struct RatioErrors {
  Vec<D> y, z, distance;
};

/// R(z y) / R(y), 0 < z < 1; its derivative: of -log of it in -log z, the mean exponent at z y; and where this holds.
template <class D>
struct Decrease {
  Fraction<D> fraction;
  Vec<D> slope;
  Mask<D> inside;
};

/// As ScaledPolynomials::decrease: all sums are of positive terms. A term of degree k takes k + 1 steps, so that a sum
/// is off by as many as its mean exponent has, and 1. @param distance 1 - z.
template <class D>
HWY_INLINE Decrease<D> decrease(D d, const Coefficients& r, const ScaledArgument<D>& at, Vec<D> z, Vec<D> distance,
                                const RatioErrors<D>& of) {
  constexpr double kStep = HWY_NATIVE_FMA ? 0.5 : 1, kSmallest = 1e-250;
  const Vec<D> one = hn::Set(d, 1.0), step = hn::Set(d, kStep);
  // Near 1 the error of z is that of 1 - z.
  const auto near_one = hn::Lt(distance, hn::Set(d, 0.5));
  const RatioSums<D> sums(d, r, at, hn::IfThenElse(near_one, hn::Sub(one, distance), z));
  const Vec<D> inverse = hn::Div(one, sums.here), ratio = hn::Mul(sums.there, inverse);
  const Vec<D> loss = hn::Mul(hn::Mul(hn::Mul(sums.difference, at.x), distance), inverse);
  const Vec<D> mean_there = hn::Div(hn::Mul(sums.slope, sums.moved), sums.there);
  const Vec<D> mean_here = hn::Mul(hn::Mul(sums.rise, at.x), inverse);

  const auto n = static_cast<double>(r.c.size());
  const Vec<D> of_powers = hn::IfThenElseZero(at.leads, hn::Set(d, n));
  const Vec<D> of_terms = hn::Add(of_powers, hn::Set(d, 2 * r.relative_error / Precision<D>::kUnit + 5));
  const Vec<D> distances = hn::Add(distance, distance);
  const Vec<D> of_z = hn::Add(hn::IfThenElse(near_one, hn::Mul(distances, of.distance), of.z), one);
  const Vec<D> of_here = hn::MulAdd(step, mean_here, step);
  // sum t_k k (1 - z^k) / here: what an error of z moves the loss by, and at least the difference of the means.
  const Vec<D> rounding = hn::Set(d, n * n * Precision<D>::kUnit * 4);
  const Vec<D> apart =
      hn::Min(hn::Add(hn::NegMulAdd(mean_there, ratio, mean_here), rounding), hn::Mul(hn::Set(d, n), loss));
  const Vec<D> means_apart = hn::Min(hn::Add(hn::Abs(hn::Sub(mean_here, mean_there)), rounding), apart);
  const Vec<D> of_y = hn::Mul(hn::Add(of.y, one), means_apart);
  const Vec<D> of_sums = hn::Add(of_terms, of_here);
  const Vec<D> error = hn::Add(hn::MulAdd(mean_there, hn::Add(of_z, step), of_y), hn::Add(of_sums, step));
  const Vec<D> of_loss = hn::Add(hn::Add(of_sums, of.distance), step);
  const Vec<D> loss_error = hn::Add(hn::MulAdd(apart, hn::Add(of_z, step), of_y), hn::Mul(loss, of_loss));
  const Vec<D> smallest = hn::Set(d, kSmallest);
  const auto inside = hn::And(hn::Gt(sums.there, smallest), hn::Gt(sums.power, smallest));
  return {{ratio, loss, error, loss_error}, mean_there, inside};
}

/// z R(z y) / R(y) likewise.
template <class D>
HWY_INLINE Decrease<D> decrease_with_factor(D d, const Coefficients& r, const ScaledArgument<D>& at, Vec<D> z,
                                            Vec<D> distance, const RatioErrors<D>& of) {
  const Decrease<D> ratio = decrease(d, r, at, z, distance, of);
  const Fraction<D>& f = ratio.fraction;
  const Vec<D> one = hn::Set(d, 1.0), loss = hn::MulAdd(z, f.loss, distance);
  const Vec<D> error = hn::Add(hn::Add(f.error, of.z), one);
  const Vec<D> of_product = hn::Mul(z, hn::MulAdd(f.loss, of.z, f.loss_error));
  const Vec<D> loss_error = hn::Add(hn::MulAdd(distance, of.distance, of_product), loss);
  return {{hn::Mul(z, f.value), loss, error, loss_error}, hn::Add(ratio.slope, one), ratio.inside};
}

/// A step towards a root from a point, and the absolute error that rounding there leaves of the root.
template <class D>
struct Trial {
  Vec<D> step, error;
  Mask<D> inside;
};

/// A positive root with its absolute error.
template <class D>
struct Root {
  Vec<D> value, error;
  Mask<D> found;
};

/// By steps of order 2: after one below the relative kSettled what is left is far below rounding.
/// @param trial (d, point) -> Trial.
template <class D, class Try>
HWY_INLINE Root<D> find_root(D d, Vec<D> start, const Try& trial) {
  constexpr int kMostSteps = 12;
  constexpr double kNear = 1e-6, kSettled = 1e-10;
  Vec<D> s = start;
  auto moving = hn::Ge(s, hn::Zero(d));  // a lane that has arrived stays, whatever its neighbours do
  for (int i = 0; i < kMostSteps && !hn::AllFalse(d, moving); ++i) {
    const Vec<D> step = trial(d, s).step;
    s = hn::Add(s, hn::IfThenElseZero(moving, step));
    moving = hn::And(moving, hn::Gt(hn::Abs(step), hn::Mul(hn::Set(d, kNear), s)));
  }
  const Trial<D> last = trial(d, s);
  s = hn::Add(s, last.step);
  const auto settled = hn::Le(hn::Abs(last.step), hn::Mul(hn::Set(d, kSettled), s));
  const auto found = hn::And(settled, hn::Gt(s, hn::Set(d, Precision<D>::kSmallestProbability)));
  return {s, hn::Add(last.error, s), hn::And(found, last.inside)};
}

}  // namespace sklar::simd::HWY_NAMESPACE::formulas
HWY_AFTER_NAMESPACE();

#endif
