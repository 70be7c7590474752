#include "copula/symbolic/log_density_gradient.hpp"

#include <gtest/gtest.h>

#include "copula/rotated_family.hpp"
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

  [[nodiscard]] Digits difference(std::span<const Digits> u) const {
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

/// The row, and where the rotation reflects it 1 minus it.
std::vector<Digits> row_of_base(const Points& u, Index i, const std::vector<bool>& reflected) {
  std::vector<Digits> row;
  for (std::size_t k = 0; k < reflected.size(); ++k) {
    const Digits value = u(i, static_cast<Index>(k));
    row.push_back(reflected[k] ? Digits(1 - value) : value);
  }
  return row;
}

/// Of the families, each rotated.
void expect_differences(const Rotation& rotation, const std::vector<int>& dims) {
  const WorkingPrecision precision(60);
  Rng rng(test::seed_of_this_test());
  for (const test::FamilyCase& next : test::family_cases(dims)) {
    if (next.theta.empty() || next.tau() == 0) continue;
    const FamilyInfo family = rotation.none() ? *next.family : rotated_family(*next.family, rotation);
    SCOPED_TRACE(next.name() + rotation.name());
    Points u = uniforms(rng, 5, next.dim);
    u(3, 0) = 1e-12;
    u(4, 0) = 1 - 1e-12;
    const Points gradient = LogDensityGradient(family, next.dim)(next.theta, u);
    for (Index i = 0; i < u.rows(); ++i) {
      const std::vector<Digits> row = row_of_base(u, i, rotation.in(next.dim));
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

TEST(LogDensityGradient, IsTheDifferenceInManyDigits) {
  expect_differences({}, {2, 3, 5, 10});
}

TEST(LogDensityGradient, OfRotationsToo) {
  expect_differences(Rotation("90"), {2});
  expect_differences(Rotation("180"), {2, 5});
  expect_differences(Rotation("u1+u3"), {3});
}

TEST(LogDensityGradient, RefusesWrongShapes) {
  const FamilyInfo& frank = families::find("frank");
  EXPECT_THROW(LogDensityGradient(frank, 1), std::invalid_argument);
  EXPECT_THROW(LogDensityGradient(frank, kMaxDimension + 1), std::invalid_argument);
  EXPECT_THROW(LogDensityGradient(rotated_family(frank, Rotation("90")), 3), std::domain_error);
  const LogDensityGradient gradient(frank, 3);
  EXPECT_THROW((void)gradient({1.0}, Points::Constant(2, 2, 0.5)), std::invalid_argument);
  EXPECT_THROW((void)gradient({1.0, 2.0}, Points::Constant(2, 3, 0.5)), std::invalid_argument);
}

}  // namespace
}  // namespace sklar::symbolic
