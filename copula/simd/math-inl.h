/// Vector exp, expm1, log and log1p for one instruction set; included once for each (see Highway's foreach_target.h).
/// D is a Highway tag of float or double lanes. Polynomials: minimax in the relative error of expm1(r) and log(1+f).
///
/// Relative errors in double, counted in units of 2^-52, two roundings: exp 1, log 1.4, log1p 1.9; expm1 1.5 of x < 0
/// and 2.2 of x > 0. In float, which is for results within 1e-5, 1.5 units of 2^-23 of the logarithms and 5 of the
/// exponentials, whose polynomial is as short as serves. Outside these ranges the result is NaN:
///   exponential  x <= 709 (88); below -708 (-87) as at that end: e^x up to 3.4e-308 (1.7e-38) instead of less
///   log          normal positive x
///   log1p        1 + x normal and positive

#if defined(SKLAR_COPULA_SIMD_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKLAR_COPULA_SIMD_MATH_INL_H_
#undef SKLAR_COPULA_SIMD_MATH_INL_H_
#else
#define SKLAR_COPULA_SIMD_MATH_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <limits>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace sklar::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
using Vec = hn::Vec<D>;

/// Layout and constants of a lane's type. kLn2 has so few bits that its product with an exponent is exact.
template <class Real>
struct Format;

template <>
struct Format<double> {
  using Unsigned = std::uint64_t;
  static constexpr int kMantissa = 52;
  static constexpr Unsigned kBias = 1023, kRootHalf = 0x3fe6a09e667f3bcd;  // bits of sqrt(1/2)
  static constexpr double kRound = 0x1.8p52;                               // x + kRound rounds x to an integer
  static constexpr double kLog2E = 0x1.71547652b82fep0, kLn2 = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;
  static constexpr double kLowestExponent = -708, kHighestExponent = 709;
  static constexpr double kExp[] = {5.0000000000000055724e-1, 1.6666666666666686064e-1, 4.1666666666573324296e-2,
                                    8.3333333333145398603e-3, 1.3888888932484053470e-3, 1.9841269903160468276e-4,
                                    2.4801504312393533563e-5, 2.7557227824358484632e-6, 2.7626382112479736673e-7,
                                    2.5114517821582850133e-8};
  static constexpr double kLog[] = {6.6666666666667346536e-1, 3.9999999999412887315e-1, 2.8571428742824752060e-1,
                                    2.2222198524619711588e-1, 1.8183567031648464804e-1, 1.5313976918259125449e-1,
                                    1.4796728688616846561e-1};
};

template <>
struct Format<float> {
  using Unsigned = std::uint32_t;
  static constexpr int kMantissa = 23;
  static constexpr Unsigned kBias = 127, kRootHalf = 0x3f3504f3;
  static constexpr float kRound = 0x1.8p23F;
  static constexpr float kLog2E = 0x1.715476p0F, kLn2 = 0x1.63p-1F, kLn2Low = -0x1.bd0106p-13F;
  static constexpr float kLowestExponent = -87, kHighestExponent = 88;
  static constexpr float kExp[] = {4.9999401386018538e-1F, 1.6666831103670462e-1F, 4.1872772962970053e-2F,
                                   8.3380928707366686e-3F};
  static constexpr float kLog[] = {6.6666776549221590e-1F, 3.9977518586604987e-1F, 2.9872400433339761e-1F};
};

/// sum c_k x^k by Estrin's scheme: shorter chains than Horner's.
template <int kFirst, int kCount, class D, class Real, std::size_t kSize>
HWY_INLINE Vec<D> estrin(D d, const Real (&c)[kSize], Vec<D> x, Vec<D> x2, Vec<D> x4, Vec<D> x8) {
  if constexpr (kCount == 1) {
    return hn::Set(d, c[kFirst]);
  } else if constexpr (kCount == 2) {
    return hn::MulAdd(hn::Set(d, c[kFirst + 1]), x, hn::Set(d, c[kFirst]));
  } else {
    constexpr int kHalf = kCount > 8 ? 8 : kCount > 4 ? 4 : 2;
    const Vec<D> low = estrin<kFirst, kHalf>(d, c, x, x2, x4, x8);
    const Vec<D> high = estrin<kFirst + kHalf, kCount - kHalf>(d, c, x, x2, x4, x8);
    return hn::MulAdd(high, kHalf == 8 ? x8 : kHalf == 4 ? x4 : x2, low);
  }
}

