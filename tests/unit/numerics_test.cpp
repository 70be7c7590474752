#include "copula/numerics.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <vector>

#include "copula/scaled_polynomials.hpp"
#include "families/registry.hpp"
#include "tests/support/digits.hpp"

namespace sklar {
namespace {

using test::Digits;

constexpr double kRelative = 4e-15;  // a handful of roundings, none amplified
constexpr int kDigits = 700;         // 1 - e^-x for x = 1e-300, and room

/// Eulerian numbers A(n,k) / n!, the coefficients of A_n(x) / n! (DLMF 26.14.8): positive, sum 1.
struct EulerianRule {
  template <class T>
  [[nodiscard]] T entry(int n, int k, const T& same, const T& left) const {
    return (T(k + 1) * same + T(n - k) * left) / T(n);
  }
};

/// Agreement in Narrow relative to `scale`, and that the bound it carries is small and true.
void expect_within(const Digits& scale, const Narrow& value, const Digits& expected, const char* what, double x) {
  const Digits error = abs(value.value - expected);
  EXPECT_LE(error, kRelative * scale) << what << "(" << x << ") = " << value.value;
  EXPECT_LE(error, value.error) << what << "(" << x << ")";
  EXPECT_LE(value.error, 4 * kRelative * scale) << what << "(" << x << ")";
}

void expect_accurate(const Narrow& value, const Digits& expected, const char* what, double x) {
  expect_within(abs(expected), value, expected, what, x);
}

/// For logarithms that pass through 0: absolute below 1.
void expect_accurate_log(const Narrow& value, const Digits& expected, const char* what, double x) {
  const Digits size = abs(expected);
  expect_within(size > 1 ? size : Digits(1), value, expected, what, x);
}

TEST(Numerics, LogarithmsOfDifferences) {
  const WorkingPrecision precision(kDigits);
  for (const double x : {1e-300, 1e-20, 1e-5, 0.1, 0.6931, 0.6932, 1.0, 5.0, 29.9, 30.1, 200.0, 700.0}) {
    expect_accurate(log1mexp(Narrow(x)), log(1 - exp(-Digits(x))), "log1mexp", x);
    expect_accurate_log(log_expm1(Narrow(x)), log(exp(Digits(x)) - 1), "log_expm1", x);
  }
  expect_accurate_log(log_expm1(Narrow(1e5)), Digits(1e5), "log_expm1", 1e5);
  for (const double b : {-1e5, -40.0, 0.0, 3.0, 700.0}) {
    expect_accurate_log(log_add_exp(Narrow(2.0), Narrow(b)), log(exp(Digits(2)) + exp(Digits(b))), "log_add_exp", b);
  }
}

TEST(Numerics, LogRatioKeepsItsDigitsWhereTheTwoAreNear) {
  const WorkingPrecision precision(kDigits);
  const double v = 0.3;
  for (const double u : {5e-324, 1e-100, 0.1, 0.2, 0.29, std::nextafter(v, 0), std::nextafter(v, 1), 0.5, 0.7, 1.0}) {
    const Narrow value = log_ratio<Narrow>(u, v, log(Narrow(u)), log(Narrow(v)));
    expect_accurate(value, log(Digits(u) / Digits(v)), "log_ratio", u);
  }
  EXPECT_EQ(log_ratio<Narrow>(v, v, log(Narrow(v)), log(Narrow(v))).value, 0);
}

TEST(Numerics, NotPositiveIsSure) {
  const Narrow doubtful(0.0, 1e-20);
  EXPECT_FALSE(not_positive(doubtful));
  EXPECT_TRUE(not_positive(Narrow(0)));
  EXPECT_FALSE(not_positive(Narrow(5e-324)));
  const WorkingPrecision precision(560);
  EXPECT_FALSE(not_positive(Widest(BigFloat(0), BigFloat(1e-60))));
  EXPECT_TRUE(not_positive(Widest(BigFloat(0), BigFloat(1e-300) * BigFloat(1e-100))));
  EXPECT_FALSE(not_positive(Widest(BigFloat(1e-50), BigFloat(1e-60))));
  EXPECT_FALSE(not_positive(Widest(BigFloat(-1), Widest::unknown())));
}

TEST(Numerics, SolvesIncreasingFunctions) {
  // y e^y = target from starts on either side, and a root of order 2 at 0.
  const auto product = [](const Narrow& y) { return std::pair(y * exp(y), (Narrow(1) + y) * exp(y)); };
  const auto square = [](const Narrow& y) { return std::pair(y * y, Narrow(2) * y); };
  for (const double root : {1e-200, 1e-8, 0.5, 3.0, 300.0}) {
    for (const double start : {root / 1e6, root, root * 50}) {
      const Narrow y = solve_increasing(product, Narrow(root) * exp(Narrow(root)), Narrow(start));
      EXPECT_LE(std::abs(y.value - root), y.error) << root << " from " << start;
      EXPECT_LE(y.error, 1e-13 * root) << root << " from " << start;
    }
    if (root < 1e-100) continue;
    const Narrow y = solve_increasing(square, Narrow(root) * Narrow(root), Narrow(1));
    EXPECT_LE(std::abs(y.value - root), y.error) << root;
    EXPECT_LE(y.error, 1e-14 * root) << root;
  }
}

TEST(Numerics, TriangleGivesEulerianNumbers) {
  // DLMF 26.14, table 26.14.1.
  const std::array<std::vector<double>, 4> known = {{{1, 1}, {1, 4, 1}, {1, 11, 11, 1}, {1, 26, 66, 26, 1}}};
  const Triangle<EulerianRule> table(171, {});
  const WorkingPrecision precision(kFirstDigits);
  double factorial = 1;
  for (int n = 2; n <= 5; ++n) {
    factorial *= n;
    const auto narrow = table.row<Narrow>(n);
    const auto wide = table.row<Widest>(n);
    ASSERT_EQ(narrow.size(), static_cast<std::size_t>(n));
    for (std::size_t k = 0; k < narrow.size(); ++k) {
      const double expected = known[static_cast<std::size_t>(n) - 2][k];
      EXPECT_NEAR(narrow[k].value * factorial, expected, kRelative * expected);
      EXPECT_LE(abs(wide[k].value * factorial - expected), BigFloat(1e-65));
    }
  }
  Narrow sum(0);
  for (const Narrow& coefficient : table.row<Narrow>(170)) sum += coefficient;
  EXPECT_LE(std::abs(sum.value - 1), sum.error);
  EXPECT_LE(sum.error, 1e-12);
}

TEST(Numerics, WideRowsHaveTheDigitsInForce) {
  const Triangle<EulerianRule> table(30, {});
  for (const int digits : {70, 140, 70}) {
    const WorkingPrecision precision(digits);
    Widest sum(0);
    for (const Widest& coefficient : table.row<Widest>(29)) sum += coefficient;
    EXPECT_LE(sum.error, pow(BigFloat(10), 3 - digits));
    EXPECT_GT(sum.error, pow(BigFloat(10), -5 - digits));
    EXPECT_LE(abs(sum.value - 1), sum.error);
  }
}

/// c(n,k) of copula/scaled_polynomials.hpp by its definition: S(n,k+1) from the alternating sum.
Digits stirling_coefficient(int n, int k, const Digits& a) {
  Digits stirling = 0, binomial = 1, factorial = 1;
  for (int i = 0; i <= k + 1; ++i) {
    stirling += ((k + 1 - i) % 2 == 0 ? 1 : -1) * binomial * pow(Digits(i), n);
    binomial = binomial * (k + 1 - i) / (i + 1);
    if (i > 0) factorial *= i;
  }
  Digits rising = 1;
  for (int i = 1; i <= k; ++i) rising *= i - a;
  return stirling / factorial * rising;
}

TEST(StirlingPolynomials, ValueAndRatio) {
  constexpr double kUnderflow = 1e-290;  // the smallest normal number times the largest coefficient
  const WorkingPrecision precision(kDigits);
  for (const double theta : {1.001, 3.0, 1e4, std::numeric_limits<double>::infinity()}) {
    const Digits a = std::isinf(theta) ? Digits(0) : 1 / Digits(theta);
    const StirlingPolynomials polynomials(50, StirlingRule{theta});
    for (const int n : {1, 2, 3, 7, 50}) {
      for (const double y : {0.0, 1e-300, 1e-3, 0.3, 5.0, 1e10, 1e200}) {
        const auto exact = [&](const Digits& at) {
          Digits sum = 0;
          for (int k = n; k-- > 0;) sum = sum * at + stirling_coefficient(n, k, a);
          return sum;
        };
        const Digits here = exact(Digits(y)), there = exact(Digits(y) / 4);
        const Narrow p = y > 1 ? Narrow(1) : Narrow(y), w = y > 1 ? Narrow(1) / Narrow(y) : Narrow(1);
        const Narrow value = polynomials.log_value(n, p, w);
        const auto [decrease, slope] = polynomials.decrease(n, p, w, Narrow(0.25), Narrow(0.75));
        EXPECT_LE(abs(value.value - log(here)), value.error + kUnderflow) << n << " at " << y;
        EXPECT_LE(value.error, 1e-14 * (1 + n * std::abs(std::log(y + 1e-300)))) << n << " at " << y;
        EXPECT_LE(abs(decrease.value - log(here / there)), decrease.error) << n << " at " << y;
        EXPECT_LE(decrease.error, 1e-13 * decrease.value + kUnderflow) << n << " at " << y;
        EXPECT_LE(slope.value, n - 1.0 + slope.error);
      }
    }
  }
}

TEST(Numerics, CumulativeSums) {
  const auto logs = cumulative<Narrow>(6, [](const auto& k) { return log(k); });
  EXPECT_NEAR(logs[5].value, std::log(24.0), kRelative);  // log 4!
  EXPECT_EQ(logs[0].value, 0);
}

TEST(Numerics, DebyeDefectAgainstQuadrature) {
  boost::math::quadrature::tanh_sinh<double> quadrature;
  const auto integrand = [](double t) { return t == 0 ? 1.0 : t / std::expm1(t); };
  for (const double x : {0.3, 1.0, 1.999, 2.001, 5.0, 20.0, 49.0, 51.0, 300.0}) {
    const double debye = quadrature.integrate(integrand, 0.0, x) / x;
    const double expected = 0.25 - (1 - debye) / x;
    EXPECT_NEAR(debye_1_defect(x), expected, 1e-14 / std::min(x, 1.0)) << x;  // the quadrature's own cancellation
    EXPECT_EQ(debye_1_defect(-x), -debye_1_defect(x));
  }
  EXPECT_NEAR(debye_1_defect(1e-8), 1e-8 / 36, kRelative * 1e-8 / 36);  // A&S 27.1.1, first term
  EXPECT_EQ(debye_1_defect(0), 0);
  EXPECT_EQ(debye_1_defect(std::numeric_limits<double>::infinity()), 0.25);
}

TEST(Numerics, TotalCarriesItsRoundingErrors) {
  Total<Narrow> total;
  for (const double term : {1.0, 1e16, 1.0, -1e16, 1e-9}) total += Narrow(term);
  EXPECT_DOUBLE_EQ(total.value().value, 2 + 1e-9);
  EXPECT_LE(total.value().error, kRelative);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  total += Narrow(-kInfinity);
  EXPECT_EQ(total.value().value, -kInfinity);
  EXPECT_EQ(total.value().error, 0);
  total += Narrow(1.0, kInfinity);
  EXPECT_FALSE(std::isfinite(total.value().error));
}

TEST(Numerics, NarrowedKeepsABound) {
  EXPECT_EQ(narrowed(Extended(0.5)).error, 0);
  const Narrow third = narrowed(Extended(1) / Extended(3));
  EXPECT_EQ(third.value, 1.0 / 3);
  EXPECT_LE(std::abs(third.value - 1.0L / 3), third.error);
  EXPECT_LE(third.error, 1e-16);
  EXPECT_GT(narrowed(Extended(1e-300L, 1e-4000L)).error, 0);
  EXPECT_FALSE(std::isfinite(narrowed(Extended(1e4000L, 0)).error));
}

TEST(Numerics, InverseOfAnIncreasingFunction) {
  const auto square = [](double x) { return x * x; };
  EXPECT_DOUBLE_EQ(invert_increasing(square, 2, 0, 10), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(invert_increasing(square, 1e-300, 0, 1e-100), 1e-150);
  EXPECT_EQ(invert_increasing(square, 2, 3, 4), 3);
  EXPECT_EQ(invert_increasing(square, 20, 3, 4), 4);
  EXPECT_EQ(invert_increasing(square, 16, 3, 4), 4);
}

TEST(Numerics, RootsOfEulerianPolynomialsNearestZero) {
  EXPECT_EQ(eulerian_root(2), -1);                                                         // 1 + x
  EXPECT_DOUBLE_EQ(static_cast<double>(eulerian_root(3)), -1 / (2 + std::sqrt(3.0)));      // 1 + 4x + x^2
  EXPECT_DOUBLE_EQ(static_cast<double>(eulerian_root(4)), -1 / (5 + 2 * std::sqrt(6.0)));  // (1 + x)(1 + 10x + x^2)
  for (const int n : {5, 10, 30}) {
    const auto x = static_cast<double>(eulerian_root(n));
    double value = 0, slope = 0;
    const Triangle<EulerianRule> table(n + 1, {});
    const auto row = table.row<Narrow>(n);
    for (std::size_t k = row.size(); k-- > 0;) {
      slope = slope * x + value;
      value = value * x + row[k].value;
    }
    EXPECT_LE(std::abs(value / slope), 1e-14 * std::abs(x)) << n;
    EXPECT_GT(x, static_cast<double>(eulerian_root(n - 1))) << n;
  }
  for (const int n : {1000, 16000}) EXPECT_EQ(eulerian_root(n), -std::ldexp(1.0L, -n)) << "1 + (3/4)^n times that";
}

TEST(FamilyDomains, FrankByDimension) {
  // log(1 - r), r the root of A_(d-1) nearest 0, from 50-digit arithmetic.
  const auto lowest = [](int dim) { return families::find("frank").parameters[0].domain(dim).lowest; };
  EXPECT_EQ(lowest(2), -std::numeric_limits<double>::infinity());
  EXPECT_NEAR(lowest(3), -0.6931471806, 5e-11);
  EXPECT_NEAR(lowest(4), -0.2374007862, 5e-11);
  EXPECT_NEAR(lowest(5), -0.09623749011, 5e-12);
  EXPECT_NEAR(lowest(6), -0.04219349026, 5e-12);
  EXPECT_NEAR(lowest(10), -0.002119060109, 5e-13);
}

TEST(FamilyDomains, AliMikhailHaqByDimension) {
  const auto lowest = [](int dim) { return families::find("amh").parameters[0].domain(dim).lowest; };
  EXPECT_EQ(lowest(2), -1);
  EXPECT_NEAR(lowest(3), -0.26794919243, 1e-11);  // sqrt 3 - 2
  EXPECT_NEAR(lowest(4), -0.10102051443, 1e-11);  // 2 sqrt 6 - 5
  EXPECT_NEAR(lowest(5), -0.043096288, 1e-9);
}

TEST(FamilyDomains, ClaytonByDimension) {
  for (const int dim : {2, 3, 4, 11, 50}) {
    const double lowest = families::find("clayton").parameters[0].domain(dim).lowest;
    EXPECT_NEAR(lowest, -1.0 / (dim - 1), 1e-15);
    EXPECT_GE(std::fma(lowest, dim - 1, 1.0), 0) << "outside by rounding, dimension " << dim;
  }
}

}  // namespace
}  // namespace sklar
