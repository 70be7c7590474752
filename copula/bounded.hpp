#pragma once
/// A real number with a running bound of its absolute error: every operation adds its own rounding error and carries on
/// those of its operands (Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., sec. 3.3). Formulas are
/// written once as templates over the number type; a caller accepts a result in double when its bound is small enough
/// and repeats the same formula in a wider type where it is not.

#include <cmath>
#include <limits>
#include <type_traits>

namespace sklar {

template <class Real>
struct Bounded {
  Real value;
  Real error;  ///< |value - exact| <= error; inf where nothing is known

  Bounded() : value(0), error(0) {}
  Bounded(double exact) : value(exact), error(0) {}  // NOLINT: converts exactly
  Bounded(int exact) : value(exact), error(0) {}     // NOLINT: converts exactly
  Bounded(const Real& v, const Real& e) : value(v), error(e) {}

  /// Relative error of one arithmetic operation, half an ulp, and a little more for the rounding of the bounds
  /// themselves.
  static Real operation() { return Real(0.501) * std::numeric_limits<Real>::epsilon(); }
  /// Relative error of exp, log, expm1, log1p. MPFR: half an ulp; glibc documents at most 1 ulp in double and 4 in long
  /// double (2.1 eps is reached by log1pl).
  static Real function() {
    return Real(std::is_same_v<Real, long double> ? 4 : 1.001) * std::numeric_limits<Real>::epsilon();
  }
  /// Absolute error of an operation whose result may be subnormal.
  static Real underflow() { return (std::numeric_limits<Real>::min)(); }
  static Real unknown() { return std::numeric_limits<Real>::infinity(); }

  Bounded& operator+=(const Bounded& b) { return *this = *this + b; }
  Bounded& operator-=(const Bounded& b) { return *this = *this - b; }
  Bounded& operator*=(const Bounded& b) { return *this = *this * b; }
  Bounded& operator/=(const Bounded& b) { return *this = *this / b; }

  // always_inline: GCC 12 otherwise leaves calls, a third of the time of a log density. Of wide numbers calls cost
  // nothing, and inlining them multiplies the time of compilation.
  [[gnu::always_inline]] friend inline Bounded operator-(const Bounded& a) { return {Real(-a.value), a.error}; }
  [[gnu::always_inline]] friend inline Bounded operator+(const Bounded& a, const Bounded& b) {
    if constexpr (kInHardware) return add(a, b);
    return add_called(a, b);
  }
  [[gnu::always_inline]] friend inline Bounded operator-(const Bounded& a, const Bounded& b) { return a + (-b); }
  [[gnu::always_inline]] friend inline Bounded operator*(const Bounded& a, const Bounded& b) {
    if constexpr (kInHardware) return multiply(a, b);
    return multiply_called(a, b);
  }
  [[gnu::always_inline]] friend inline Bounded operator/(const Bounded& a, const Bounded& b) {
    if constexpr (kInHardware) return divide(a, b);
    return divide_called(a, b);
  }

  friend bool operator<(const Bounded& a, const Bounded& b) { return a.value < b.value; }
  friend bool operator>(const Bounded& a, const Bounded& b) { return a.value > b.value; }
  friend bool operator<=(const Bounded& a, const Bounded& b) { return a.value <= b.value; }
  friend bool operator>=(const Bounded& a, const Bounded& b) { return a.value >= b.value; }

  friend Bounded abs(const Bounded& a) { return a.value < 0 ? -a : a; }

  friend Bounded exp(const Bounded& a) {
    using std::exp, std::isfinite;
    const Real v = exp(a.value);
    if (!isfinite(v) || !isfinite(a.value)) return {v, isfinite(a.value) ? unknown() : a.error};
    return {v, Real(growth(v, a) + function() * v + (a.value < -700 ? underflow() : Real(0)))};
  }

  friend Bounded expm1(const Bounded& a) {
    using std::abs, std::expm1, std::isfinite;
    const Real v = expm1(a.value);
    if (!isfinite(v) || !isfinite(a.value)) return {v, isfinite(a.value) ? unknown() : a.error};
    return {v, Real(growth(Real(v + 1), a) + function() * abs(v))};
  }

