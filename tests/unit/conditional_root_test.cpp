/// The roots in closed form behind conditional inverses: both sides of their equations in digits, a little below and
/// above the root.

#include <gtest/gtest.h>

#include <array>

#include "copula/error.hpp"
#include "copula/lambert_w.hpp"
#include "copula/polylogarithm_root.hpp"
#include "tests/support/digits.hpp"

namespace sklar {
namespace {

using test::Digits;

constexpr int kDigits = 700;  // 1 - 1e-300, and room

/// f(x (1 - r)) <= target <= f(x (1 + r)) with the relative error r that x claims, which is at most `most`.
template <class Function>
void expect_root(const Function& f, const Digits& target, const Narrow& x, double most) {
  const double relative = x.error / std::abs(x.value);
  EXPECT_LE(relative, most);
  const Digits below = f(Digits(x.value) * (1 - Digits(relative))), above = f(Digits(x.value) * (1 + Digits(relative)));
  EXPECT_LE(below < above ? below : above, target) << x.value;
  EXPECT_GE(below < above ? above : below, target) << x.value;
}

/// Li_(1-n) at x with y = x/(1-x), by its coefficients 1, 2^n - 2, .. k! S(n,k) .. n!.
Digits polylogarithm(int n, const Digits& y) {
  if (n == 2) return y + y * y;
  if (n == 3) return y + 3 * y * y + 2 * y * y * y;
  return y + 7 * y * y + 12 * y * y * y + 6 * y * y * y * y;
}

void expect_polylogarithm_root(int n, double y, double p, double most) {
  SCOPED_TRACE("n = " + std::to_string(n) + ", y = " + to_text(y) + ", p = " + to_text(p));
  const Narrow w = Narrow(1) / (Narrow(1) + Narrow(y)), x = Narrow(y) * w;
  const auto [z, distance] = polylogarithm_root(n, x, w, Narrow(p));
  const Digits target = Digits(p) * polylogarithm(n, y);
  expect_root([&](const Digits& at) { return polylogarithm(n, y * at); }, target, z, most);
  const auto from_one = [&](const Digits& at) { return at < 1 ? polylogarithm(n, y * (1 - at)) : Digits(0); };
  expect_root(from_one, target, distance, most);
}

constexpr std::array<double, 7> kFractions = {1e-290, 1e-100, 1e-12, 0.1, 0.5, 1 - 1e-3, 1 - 1e-14};

TEST(PolylogarithmRoot, PositiveArguments) {
  const WorkingPrecision precision(kDigits);
  constexpr double kMost = 3e-14;
  for (const int n : {2, 3, 4}) {
    for (const double y : {1e-290, 1e-100, 1e-10, 0.01, 0.3, 1.0, 7.0, 1e4, 1e50, 1e140, 1e290}) {
      for (const double p : kFractions) expect_polylogarithm_root(n, y, p, kMost);
    }
  }
}

// The three real roots of the cubic become one where W (W^2-1) = 2/27^(1/2).
TEST(PolylogarithmRoot, WhereTheFormulasOfTheCubicMeet) {
  const WorkingPrecision precision(kDigits);
  const double y = 1, meeting = 2 / std::sqrt(27.0) / (3 * (3 * 3 - 1));
  for (const double p : {meeting * (1 - 1e-9), std::nextafter(meeting, 0), meeting, std::nextafter(meeting, 1)}) {
    expect_polylogarithm_root(3, y, p, 3e-14);
  }
}

TEST(PolylogarithmRoot, NegativeArgumentsUpToWhereTheDerivativeEnds) {
  const WorkingPrecision precision(kDigits);
  constexpr double kEnds[] = {-0.5, -0.21132486540518711, -0.091751709536136983};  // roots of 1 + 2y, 1 + 6y + 6y^2 ..
  constexpr double kMost = 1e-9;                                                   // a double root is near
  for (const int n : {2, 3, 4}) {
    for (const double share : {1e-290, 1e-10, 0.1, 0.9, 0.999}) {
      for (const double p : kFractions) expect_polylogarithm_root(n, share * kEnds[n - 2], p, kMost);
    }
  }
}

TEST(LambertW, SolvesItsEquation) {
  constexpr double kMost = 2e-15;
  for (const int digits : {70, 200}) {
    const WorkingPrecision precision(digits);
    for (const double a : {1e-300, 1e-16, 1e-3, 1.0, 40.0, 700.0}) {
      for (const double b : {1e-15, 1e-3, 1.0, 30.0, 1e6, 1e280}) {
        for (const double t : {1e-16, 1e-3, 0.7, 5.0, 40.0, 700.0}) {
          const auto left = [&](const Digits& l) { return a * expm1(l) + b * l; };
          const double l = log_lambert(a, b, t);
          expect_root(left, t, {l, kMost * l}, kMost * 1.1);
          const Digits wide = log_lambert(Digits(a), Digits(b), Digits(t));
          EXPECT_LE(abs(left(wide) - t), t * 1e4 * std::numeric_limits<Digits>::epsilon()) << a << " " << b << " " << t;
        }
      }
    }
  }
}

}  // namespace
}  // namespace sklar
