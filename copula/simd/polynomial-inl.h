/// Logarithms of polynomials with positive coefficients for one instruction set; included once for each (see Highway's
/// foreach_target.h).

#if defined(SKLAR_COPULA_SIMD_POLYNOMIAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SKLAR_COPULA_SIMD_POLYNOMIAL_INL_H_
#undef SKLAR_COPULA_SIMD_POLYNOMIAL_INL_H_
#else
#define SKLAR_COPULA_SIMD_POLYNOMIAL_INL_H_
#endif

#include "copula/coefficients.hpp"
#include "copula/simd/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sklar::simd::HWY_NAMESPACE::formulas {

/// Of a polynomial R with positive coefficients at y: log R, d log R / d log y, between 0 and the degree, and the error
/// of log R in units of 2^-52, beside those of the coefficients and slope times the relative error of y.
template <class D>
struct LogPolynomial {
  Vec<D> log, slope, error;
};

/// R of degree 1.
template <class D>
HWY_INLINE LogPolynomial<D> log_linear(D d, const Coefficients& r, Vec<D> p, Vec<D> w) {
  const Vec<D> y = hn::Div(hn::Mul(hn::Set(d, r.c[1] * r.scale), p), w);
  const Vec<D> log_r = log1p(d, y);
  return {log_r, hn::Div(y, hn::Add(y, hn::Set(d, 1.0))), hn::MulAdd(hn::Set(d, 2.0), log_r, hn::Set(d, 4.0))};
}

/// What the logarithm of a sum by Horner's rule is off by: a term of degree k takes k + 1 steps and k factors x.
template <class D>
HWY_INLINE Vec<D> error_of_log_sum(D d, Vec<D> log_sum, Vec<D> mean_degree) {
  constexpr double kStep = HWY_NATIVE_FMA ? 0.5 : 1;
  const Vec<D> of_steps = hn::MulAdd(hn::Set(d, kStep + 0.5), mean_degree, hn::Set(d, kStep + 2));
  return hn::Add(error_of_log(d, log_sum), of_steps);
}

/// R at y = p/w, p >= 0, w > 0. Beyond scale y = 1 the leading power is taken out.
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
    const Vec<D> log_sum = log(d, sum), mean_degree = hn::Div(hn::Mul(x, slope), sum);
    return {log_sum, mean_degree, error_of_log_sum(d, log_sum, mean_degree)};
  }
  for (std::size_t k = n; k-- > 0;) {
    const Vec<D> c = hn::IfThenElse(leads, hn::Set(d, r.c[n - 1 - k]), hn::Set(d, r.c[k]));
    slope = hn::MulAdd(slope, x, sum);
    sum = hn::MulAdd(sum, x, c);
  }
  const Vec<D> degree = hn::Set(d, static_cast<double>(n - 1));
  slope = hn::Div(hn::Mul(x, slope), sum);
  const Vec<D> log_sum = log(d, sum), log_leading = hn::IfThenElseZero(leads, hn::Mul(degree, log(d, x)));
  const Vec<D> log_r = hn::Sub(log_sum, log_leading), half = hn::Set(d, 0.5);
  // degree log x: that of log x, and the product's.
  const Vec<D> least = hn::Min(hn::Abs(log_leading), hn::Mul(degree, hn::Set(d, kLogPartError)));
  const Vec<D> of_leading = hn::Sub(least, log_leading);
  const Vec<D> error = hn::Add(hn::MulAdd(half, hn::Abs(log_r), of_leading), error_of_log_sum(d, log_sum, slope));
  return {log_r, hn::IfThenElse(leads, hn::Sub(degree, slope), slope), error};
}

}  // namespace sklar::simd::HWY_NAMESPACE::formulas
HWY_AFTER_NAMESPACE();

#endif
