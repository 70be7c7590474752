#pragma once
/// When a double agrees with digits of the judge.

#include <gtest/gtest.h>

#include <limits>

#include "copula/error.hpp"
#include "tests/conformance/family_test.hpp"
#include "tests/support/psi_reference.hpp"

namespace sklar::test {

inline constexpr double kTolerance = 1e-13;
inline constexpr double kInverseTolerance = 1e-12;
inline constexpr double kSmallestNormal = 2.2250738585072014e-308;
inline constexpr double kSmallestDouble = 4.94e-324;

inline Digits larger(const Digits& a, const Digits& b) {
  return a > b ? a : b;
}

inline testing::AssertionResult verdict(bool passes, double value, const Digits& expected) {
  if (passes) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "got " << to_text(value) << ", expected " << expected;
}

/// log densities and other logarithms.
inline testing::AssertionResult logarithm_agrees(double value, const Digits& expected) {
  const bool equal = Digits(value) == expected;  // both infinite
  const Digits bound = kTolerance * larger(1, abs(expected));
  return verdict(equal || abs(value - expected) <= bound, value, expected);
}

/// h and 1 - h: relative, weaker for tiny ones, and to the last place where a double is subnormal.
inline testing::AssertionResult probability_agrees(double value, const Digits& expected) {
  if (expected < kSmallestNormal) return verdict(abs(value - expected) <= kSmallestDouble, value, expected);
  const Digits log_expected = log(expected);
  const Digits bound = kTolerance * larger(1, abs(log_expected) / 20);
  return verdict(abs(log(Digits(value)) - log_expected) <= bound, value, expected);
}

/// Whether `value` is v (or 1 - v for the upper one) with h(given.., v) = p: its relative error is small, seen by h a
/// little to either side, or it is the best double there is.
/// @param h_at Digits v -> PsiReference::Conditional.
template <class Conditional>
testing::AssertionResult is_inverse(const Conditional& h_at, double p, bool upper, double value) {
  if (value == 1) {  // no double inside is nearer: h is beyond p at half the smallest step
    const Digits half = 0x1p-54, h = h_at(upper ? half : Digits(1 - half)).value;
    return verdict(upper ? h >= p : h <= p, value, Digits(p));
  }
  const Digits v = upper ? Digits(1 - Digits(value)) : Digits(value);
  const Digits step = kInverseTolerance * Digits(value);
  const bool below = v <= step || h_at(Digits(v - step)).value <= p;
  const bool above = v + step >= 1 || h_at(Digits(v + step)).value >= p;
  if (below && above) return testing::AssertionSuccess();
  const auto h = h_at(v);
  const Digits place = larger(Digits(std::numeric_limits<double>::epsilon() * value), kSmallestDouble);
  return verdict(abs(h.value - p) <= 1e-14 * p + 4 * place * h.slope, value, Digits(p));
}

/// h, 1 - h and both inverses of each row, the last entry as v and as p. Rows whose given values are outside the
/// support do not count. @param reference PsiReference, or what answers as it does.
template <class Reference>
void expect_conditionals(const Copula& copula, const Reference& reference, const Points& u) {
  const Column h = copula.h(u), upper = copula.h_upper(u), v = copula.h_inv(u), w = copula.h_inv_upper(u);
  for (Index i = 0; i < u.rows(); ++i) {
    SCOPED_TRACE(row_text(u, i));
    const std::vector<double> row = row_of(u, i);
    const std::span<const double> given(row.data(), row.size() - 1);
    if (given.size() > 1 && isinf(reference.log_density(given))) continue;
    const auto expected = reference.conditional(given, Digits(row.back()));
    EXPECT_TRUE(probability_agrees(h(i), expected.value)) << "h";
    EXPECT_TRUE(probability_agrees(upper(i), expected.complement)) << "h_upper";
    const auto h_at = [&](const Digits& x) { return reference.conditional(given, x); };
    if (v(i) > 0) {
      EXPECT_TRUE(is_inverse(h_at, row.back(), false, v(i))) << "h_inv";
    }
    if (w(i) > 0) {
      EXPECT_TRUE(is_inverse(h_at, row.back(), true, w(i))) << "h_inv_upper";
    }
  }
}

}  // namespace sklar::test
