#include "copula/symbolic/log_density_gradient.hpp"

#include <gtest/gtest.h>

#include "tests/conformance/family_test.hpp"
#include "tests/support/psi_reference.hpp"

namespace sklar::symbolic {
namespace {

using test::Digits;

constexpr double kTolerance = 2e-10;

/// theta_j of the derivative, moved by a step of many digits: a central difference of log densities in 200 digits.
class MovedParameter {
 public:
  MovedParameter(const FamilyInfo& family, const Theta& theta, std::size_t j) : family_(family), theta_(theta), j_(j) {}

  [[nodiscard]] Digits difference(std::span<const double> u) const {
    constexpr double kStep = 0x1p-26;  // relative; the error of the difference is its square
    const Interval domain = family_.parameters[j_].domain(static_cast<int>(u.size()));
    const double room = std::min(theta_[j_] - domain.lowest, domain.highest - theta_[j_]);
    const double step = kStep * std::min(room, std::max(std::abs(theta_[j_]), 1e-3));
    Theta low = theta_, high = theta_;
    low[j_] -= step;
    high[j_] += step;
    const Digits rise =
        test::PsiReference(family_, high).log_density(u) - test::PsiReference(family_, low).log_density(u);
    return rise / (Digits(high[j_]) - Digits(low[j_]));
  }

 private:
  const FamilyInfo& family_;
  const Theta& theta_;
  std::size_t j_;
};

TEST(LogDensityGradient, IsTheDifferenceInManyDigits) {
  const WorkingPrecision precision(60);
  Rng rng(test::seed_of_this_test());
  for (const test::FamilyCase& next : test::family_cases({2, 3, 5, 10})) {
    if (next.theta.empty() || next.tau() == 0) continue;
    SCOPED_TRACE(next.name());
    Points u = uniforms(rng, 5, next.dim);
    u(3, 0) = 1e-12;
    u(4, 0) = 1 - 1e-12;
    const Points gradient = LogDensityGradient(*next.family, next.dim)(next.theta, u);
    for (Index i = 0; i < u.rows(); ++i) {
      const std::vector<double> row = test::row_of(u, i);
      for (std::size_t j = 0; j < next.theta.size(); ++j) {
        const Digits expected = MovedParameter(*next.family, next.theta, j).difference(row);
        if (!isfinite(expected)) continue;  // outside the support
        const Digits size = abs(expected);
        EXPECT_LE(abs(gradient(i, static_cast<Index>(j)) - expected), kTolerance * (size > 1 ? size : Digits(1)))
            << test::row_text(u, i) << ": " << gradient(i, static_cast<Index>(j)) << ", expected " << expected;
      }
    }
  }
}

TEST(LogDensityGradient, RefusesWrongShapes) {
  const FamilyInfo& frank = families::find("frank");
  EXPECT_THROW(LogDensityGradient(frank, 1), std::invalid_argument);
  EXPECT_THROW(LogDensityGradient(frank, kMaxDimension + 1), std::invalid_argument);
  const LogDensityGradient gradient(frank, 3);
  EXPECT_THROW((void)gradient({1.0}, Points::Constant(2, 2, 0.5)), std::invalid_argument);
  EXPECT_THROW((void)gradient({1.0, 2.0}, Points::Constant(2, 3, 0.5)), std::invalid_argument);
}

}  // namespace
}  // namespace sklar::symbolic
