#include "copula/symbolic/real_functions.hpp"

namespace sklar::symbolic::real {

namespace {

/// sum over k of B_2k (2k+m-1)! / ((2k)! x^(2k+m)), B_2k from zeta(2k) (DLMF 25.6.2), until terms no longer count.
BigFloat bernoulli_tail(int m, const BigFloat& x, const BigFloat& leading) {
  const BigFloat circle = 8 * atan(BigFloat(1)) * x;
  BigFloat zeta, sum = 0, scale = leading;  // scale: (2k+m-1)! / ((2 pi x)^(2k) x^m)
  for (long k = 1;; ++k) {
    scale *= BigFloat(2 * k + m - 2) * BigFloat(2 * k + m - 1) / (circle * circle);
    mpfr_zeta_ui(zeta.get(), static_cast<unsigned long>(2 * k), MPFR_RNDN);
    const BigFloat term = 2 * zeta * scale;
    sum += k % 2 != 0 ? term : -term;
    if (term < std::numeric_limits<BigFloat>::epsilon() * leading) return sum;
  }
}

}  // namespace

// The recurrence to an x where the asymptotic series reaches the precision (its least term is about e^(-2 pi x)), then
// DLMF 5.15.9.
BigFloat polygamma(int order, const BigFloat& x) {
  if (order == 0) return real::digamma(x);
  if (!(x > 0)) return std::numeric_limits<BigFloat>::quiet_NaN();
  BigFloat factorial = 1;  // (order - 1)!
  for (int k = 2; k < order; ++k) factorial *= BigFloat(k);
  const BigFloat enough(static_cast<double>(WorkingPrecision::bits()) * 0.15 + order);
  BigFloat sum = 0, at = x;
  for (; at < enough; at += 1) sum += BigFloat(order) * factorial / whole_power(at, order + 1);
  const BigFloat leading = factorial / whole_power(at, order);
  sum += leading + BigFloat(order) * leading / (2 * at) + bernoulli_tail(order, at, leading);
  return order % 2 != 0 ? sum : -sum;
}

}  // namespace sklar::symbolic::real