template <class D, class Real, std::size_t kSize>
HWY_INLINE Vec<D> polynomial(D d, const Real (&c)[kSize], Vec<D> x) {
  const Vec<D> x2 = hn::Mul(x, x), x4 = hn::Mul(x2, x2);
  return estrin<0, static_cast<int>(kSize)>(d, c, x, x2, x4, hn::Mul(x4, x4));
}

template <class D>
struct Exponential {
  Vec<D> exp, expm1;
};

/// e^x and e^x - 1, each accurate in the relative sense.
template <class D>
HWY_INLINE Exponential<D> exponential(D d, Vec<D> x) {
  using Real = hn::TFromD<D>;
  using F = Format<Real>;
  const hn::RebindToUnsigned<D> bits;
  const auto in_range = hn::Le(x, hn::Set(d, F::kHighestExponent));
  x = hn::IfThenElse(in_range, hn::Max(x, hn::Set(d, F::kLowestExponent)), hn::NaN(d));
  const Vec<D> round = hn::Set(d, F::kRound);
  const Vec<D> shifted = hn::MulAdd(x, hn::Set(d, F::kLog2E), round);
  const Vec<D> n = hn::Sub(shifted, round);
  const Vec<D> r = hn::NegMulAdd(n, hn::Set(d, F::kLn2Low), hn::NegMulAdd(n, hn::Set(d, F::kLn2), x));
  const Vec<D> p = hn::MulAdd(hn::Mul(r, r), polynomial(d, F::kExp, r), r);
  const auto exponent = hn::Add(hn::BitCast(bits, shifted), hn::Set(bits, F::kBias));
  const Vec<D> scale = hn::BitCast(d, hn::ShiftLeft<F::kMantissa>(exponent));
  return {hn::MulAdd(scale, p, scale), hn::MulAdd(scale, p, hn::Sub(scale, hn::Set(d, Real(1))))};
}

template <class D>
HWY_INLINE Vec<D> exp(D d, Vec<D> x) {
  return exponential(d, x).exp;
}

template <class D>
HWY_INLINE Vec<D> expm1(D d, Vec<D> x) {
  return exponential(d, x).expm1;
}

/// A number as mantissa 2^exponent, mantissa in [sqrt(1/2), sqrt(2)).
template <class D>
struct Split {
  Vec<D> mantissa, exponent;
  Vec<hn::RebindToUnsigned<D>> biased_exponent;
};

template <class D>
HWY_INLINE Split<D> split(D d, Vec<D> x) {
  using F = Format<hn::TFromD<D>>;
  const hn::RebindToUnsigned<D> bits;
  const auto one = hn::Set(bits, F::kBias << F::kMantissa);
  const auto i = hn::BitCast(bits, x);
  const auto biased =
      hn::ShiftRight<F::kMantissa>(hn::Sub(hn::Add(i, one), hn::Set(bits, typename F::Unsigned(F::kRootHalf))));
  const auto mantissa = hn::Add(hn::Sub(i, hn::ShiftLeft<F::kMantissa>(biased)), one);
  // An integer below 2^kMantissa in the last bits of 2^kMantissa is that number more.
  const auto top = hn::Set(d, hn::TFromD<D>(typename F::Unsigned(1) << F::kMantissa));
  const auto number = hn::BitCast(d, hn::Or(biased, hn::BitCast(bits, top)));
  const auto offset = hn::Set(d, hn::TFromD<D>((typename F::Unsigned(1) << F::kMantissa) + F::kBias));
  return {hn::BitCast(d, mantissa), hn::Sub(number, offset), biased};
}

