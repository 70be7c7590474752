/// The products of weights that Frank's, Joe's and Ali-Mikhail-Haq's densities are functions of, for one instruction
/// set; included once for each (see Highway's foreach_target.h).

#if defined(SKLAR_COPULA_SIMD_PRODUCT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKLAR_COPULA_SIMD_PRODUCT_INL_H_
#undef SKLAR_COPULA_SIMD_PRODUCT_INL_H_
#else
#define SKLAR_COPULA_SIMD_PRODUCT_INL_H_
#endif

#include "copula/simd/decrease-inl.h"
#include "copula/simd/polynomial-inl.h"
#include "copula/simd/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sklar::simd::HWY_NAMESPACE::formulas {

/// x, w, and whether they come from the 1 - a_i.
template <class D>
struct Parts {
  Vec<D> x, w;
  Mask<D> near_one;
};

/// x = s prod a_i and w = 1 - x, 0 < s <= 1, from the a_i and the 1 - a_i, neither of which cancels. kPlain: of two.
template <class D, bool kPlain = false>
class Product {
 public:
  explicit Product(D d) : value_(d), complement_(hn::Zero(d)) {}

  HWY_INLINE void multiply(D d, Vec<D> a, Vec<D> complement) { multiply(d, a, hn::Zero(d), complement); }

  /// By a + lost.
  HWY_INLINE void multiply(D d, Vec<D> a, Vec<D> lost, Vec<D> complement) {
    complement_ = hn::MulAdd(hn::Sub(hn::Set(d, 1.0), complement_), complement, complement_);
    value_.multiply(d, a, lost);
  }

  /// @param rest 1 - s.
  /// @param of_x, of_w the relative errors of both, the smaller of which in x/w decides.
  HWY_INLINE Parts<D> parts(D d, double s, double rest, Vec<D> of_x, Vec<D> of_w) const {
    const Vec<D> one = hn::Set(d, 1.0);
    const Vec<D> x = hn::Mul(hn::Set(d, s), value_.value());
    const Vec<D> w = hn::MulAdd(hn::Set(d, s), complement_, hn::Set(d, rest));
    const auto near_one = hn::Lt(hn::Mul(of_w, w), hn::Mul(of_x, x));
    return {hn::IfThenElse(near_one, hn::Sub(one, w), x), hn::IfThenElse(near_one, w, hn::Sub(one, x)), near_one};
  }

 private:
  ExactProduct<D, kPlain> value_;
  Vec<D> complement_;
};

/// A factor a = value + lost of a product with its relative error in units of 2^-52: as it is, of relative error of_a,
/// or where that is below 1/2 from 1 - a of absolute error of_complement.
template <class D>
struct Factor {
  HWY_INLINE Factor(D d, Vec<D> a, double of_a, Vec<D> complement, Vec<D> of_complement) {
    const Vec<D> one = hn::Set(d, 1.0), rounded = hn::Sub(one, complement);
    const auto near_one = hn::Lt(complement, hn::Set(d, 0.5));
    value = hn::IfThenElse(near_one, rounded, a);
    lost = hn::IfThenElseZero(near_one, hn::Sub(hn::Sub(one, rounded), complement));
    const Vec<D> inverse = hn::MulAdd(hn::Set(d, 2.0), complement, one);  // at least 1 / (1 - complement)
    error = hn::IfThenElse(near_one, hn::Mul(of_complement, inverse), hn::Set(d, of_a));
  }

  Vec<D> value, lost, error;
};

/// The relative error of x/w from those of x and of w where they are computed: dy/y = dx/(x w).
template <class D>
HWY_INLINE Vec<D> error_of_odds(const Parts<D>& parts, Vec<D> of_x, Vec<D> of_w) {
  return hn::IfThenElse(parts.near_one, hn::Div(of_w, parts.x), hn::Div(of_x, parts.w));
}

/// The factor by which another coordinate of weight a, 1 - a = delta, multiplies y = x/w: z = a w / (w + x delta).
template <class D>
struct NextFactor {
  HWY_INLINE NextFactor(D d, const Parts<D>& parts, Vec<D> of_odds, Vec<D> a, Vec<D> delta, double of_a,
                        double of_delta) {
    const Vec<D> growth = hn::Mul(parts.x, delta);
    const Vec<D> inverse = hn::Div(hn::Set(d, 1.0), hn::Add(growth, parts.w));
    z = hn::Mul(a, hn::Mul(parts.w, inverse));
    distance = hn::Mul(delta, inverse);
    const Vec<D> of_growth = hn::Add(of_odds, hn::Set(d, of_delta + 2));
    of = {of_odds, hn::MulAdd(hn::Mul(growth, inverse), of_growth, hn::Set(d, of_a + 3)),
          hn::MulAdd(hn::Mul(parts.x, z), of_odds, hn::Set(d, of_delta + 4))};
  }

