#pragma once
/// The number types in turn, until one has an answer.

#include <optional>

#include "copula/wide.hpp"

namespace sklar::symbolic {

/// answer<T>(), an std::optional, of the first of double, long double and kFirstDigits digits that has one.
template <class Answer>
[[nodiscard]] auto first_answer(const Answer& answer) {
  if (auto found = answer.template operator()<Narrow>()) return found;
  if (auto found = answer.template operator()<Extended>()) return found;
  const WorkingPrecision precision(kFirstDigits);
  return answer.template operator()<Widest>();
}

/// x as a double if its error is at most tolerance * max(1, |x|).
template <class T>
[[nodiscard]] std::optional<double> if_within(double tolerance, const T& x) {
  using std::isfinite;
  if (!isfinite(x.error) || !(x.error <= tolerance || x.error <= tolerance * abs(x).value)) return std::nullopt;
  return static_cast<double>(x.value);
}

}  // namespace sklar::symbolic