  friend Bounded log(const Bounded& a) {
    using std::log;
    return logarithm(log(a.value), a.value, a.error);
  }

  friend Bounded log1p(const Bounded& a) {
    using std::log1p;
    return logarithm(log1p(a.value), Real(1 + a.value), a.error);
  }

  friend Bounded sqrt(const Bounded& a) {
    using std::sqrt;
    const Real v = sqrt(a.value);
    if (a.error == 0 && a.value >= 0) return {v, Real(operation() * v)};
    if (!(a.value > a.error)) return {v, unknown()};
    return {v, Real(a.error / sqrt(Real(a.value - a.error)) + operation() * v)};
  }

 private:
  static constexpr bool kInHardware = std::is_floating_point_v<Real>;

  [[gnu::always_inline]] static inline Bounded add(const Bounded& a, const Bounded& b) {
    using std::abs, std::isfinite;
    const Real v = a.value + b.value;
    const Real e = a.error + b.error + operation() * abs(v);
    return isfinite(e) ? Bounded(v, e) : infinite_result(v, a, b);
  }

  [[gnu::always_inline]] static inline Bounded multiply(const Bounded& a, const Bounded& b) {
    using std::abs, std::isfinite;
    const Real v = a.value * b.value;
    const Real e = abs(a.value) * b.error + (abs(b.value) + b.error) * a.error + operation() * abs(v) + underflow();
    if (!isfinite(e)) return nonzero(a) && nonzero(b) ? infinite_result(v, a, b) : Bounded(v, unknown());
    return v == 0 && (exactly_zero(a) || exactly_zero(b)) ? Bounded(0) : Bounded(v, e);
  }

  [[gnu::always_inline]] static inline Bounded divide(const Bounded& a, const Bounded& b) {
    using std::abs, std::isfinite;
    const Real v = a.value / b.value;
    const Real divisor = abs(b.value) - b.error;
    if (!(divisor > 0)) return {v, unknown()};
    const Real e = (a.error + abs(v) * b.error) / divisor + operation() * abs(v) + underflow();
    if (!isfinite(e)) return infinite_result(v, a, b);
    return v == 0 && (exactly_zero(a) || exactly_infinite(b)) ? Bounded(0) : Bounded(v, e);
  }

  [[gnu::noinline]] static Bounded add_called(const Bounded& a, const Bounded& b) { return add(a, b); }
  [[gnu::noinline]] static Bounded multiply_called(const Bounded& a, const Bounded& b) { return multiply(a, b); }
  [[gnu::noinline]] static Bounded divide_called(const Bounded& a, const Bounded& b) { return divide(a, b); }

  // What the error of the exponent a adds to its exponential, about v.
  static Real growth(const Real& v, const Bounded& a) {
    using std::exp;
    return a.error < Real(0.125) ? Real(v * a.error * (1 + a.error)) : Real(Real(1.001) * exp(Real(a.value + a.error)));
  }

  // An infinite result is exact where an exact infinity met a known operand; a finite operation that overflows is
  // unknown.
  static Bounded infinite_result(const Real& v, const Bounded& a, const Bounded& b) {
    using std::isfinite, std::isinf;
    const bool known = isfinite(a.error) && isfinite(b.error) && (exactly_infinite(a) || exactly_infinite(b));
    return {v, isinf(v) && known ? Real(0) : unknown()};
  }

  static bool exactly_infinite(const Bounded& x) {
    using std::isinf;
    return isinf(x.value) && x.error == 0;
  }

  static bool exactly_zero(const Bounded& x) { return x.value == 0 && x.error == 0; }

  // In a product with infinity the other operand must not be 0.
  static bool nonzero(const Bounded& x) {
    using std::abs;
    return abs(x.value) > x.error;
  }

  static Bounded logarithm(const Real& v, const Real& argument, const Real& error) {
    using std::abs, std::isfinite, std::isnan;
    if (error == 0) return {v, isfinite(v) ? Real(function() * abs(v)) : isnan(v) ? unknown() : Real(0)};
    if (!(argument > error)) return {v, unknown()};
    return {v, Real(error / (argument - error) + function() * abs(v))};
  }
};

}  // namespace sklar