  Vec<D> z, distance;
  RatioErrors<D> of;
};

/// The a of the coordinate whose factor is e^-s, with 1 - a and the absolute error of both that s and y carry.
template <class D>
struct NextWeight {
  HWY_INLINE NextWeight(D d, const Parts<D>& parts, Vec<D> of_odds, const Root<D>& s) {
    const Exponential<D> e = exponential(d, hn::Neg(s.value));
    const Vec<D> distance = hn::Neg(e.expm1);
    const Vec<D> inverse = hn::Div(hn::Set(d, 1.0), hn::MulAdd(parts.x, e.exp, parts.w));
    const Vec<D> share = hn::Mul(parts.w, inverse);
    value = hn::Mul(e.exp, inverse);
    complement = hn::Mul(distance, share);
    error = hn::Mul(hn::Mul(value, share), hn::MulAdd(hn::Mul(of_odds, parts.x), distance, s.error));
  }

  Vec<D> value, complement, error;
};

/// The step of Newton's method for the s = -log z at which z R(z y) / R(y) = p, y = x/w: its logarithm is a concave
/// function of s.
template <class D>
class FactorTrial {
 public:
  HWY_INLINE FactorTrial(D d, const Coefficients& r, const Parts<D>& parts, Vec<D> of_odds, Vec<D> log_p)
      : r_(r), at_(d, r, parts.x, parts.w), of_odds_(of_odds), log_p_(log_p) {}

  HWY_INLINE Trial<D> operator()(D d, Vec<D> s) const {
    const Exponential<D> e = exponential(d, hn::Neg(s));
    const Vec<D> rounding = hn::Set(d, 1.5);
    const Decrease<D> total =
        decrease_with_factor(d, r_, at_, e.exp, hn::Neg(e.expm1), RatioErrors<D>{of_odds_, rounding, rounding});
    const Estimate<D> level = total.fraction.minus_log(d);
    const Vec<D> inverse = hn::Div(hn::Set(d, 1.0), total.slope);
    return {hn::Neg(hn::Mul(hn::Add(log_p_, level.value), inverse)),
            hn::Mul(hn::NegMulAdd(rounding, log_p_, level.error), inverse), total.inside};
  }

 private:
  const Coefficients& r_;
  ScaledArgument<D> at_;
  Vec<D> of_odds_, log_p_;
};

/// log R(x/w) - b log w, 0 <= b <= 1, and its error in units of 2^-52.
/// @param of_x, of_w the relative errors of x and of w where they are computed, in these units.
template <class D>
HWY_INLINE Estimate<D> log_ratio_term(D d, const Coefficients& r, const Parts<D>& parts, double b, Vec<D> of_x,
                                      Vec<D> of_w) {
  const LogPolynomial<D> polynomial = log_polynomial(d, r, parts.x, parts.w);
  const Vec<D> log_w = hn::Mul(hn::Set(d, b), log(d, parts.w));
  // With 1 - x for w and the reverse the derivative in log x is slope / w + b x / w, that in log w by w/x of it.
  const Vec<D> derivative = hn::MulAdd(hn::Set(d, b), parts.x, polynomial.slope);
  const Vec<D> moved = hn::IfThenElse(parts.near_one, hn::Div(hn::Mul(derivative, of_w), parts.x),
                                      hn::Div(hn::Mul(derivative, of_x), parts.w));
  const Vec<D> rest = hn::Add(moved, hn::Set(d, r.relative_error / Precision<D>::kUnit));
  const Vec<D> size = hn::Abs(log_w), value = hn::Sub(polynomial.log, log_w);
  const Vec<D> of_log_w = hn::MulAdd(hn::Set(d, 0.5), size, error_of_log(d, size));
  // 1 - x or 1 - w is rounded.
  const Vec<D> of_difference = hn::Add(polynomial.slope, hn::Set(d, 1.0));
  const Vec<D> rounding = hn::MulAdd(hn::Set(d, 0.5), hn::Add(hn::Abs(value), of_difference), of_log_w);
  return {value, hn::Add(hn::Add(polynomial.error, rounding), rest)};
}

}  // namespace sklar::simd::HWY_NAMESPACE::formulas
HWY_AFTER_NAMESPACE();

#endif
