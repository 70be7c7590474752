#pragma once
/// The number types in turn, until one has an answer.

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

}  // namespace sklar
