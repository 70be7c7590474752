#include "copula/bounded.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "copula/random.hpp"
#include "copula/wide.hpp"
#include "tests/support/chi_square.hpp"
#include "tests/support/digits.hpp"

namespace sklar {
namespace {

using test::Digits;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kDigits = 200;
constexpr double kBoundRounding = 1e-9;  // the bounds themselves are rounded sums

/// A number with its bound, and the same expression in 200 digits.
template <class T>
struct Tracked {
  T bounded;
  Digits exact;
};

template <class T>
class BoundedTest : public testing::Test {};

using NumberTypes = testing::Types<Narrow, Extended, Widest>;
TYPED_TEST_SUITE(BoundedTest, NumberTypes);

double random_leaf(Rng& rng) {
  static const std::array<double, 16> special = {0,    1,    -1,    0.5,   2,    1e-300, 5e-324,    -1e-12,
                                                 1e12, 1e80, -1e80, 1e300, -700, 710,    kInfinity, -kInfinity};
  if (rng() % 3 == 0) return special[rng() % special.size()];
  const double mantissa = std::uniform_real_distribution<double>(-2, 2)(rng);
  return mantissa * std::exp(std::uniform_real_distribution<double>(-20, 8)(rng));
}

template <class Number>
Number step(unsigned which, const Number& a, const Number& b) {
  switch (which) {
    case 0:
      return a + b;
    case 1:
      return a - b;
    case 2:
      return a * b;
    case 3:
      return a / b;
    case 4:
      return exp(a);
    case 5:
      return expm1(a);
    case 6:
      return log(abs(a));
    case 7:
      return log1p(a);
    default:
      return sqrt(abs(a));
  }
}

template <class T>
Tracked<T> random_step(Rng& rng, const Tracked<T>& a, const Tracked<T>& b) {
  const auto which = static_cast<unsigned>(rng() % 9);
  const WorkingPrecision narrow(kFirstDigits);  // where T has one
  const T bounded = step(which, a.bounded, b.bounded);
  const WorkingPrecision wide(kDigits);
  return {bounded, step(which, a.exact, b.exact)};
}

/// Whether the bound claims nothing, or what it claims is true.
template <class T>
testing::AssertionResult holds(const Tracked<T>& x) {
  using std::isfinite, std::isinf, std::isnan;
  if (!isfinite(x.bounded.error)) return testing::AssertionSuccess();
  const Digits value(x.bounded.value), error(x.bounded.error);
  if (isnan(x.exact) || isnan(value)) {
    return testing::AssertionFailure() << "a bound for a number that does not exist: " << value << " +- " << error;
  }
  const bool equal =
      isinf(value) || isinf(x.exact) ? value == x.exact : abs(value - x.exact) <= error * (1 + kBoundRounding);
  if (equal) return testing::AssertionSuccess();
  return testing::AssertionFailure() << value << " +- " << error << ", exactly " << x.exact;
}

TYPED_TEST(BoundedTest, BoundHoldsForRandomExpressions) {
  const WorkingPrecision precision(kDigits);
  Rng rng(test::seed_of_this_test());
  constexpr int kExpressions = std::is_same_v<TypeParam, Widest> ? 2000 : 20000;
  for (int n = 0; n < kExpressions; ++n) {
    std::vector<Tracked<TypeParam>> values;
    for (int i = 0; i < 4; ++i) {
      const double leaf = random_leaf(rng);
      values.push_back({TypeParam(leaf), Digits(leaf)});
    }
    for (int step = 0; step < 8; ++step) {
      const auto& a = values[rng() % values.size()];
      const auto& b = values[rng() % values.size()];
      const Tracked<TypeParam> next = random_step(rng, a, b);
      ASSERT_TRUE(holds(next)) << "expression " << n << " step " << step << " from " << a.bounded.value << " +- "
                               << a.bounded.error << " and " << b.bounded.value << " +- " << b.bounded.error;
      values.push_back(next);
    }
  }
}

TYPED_TEST(BoundedTest, BoundIsNotMuchLargerThanTheError) {
  const TypeParam x(0.3), y(7.0);
  const TypeParam value = log1p(exp(-x) * y) / (x + y) - sqrt(y);
  EXPECT_LT(value.error, 16 * std::numeric_limits<decltype(value.error)>::epsilon());
}

TYPED_TEST(BoundedTest, ExactInfinitiesStayExact) {
  const TypeParam infinity(kInfinity), zero(0), two(2);
  const auto exactly = [](const TypeParam& x, double value) { return x.value == value && x.error == 0; };
  EXPECT_TRUE(exactly(log(zero), -kInfinity));
  EXPECT_TRUE(exactly(exp(-infinity), 0));
  EXPECT_TRUE(exactly(expm1(-infinity), -1));
  EXPECT_TRUE(exactly(infinity + two, kInfinity));
  EXPECT_TRUE(exactly(two * -infinity, -kInfinity));
  EXPECT_TRUE(exactly(zero * two, 0));
  EXPECT_TRUE(exactly(zero / two, 0));
  EXPECT_TRUE(exactly(two / infinity, 0));
}

TYPED_TEST(BoundedTest, WhatHasNoValueIsUnknown) {
  using std::isfinite;
  const TypeParam infinity(kInfinity), zero(0), minus_two(-2);
  for (const TypeParam& x : {infinity - infinity, zero * infinity, zero / zero, minus_two / zero, log(minus_two),
                             log1p(minus_two), sqrt(minus_two), infinity / infinity}) {
    EXPECT_FALSE(isfinite(x.error)) << x.value;
  }
}

}  // namespace
}  // namespace sklar
