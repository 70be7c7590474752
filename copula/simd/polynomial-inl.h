/// Logarithms of polynomials with positive coefficients for one instruction set; included once for each (see Highway's
/// foreach_target.h).

#if defined(SKLAR_COPULA_SIMD_POLYNOMIAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKLAR_COPULA_SIMD_POLYNOMIAL_INL_H_
#undef SKLAR_COPULA_SIMD_POLYNOMIAL_INL_H_
#else
#define SKLAR_COPULA_SIMD_POLYNOMIAL_INL_H_
#endif

#include "copula/coefficients.hpp"
#include "copula/simd/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sklar::simd::HWY_NAMESPACE::formulas {

/// Of a polynomial R with positive coefficients at y: log R and d log R / d log y, between 0 and the degree.
template <class D>
struct LogPolynomial {
  Vec<D> log, slope;
};

/// R of degree 1.
template <class D>
HWY_INLINE LogPolynomial<D> log_linear(D d, const Coefficients& r, Vec<D> p, Vec<D> w) {
  const Vec<D> y = hn::Div(hn::Mul(hn::Set(d, r.c[1] * r.scale), p), w);
  return {log1p(d, y), hn::Div(y, hn::Add(y, hn::Set(d, 1.0)))};
}

/// R at y = p/w, p >= 0, w > 0. The error of log R is at most 2^-52 (n + 2 |log R| + 1) + relative_error + slope times
/// the relative error of y, n the number of coefficients. Beyond scale y = 1 the leading power is taken out.
template <class D>
HWY_INLINE LogPolynomial<D> log_polynomial(D d, const Coefficients& r, Vec<D> p, Vec<D> w) {
  const std::size_t n = r.c.size();
  if (n == 2) return log_linear(d, r, p, w);
  const Vec<D> scaled = hn::Mul(p, hn::Set(d, r.scale));
  const auto leads = hn::Gt(scaled, w);
  const Vec<D> x = hn::Div(hn::Min(scaled, w), hn::Max(scaled, w));
  Vec<D> sum = hn::Zero(d), slope = sum;
  if (hn::AllFalse(d, leads)) {
    for (std::size_t k = n; k-- > 0;) {
      slope = hn::MulAdd(slope, x, sum);
      sum = hn::MulAdd(sum, x, hn::Set(d, r.c[k]));
    }
    return {log(d, sum), hn::Div(hn::Mul(x, slope), sum)};
  }
  for (std::size_t k = n; k-- > 0;) {
    const Vec<D> c = hn::IfThenElse(leads, hn::Set(d, r.c[n - 1 - k]), hn::Set(d, r.c[k]));
    slope = hn::MulAdd(slope, x, sum);
    sum = hn::MulAdd(sum, x, c);
  }
  const Vec<D> degree = hn::Set(d, static_cast<double>(n - 1));
  slope = hn::Div(hn::Mul(x, slope), sum);
  return {hn::Sub(log(d, sum), hn::IfThenElseZero(leads, hn::Mul(degree, log(d, x)))),
          hn::IfThenElse(leads, hn::Sub(degree, slope), slope)};
}

}  // namespace sklar::simd::HWY_NAMESPACE::formulas
HWY_AFTER_NAMESPACE();

#endif
