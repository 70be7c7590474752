#pragma once
/// The functions of a tape beyond arithmetic, exp, log, expm1, log1p and sqrt, for any real type and for Bounded.

#include <boost/math/policies/policy.hpp>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/special_functions/polygamma.hpp>
#include <cmath>
#include <limits>

#include "copula/big_float.hpp"
#include "copula/bounded.hpp"

namespace sklar::symbolic::real {

/// x^n by repeated squaring, n >= 1.
template <class Real>
Real whole_power(Real x, int n) {
  Real result = x;
  for (--n; n > 0; n /= 2) {
    if (n % 2 != 0) result = Real(result * x);
    if (n > 1) x = Real(x * x);
  }
  return result;
}

/// Lambert W, the w >= -1 with w e^w = x; nan below -1/e. Newton on log w + w = log x for x > 2, else Halley on w e^w -
/// x (Corless et al. 1996, eq. 5.9), until the step no longer matters.
template <class Real>
Real lambertw(const Real& x) {
  using std::abs, std::exp, std::log, std::sqrt, std::isfinite;
  const Real branch = x * exp(Real(1)) + 1;
  if (branch < 0) return std::numeric_limits<Real>::quiet_NaN();
  if (x == 0 || !isfinite(x)) return x;
  const Real root = sqrt(Real(2 * branch));
  Real w = x > 2 ? Real(log(x)) : (x < Real(-0.25) ? Real(-1 + root - root * root / 3) : Real(x / (1 + x)));
  const Real tolerance =
      sqrt(std::numeric_limits<Real>::epsilon()) / 8;  // the error after a step is its square or less
  for (int i = 0; i < 100; ++i) {
    Real step;
    if (x > 2) {
      step = (log(Real(x / w)) - w) * w / (1 + w);
    } else {
      const Real e = exp(w);
      const Real residual = w * e - x;
      if (residual == 0) break;
      step = -residual / (e * (w + 1) - (w + 2) * residual / (2 * w + 2));
    }
    w += step;
    if (!(abs(step) > tolerance * abs(w))) break;
  }
  return w;
}

/// As in `<cmath>`, with a bound of the error where the argument has one.
template <class Real>
Real power(const Real& x, const Real& y) {
  using std::pow;
  return pow(x, y);
}

/// Overflow gives inf and not an exception, as in `<cmath>`.
using Quiet =
    boost::math::policies::policy<boost::math::policies::domain_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::pole_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
                                  boost::math::policies::evaluation_error<boost::math::policies::ignore_error>>;

/// Gamma and its kin are taken for positive arguments only, nan elsewhere. MPFR rounds its own correctly.
template <class Real>
Real gamma(const Real& x) {
  return x > 0 ? boost::math::tgamma(x, Quiet()) : std::numeric_limits<Real>::quiet_NaN();
}
template <class Real>
Real lgamma(const Real& x) {
  return x > 0 ? boost::math::lgamma(x, Quiet()) : std::numeric_limits<Real>::quiet_NaN();
}
template <class Real>
Real digamma(const Real& x) {
  return x > 0 ? boost::math::digamma(x, Quiet()) : std::numeric_limits<Real>::quiet_NaN();
}
template <class Real>
Real polygamma(int order, const Real& x) {
  return x > 0 ? boost::math::polygamma(order, x, Quiet()) : std::numeric_limits<Real>::quiet_NaN();
}
[[nodiscard]] inline BigFloat gamma(const BigFloat& x) {
  return x > 0 ? tgamma(x) : std::numeric_limits<BigFloat>::quiet_NaN();
}
[[nodiscard]] inline BigFloat lgamma(const BigFloat& x) {
  return x > 0 ? sklar::lgamma(x) : std::numeric_limits<BigFloat>::quiet_NaN();
}
[[nodiscard]] inline BigFloat digamma(const BigFloat& x) {
  return x > 0 ? sklar::digamma(x) : std::numeric_limits<BigFloat>::quiet_NaN();
}
[[nodiscard]] BigFloat polygamma(int order, const BigFloat& x);

/// The value itself where a bound goes with it.
template <class Real>
const Real& value_of(const Real& x) {
  return x;
}
template <class Real>
const Real& value_of(const Bounded<Real>& x) {
  return x.value;
}

/// Relative error taken for the special functions above, in units of epsilon: ten times what the documentation of
/// Boost.Math tabulates for them.
constexpr int kSpecialError = 1000;

/// f at an argument with an error, for f monotone or convex or concave on the interval of the argument, all of which
/// must lie above lowest: the deviation is then largest at an end. @param ulps relative error of f itself.
template <class Real, class F>
Bounded<Real> from_ends(const Bounded<Real>& x, const Real& lowest, int ulps, F f) {
  using std::abs, std::isfinite;
  const Real epsilon = std::numeric_limits<Real>::epsilon();
  const Real v = x.value > lowest ? f(x.value) : std::numeric_limits<Real>::quiet_NaN();
  if (!isfinite(v)) return {v, Bounded<Real>::unknown()};
  Real deviation = 0;
  Real largest = abs(v);
  if (x.error > 0) {
    const Real width = x.error + epsilon * abs(x.value);
    if (!(x.value - width > lowest)) return {v, Bounded<Real>::unknown()};
    for (const Real& end : {Real(x.value - width), Real(x.value + width)}) {
      const Real there = f(end);
      if (!(abs(there - v) <= deviation)) deviation = abs(there - v);
      if (abs(there) > largest) largest = abs(there);
    }
  }
  return {v, Real(deviation + 2 * ulps * epsilon * largest + Bounded<Real>::underflow())};
}

/// Slopes are at most 1.
template <class Real>
Bounded<Real> sin(const Bounded<Real>& x) {
  using std::abs, std::sin;
  const Real v = sin(x.value);
  return {v, Real(x.error + 2 * std::numeric_limits<Real>::epsilon() * abs(v))};
}
template <class Real>
Bounded<Real> cos(const Bounded<Real>& x) {
  using std::abs, std::cos;
  const Real v = cos(x.value);
  return {v, Real(x.error + 2 * std::numeric_limits<Real>::epsilon() * abs(v))};
}
template <class Real>
Bounded<Real> atan(const Bounded<Real>& x) {
  using std::abs, std::atan;
  const Real v = atan(x.value);
  return {v, Real(x.error + 2 * std::numeric_limits<Real>::epsilon() * abs(v))};
}

/// tan(x+e) - tan(x) = tan(e) (1 + tan(x)^2) / (1 - tan(x) tan(e))
template <class Real>
Bounded<Real> tan(const Bounded<Real>& x) {
  using std::abs, std::tan;
  const Real v = tan(x.value);
  const Real e = x.error < 1 ? Real(tan(x.error)) : Real(2);
  const Real denominator = 1 - abs(v) * e;
  if (!(e < 2 && denominator > Real(0.5))) return {v, Bounded<Real>::unknown()};
  return {v, Real(e * (1 + v * v) / denominator + 2 * std::numeric_limits<Real>::epsilon() * abs(v))};
}

/// x^y for x > 0 and for an exact 0 or infinity: the logarithm is off by at most |y| |log(1 +- e_x/x)| + e_y |log x|
/// and their product.
template <class Real>
Bounded<Real> power(const Bounded<Real>& x, const Bounded<Real>& y) {
  using std::abs, std::expm1, std::isfinite, std::isinf, std::log, std::pow;
  // glibc's powl takes ten times as long as this, whose bits beyond those of double are enough.
  if (std::is_same_v<Real, long double> && x.value > x.error && isfinite(x.value)) return exp(y * log(x));
  const Real v = pow(x.value, y.value);
  const bool rises = y.value - y.error > 0;
  if (x.value == 0 && x.error == 0 && rises) return {Real(0), Real(0)};
  if (isinf(x.value) && x.value > 0 && x.error == 0 && (rises || y.value + y.error < 0)) return {v, Real(0)};
  if (!isfinite(v) || !(x.value > x.error)) return {v, Bounded<Real>::unknown()};
  Real off = 0;
  if (x.error > 0) off += (abs(y.value) + y.error) * x.error / (x.value - x.error);
  if (y.error > 0) off += y.error * abs(log(x.value)) * (1 + 2 * std::numeric_limits<Real>::epsilon());
  const Real growth = off < Real(0.125) ? Real(off * (1 + off)) : Real(expm1(off));
  return {v, Real(abs(v) * growth + 2 * std::numeric_limits<Real>::epsilon() * abs(v) + Bounded<Real>::underflow())};
}

/// By from_ends.
template <class Real>
Bounded<Real> gamma(const Bounded<Real>& x) {
  return from_ends(x, Real(0), kSpecialError, [](const Real& at) { return real::gamma(at); });
}
template <class Real>
Bounded<Real> lgamma(const Bounded<Real>& x) {
  return from_ends(x, Real(0), kSpecialError, [](const Real& at) { return real::lgamma(at); });
}
template <class Real>
Bounded<Real> digamma(const Bounded<Real>& x) {
  return from_ends(x, Real(0), kSpecialError, [](const Real& at) { return real::digamma(at); });
}
template <class Real>
Bounded<Real> polygamma(int order, const Bounded<Real>& x) {
  return from_ends(x, Real(0), kSpecialError, [order](const Real& at) { return real::polygamma(order, at); });
}

/// The error of the argument near the branch point -1/e is seen by the ends of its interval: W is concave there.
template <class Real>
Bounded<Real> lambertw(const Bounded<Real>& x) {
  using std::exp;
  const Real widest = -exp(Real(-1)) * (1 - 8 * std::numeric_limits<Real>::epsilon());
  const Bounded<Real> rounded{x.value, Real(x.error + 2 * std::numeric_limits<Real>::epsilon() * abs(x).value)};
  return from_ends(x.value == 0 && x.error == 0 ? x : rounded, widest, 8,
                   [](const Real& at) { return real::lambertw(at); });
}

}  // namespace sklar::symbolic::real
