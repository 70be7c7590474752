// The vector functions of every instruction set of this machine against long double.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/unit/vector_math_test.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include "copula/simd/math-inl.h"

#ifndef SKLAR_TESTS_VECTOR_MATH_ONCE
#define SKLAR_TESTS_VECTOR_MATH_ONCE
#include <cmath>
#include <vector>

namespace sklar::test {

enum class Function { exp, expm1, log, log1p };

/// The function of x, lane by lane.
using Evaluate = void (*)(Function, const std::vector<double>& x, std::vector<double>& out);
using EvaluateFloat = void (*)(Function, const std::vector<float>& x, std::vector<float>& out);

struct Functions {
  Evaluate of_double;
  EvaluateFloat of_float;
};

}  // namespace sklar::test
#endif

HWY_BEFORE_NAMESPACE();
namespace sklar::test::HWY_NAMESPACE {

namespace simd = sklar::simd::HWY_NAMESPACE;
namespace hn = hwy::HWY_NAMESPACE;

template <class Real>
void evaluate(Function function, const std::vector<Real>& x, std::vector<Real>& out) {
  const hn::ScalableTag<Real> d;
  for (std::size_t i = 0; i + hn::Lanes(d) <= x.size(); i += hn::Lanes(d)) {
    const auto v = hn::LoadU(d, &x[i]);
    auto y = v;
    switch (function) {
      case Function::exp:
        y = simd::exp(d, v);
        break;
      case Function::expm1:
        y = simd::expm1(d, v);
        break;
      case Function::log:
        y = simd::log(d, v);
        break;
      case Function::log1p:
        y = simd::log1p(d, v);
        break;
    }
    hn::StoreU(y, d, &out[i]);
  }
}

Functions functions() {
  return {evaluate<double>, evaluate<float>};
}

}  // namespace sklar::test::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <gtest/gtest.h>

#include "tests/support/instruction_sets.hpp"

namespace sklar::test {
namespace {

HWY_EXPORT(functions);

constexpr double kBound = 1.5 * 0x1p-52, kFloatLogBound = 1.5 * 0x1p-23, kFloatExpBound = 5 * 0x1p-23;

long double exact(Function function, long double x) {
  switch (function) {
    case Function::exp:
      return std::exp(x);
    case Function::expm1:
      return std::expm1(x);
    case Function::log:
      return std::log(x);
    case Function::log1p:
      return std::log1p(x);
  }
  return 0;
}

/// Arguments of both signs from the smallest that matter to near the end of the function's range.
template <class Real>
std::vector<Real> arguments(Function function) {
  constexpr bool kFloat = std::is_same_v<Real, float>;
  const double end = kFloat ? 86 : 706, tiny = kFloat ? -80 : -690;
  std::vector<Real> x;
  for (int i = 0; i < 40'000; ++i) {
    const double position = (i + 0.5) / 40'000, near_one = std::exp(-30 * position);
    switch (function) {
      case Function::exp:
      case Function::expm1:
        x.push_back(static_cast<Real>(end * (2 * position - 1)));
        x.push_back(static_cast<Real>((i % 2 ? 1 : -1) * std::exp(tiny * position)));
        break;
      case Function::log:
        x.push_back(static_cast<Real>(std::exp(end * (2 * position - 1))));
        x.push_back(static_cast<Real>(1 + (i % 2 ? 1 : -0.5) * near_one));
        break;
      case Function::log1p:
        x.push_back(static_cast<Real>(std::exp(end * (2 * position - 1))));
        x.push_back(static_cast<Real>(-std::exp(tiny * position)));
        break;
    }
  }
  if (function == Function::log1p) std::erase(x, Real(-1));
  return x;
}

template <class Real, class Evaluate>
void expect_within(double bound, Function function, Evaluate evaluate) {
  const std::vector<Real> x = arguments<Real>(function);
  std::vector<Real> y(x.size());
  evaluate(function, x, y);
  for (std::size_t i = 0; i < x.size() / 16 * 16; ++i) {
    const long double expected = exact(function, x[i]);
    if (std::abs(expected) < std::numeric_limits<Real>::min()) continue;
    const auto error = static_cast<double>(std::abs((static_cast<long double>(y[i]) - expected) / expected));
    ASSERT_LE(error, bound) << "function " << static_cast<int>(function) << " at " << x[i] << ": " << y[i];
  }
}

TEST(VectorMath, IsWithinItsBound) {
  for_each_target([] {
    const Functions functions = HWY_DYNAMIC_DISPATCH(functions)();
    for (const Function function : {Function::exp, Function::expm1, Function::log, Function::log1p}) {
      expect_within<double>(kBound, function, functions.of_double);
      const bool logarithm = function == Function::log || function == Function::log1p;
      expect_within<float>(logarithm ? kFloatLogBound : kFloatExpBound, function, functions.of_float);
    }
  });
}

TEST(VectorMath, AnswersNaNOutsideItsRange) {
  for_each_target([] {
    const Functions functions = HWY_DYNAMIC_DISPATCH(functions)();
    const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    const auto expect_nan = [&](Function function, std::initializer_list<double> arguments) {
      for (const double argument : arguments) {
        const std::vector<double> x(16, argument);
        std::vector<double> y(16);
        functions.of_double(function, x, y);
        EXPECT_TRUE(std::isnan(y[0])) << static_cast<int>(function) << " at " << argument << ": " << y[0];
      }
    };
    expect_nan(Function::exp, {nan, inf, 709.1, 1e300});
    expect_nan(Function::expm1, {nan, inf, 709.1, 1e300});
    expect_nan(Function::log, {nan, inf, -inf, 0.0, -1.0, 1e-310});
    expect_nan(Function::log1p, {nan, inf, -inf, -1.0, -2.0});
  });
}

}  // namespace
}  // namespace sklar::test
#endif
