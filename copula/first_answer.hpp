#pragma once
/// The number types in turn, or ever more digits, until one has an answer.

#include <limits>
#include <optional>

#include "copula/wide.hpp"

namespace sklar {

/// answer<T>(), an std::optional, of the first that has one of double, long double and 70, 140, ... most_digits digits;
/// else empty.
template <class Answer>
[[nodiscard]] auto first_answer(const Answer& answer, int most_digits = kLastDigits) {
  if (auto found = answer.template operator()<Narrow>()) return found;
  if (auto found = answer.template operator()<Extended>()) return found;
  for (int digits = kFirstDigits; digits <= most_digits; digits *= 2) {
    const WorkingPrecision precision(digits);
    if (auto found = answer.template operator()<Widest>()) return found;
  }
  return decltype(answer.template operator()<Narrow>())();
}

/// Whether the error of x is at most tolerance * max(1, |x|).
template <class Real>
[[nodiscard]] bool is_within(double tolerance, const Bounded<Real>& x) {
  using std::abs, std::isfinite;
  const Real size = abs(x.value);
  return isfinite(x.error) && x.error <= tolerance * (size > 1 ? size : Real(1));
}

/// x as a double where is_within holds.
template <class Real>
[[nodiscard]] std::optional<double> if_within(double tolerance, const Bounded<Real>& x) {
  if (!is_within(tolerance, x)) return std::nullopt;
  return static_cast<double>(x.value);
}

/// More digits than asked for, at first.
inline constexpr int kGuardDigits = 20;

/// answer(digits) in ever more digits, at most kLastDigits more than asked for, until so many of it are right; else
/// NaN.
template <class Answer>
[[nodiscard]] BigFloat resolve_digits(int digits, const Answer& answer) {
  for (int working = digits + kGuardDigits; working <= digits + kLastDigits; working *= 2) {
    const WorkingPrecision precision(working);
    const Widest x = answer(working);
    if (isfinite(x.error) && x.error <= pow(BigFloat(10), -digits) * abs(x.value)) return x.value;
  }
  return std::numeric_limits<BigFloat>::quiet_NaN();
}

}  // namespace sklar
