/// The exact level has the digits it was asked for.

#include "copula/archimedean_copula.hpp"
#include "tests/conformance/family_test.hpp"
#include "tests/support/psi_reference.hpp"

namespace sklar::test {
namespace {

SKLAR_FAMILY_SUITE(Exact);

constexpr int kDigits = 40;           // asked for
constexpr int kReferenceDigits = 28;  // two widths of the reference agree to 30, absolutely where below 1

testing::AssertionResult agree(const Digits& value, const Digits& expected) {
  const Digits size = abs(expected);
  const Digits bound = pow(Digits(10), -kReferenceDigits) * (size > 1 ? size : Digits(1));
  if (value == expected || abs(value - expected) <= bound) return testing::AssertionSuccess();
  return testing::AssertionFailure() << value << ", expected " << expected;
}

TEST_P(Exact, AgreesWithTheTextbookPsi) {
  const WorkingPrecision precision(2 * kDigits);
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3, 6})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    const auto& exact = dynamic_cast<const ArchimedeanCopula&>(*copula);
    const PsiReference reference(family(), next.theta);
    const Points u = hard_points(5, next.dim, rng);
    const auto log_pdf = exact.exact(Quantity::log_pdf, u, kDigits),
               log_cdf = exact.exact(Quantity::log_cdf, u, kDigits);
    const auto h = exact.exact(Quantity::h, u, kDigits), upper = exact.exact(Quantity::h_upper, u, kDigits);
    const auto v = exact.exact(Quantity::h_inv, u, kDigits);
    for (Index i = 0; i < u.rows(); ++i) {
      const std::vector<double> row = row_of(u, i);
      const std::span<const double> given(row.data(), row.size() - 1);
      const auto at = static_cast<std::size_t>(i);
      EXPECT_TRUE(agree(log_pdf[at], reference.log_density(row))) << row_text(u, i);
      EXPECT_TRUE(agree(log_cdf[at], reference.log_cdf(row))) << row_text(u, i);
      if (given.size() > 1 && isinf(reference.log_density(given))) continue;
      const auto expected = reference.conditional(given, Digits(row.back()));
      EXPECT_TRUE(agree(h[at], expected.value)) << row_text(u, i);
      EXPECT_TRUE(agree(upper[at], expected.complement)) << row_text(u, i);
      if (!(v[at] > 0 && v[at] < 1)) continue;
      const auto there = reference.conditional(given, v[at]);
      // v has 40 digits: h there is p but for its slope times the last of them.
      EXPECT_LE(abs(there.value - row.back()), pow(Digits(10), -kReferenceDigits) * (1 + there.slope * v[at]));
    }
  }
}

TEST_P(Exact, RoundsToTheStandardLevel) {
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 5, 50})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    const auto& exact = dynamic_cast<const ArchimedeanCopula&>(*copula);
    const Points u = hard_points(4, next.dim, rng);
    const Column standard = copula->log_pdf(u);
    const auto values = exact.exact(Quantity::log_pdf, u, 20);
    for (Index i = 0; i < u.rows(); ++i) {
      const auto value = static_cast<double>(values[static_cast<std::size_t>(i)]);
      if (standard(i) == value) continue;
      EXPECT_LE(std::abs(standard(i) - value), 1e-13 * std::max(1.0, std::abs(value))) << row_text(u, i);
    }
  }
}

TEST_P(Exact, RefusesWhatItCannotGive) {
  const FamilyCase next = cases_near(0.3, {3}).front();
  const CopulaPtr copula = next.copula();
  const auto& exact = dynamic_cast<const ArchimedeanCopula&>(*copula);
  EXPECT_THROW((void)exact.exact(Quantity::log_pdf, Points::Constant(1, 2, 0.5), 30), std::invalid_argument);
  EXPECT_THROW((void)exact.exact(Quantity::h, Points::Constant(1, 3, 1.5), 30), std::domain_error);
  for (const int digits : {0, ArchimedeanCopula::kMostDigits + 1}) {
    EXPECT_THROW((void)exact.exact(Quantity::log_pdf, Points::Constant(1, 3, 0.5), digits), std::invalid_argument);
  }
  Points missing = Points::Constant(1, 3, 0.5);
  missing(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(isnan(exact.exact(Quantity::h, missing, 30)[0]));
}

}  // namespace
}  // namespace sklar::test