/// log(1 + f) + e log 2 for 1 + f in [sqrt(1/2), sqrt(2)). With s = f/(2+f), log(1+f) = 2 s + s^3 p(s^2); in double as
/// f - (f^2/2 - s (f^2/2 + s^2 p)), where the rounding of s hardly counts.
template <class D>
HWY_INLINE Vec<D> log_of_parts(D d, Vec<D> f, Vec<D> e) {
  using Real = hn::TFromD<D>;
  using F = Format<Real>;
  const Vec<D> s = hn::Div(f, hn::Add(f, hn::Set(d, Real(2))));
  const Vec<D> z = hn::Mul(s, s), p = polynomial(d, F::kLog, z);
  if constexpr (std::is_same_v<Real, float>) {
    const Vec<D> low = hn::MulAdd(e, hn::Set(d, F::kLn2Low), hn::Mul(hn::Mul(s, z), p));
    return hn::MulAdd(e, hn::Set(d, F::kLn2), hn::MulAdd(s, hn::Set(d, Real(2)), low));
  } else {
    const Vec<D> half_square = hn::Mul(hn::Mul(f, hn::Set(d, 0.5)), f);
    const Vec<D> rest = hn::MulAdd(s, hn::MulAdd(z, p, half_square), hn::Mul(e, hn::Set(d, F::kLn2Low)));
    return hn::MulAdd(e, hn::Set(d, F::kLn2), hn::Sub(f, hn::Sub(half_square, rest)));
  }
}

/// value where x is a normal positive number, else NaN.
template <class D>
HWY_INLINE Vec<D> if_normal(D d, Vec<D> x, Vec<D> value) {
  using Limits = std::numeric_limits<hn::TFromD<D>>;
#if HWY_TARGET == HWY_AVX3  // one instruction tells
  constexpr int kAllOthers = 0xff;
  if constexpr (std::is_same_v<D, hn::ScalableTag<double>>) {
    return Vec<D>{_mm512_mask_mov_pd(value.raw, _mm512_fpclass_pd_mask(x.raw, kAllOthers), hn::NaN(d).raw)};
  } else if constexpr (std::is_same_v<D, hn::ScalableTag<float>>) {
    return Vec<D>{_mm512_mask_mov_ps(value.raw, _mm512_fpclass_ps_mask(x.raw, kAllOthers), hn::NaN(d).raw)};
  }
#endif
  const auto normal = hn::And(hn::Ge(x, hn::Set(d, (Limits::min)())), hn::Le(x, hn::Set(d, (Limits::max)())));
  return hn::IfThenElse(normal, value, hn::NaN(d));
}

template <class D>
HWY_INLINE Vec<D> log(D d, Vec<D> x) {
  const Split<D> parts = split(d, x);
  return if_normal(d, x, log_of_parts(d, hn::Sub(parts.mantissa, hn::Set(d, hn::TFromD<D>(1))), parts.exponent));
}

/// log(sum + lost), |lost| at most half a unit in the last place of sum.
template <class D>
HWY_INLINE Vec<D> log_of_sum(D d, Vec<D> sum, Vec<D> lost) {
  using F = Format<hn::TFromD<D>>;
  const hn::RebindToUnsigned<D> bits;
  const Split<D> parts = split(d, sum);
  const auto inverse_scale =
      hn::ShiftLeft<F::kMantissa>(hn::Sub(hn::Set(bits, typename F::Unsigned(2 * F::kBias)), parts.biased_exponent));
  const Vec<D> f =
      hn::MulAdd(lost, hn::BitCast(d, inverse_scale), hn::Sub(parts.mantissa, hn::Set(d, hn::TFromD<D>(1))));
  return if_normal(d, sum, log_of_parts(d, f, parts.exponent));
}

template <class D>
HWY_INLINE Vec<D> log1p(D d, Vec<D> x) {
  const Vec<D> one = hn::Set(d, hn::TFromD<D>(1));
  const Vec<D> sum = hn::Add(one, x);
  const Vec<D> larger = hn::Max(one, x), smaller = hn::Min(one, x);
  return log_of_sum(d, sum, hn::Sub(smaller, hn::Sub(sum, larger)));
}

/// log x from x in (0,1) and 1 - x, whichever is the more exact: the one below 1/2.
template <class D>
HWY_INLINE Vec<D> log_of_complement(D d, Vec<D> x, Vec<D> rest) {
  const Vec<D> one = hn::Set(d, hn::TFromD<D>(1)), difference = hn::Sub(one, rest);
  const auto direct = hn::Lt(rest, hn::Set(d, hn::TFromD<D>(0.5)));
  return log_of_sum(d, hn::IfThenElse(direct, difference, x),
                    hn::IfThenElseZero(direct, hn::Sub(hn::Sub(one, difference), rest)));
}

}  // namespace sklar::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
