/// The exact level has the digits it was asked for.

#include "copula/mixture.hpp"
#include "copula/rotated.hpp"
#include "tests/conformance/composite_reference.hpp"
#include "tests/conformance/family_test.hpp"

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
    const PsiReference reference(family(), next.theta);
    const Points u = hard_points(5, next.dim, rng);
    const auto log_pdf = copula->exact(Quantity::log_pdf, u, kDigits),
               log_cdf = copula->exact(Quantity::log_cdf, u, kDigits);
    const auto h = copula->exact(Quantity::h, u, kDigits), upper = copula->exact(Quantity::h_upper, u, kDigits);
    const auto v = copula->exact(Quantity::h_inv, u, kDigits);
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

constexpr double kKnown = 1e-280;  // probabilities from here on are known to the judge in all its digits

/// h and 1 - h.
template <class Reference>
void expect_exact_conditional(const Copula& copula, const Reference& reference, const Points& row) {
  const std::vector<double> u = row_of(row, 0);
  const auto expected = reference.conditional(std::span(u.data(), u.size() - 1), Digits(u.back()));
  if (expected.value > kKnown) {
    EXPECT_TRUE(agree(log(copula.exact(Quantity::h, row, kDigits)[0]), log(expected.value)));
  }
  if (expected.complement > kKnown) {
    EXPECT_TRUE(agree(log(copula.exact(Quantity::h_upper, row, kDigits)[0]), log(expected.complement)));
  }
}

/// Of the inverse v and 1 - v the smaller one by h there, and the other as the rest to 1.
template <class Reference>
void expect_exact_inverse(const Copula& copula, const Reference& reference, const Points& row) {
  const std::vector<double> u = row_of(row, 0);
  const Digits place = pow(Digits(10), -kReferenceDigits), p = u.back();
  const Digits v = copula.exact(Quantity::h_inv, row, kDigits)[0];
  const Digits w = copula.exact(Quantity::h_inv_upper, row, kDigits)[0];
  EXPECT_LE(abs(v + w - 1), place);
  const auto there = reference.conditional(std::span(u.data(), u.size() - 1), v < w ? v : Digits(1 - w));
  EXPECT_LE(abs(there.value - p), place * (p + there.slope * (v < w ? v : w))) << v << " " << w;
}

/// Every quantity of points with all coordinates in (0,1).
template <class Reference>
void expect_exact(const Copula& copula, const Reference& reference, const Points& u) {
  for (Index i = 0; i < u.rows(); ++i) {
    SCOPED_TRACE(row_text(u, i));
    const Points row = u.row(i);
    EXPECT_TRUE(agree(copula.exact(Quantity::log_pdf, row, kDigits)[0], reference.log_density(row_of(u, i))));
    const Digits cdf = reference.cdf(row_of(u, i));
    if (cdf > kKnown) {
      EXPECT_TRUE(agree(copula.exact(Quantity::log_cdf, row, kDigits)[0], log(cdf)));
    }
    expect_exact_conditional(copula, reference, row);
    expect_exact_inverse(copula, reference, row);
  }
}

TEST_P(Exact, OfRotationsAndMixtures) {
  const WorkingPrecision precision(kCompositeDigits);
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases_near(0.4, {2, 3})) {
    SCOPED_TRACE(next.name());
    std::vector<bool> first(static_cast<std::size_t>(next.dim), false), last = first;
    first.front() = last.back() = true;
    const CopulaPtr a = std::make_shared<Rotated>(next.copula(), first),
                    b = std::make_shared<Rotated>(next.copula(), last);
    const RotatedReference of_a(family(), next.theta, first), of_b(family(), next.theta, last);
    const Points u = extreme_points(3, next.dim, 1e-300, rng);
    expect_exact(*a, of_a, u);
    expect_exact(*b, of_b, u);
    const std::vector<double> weights = {0.25, 0.75};
    expect_exact(Mixture({a, b}, weights), MixtureReference({of_a, of_b}, weights), u);
  }
}

TEST_P(Exact, RoundsToTheStandardLevel) {
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 5, 50})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    const Points u = hard_points(4, next.dim, rng);
    const Column standard = copula->log_pdf(u);
    const auto values = copula->exact(Quantity::log_pdf, u, 20);
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
  EXPECT_THROW((void)copula->exact(Quantity::log_pdf, Points::Constant(1, 2, 0.5), 30), std::invalid_argument);
  EXPECT_THROW((void)copula->exact(Quantity::h, Points::Constant(1, 3, 1.5), 30), std::domain_error);
  for (const int digits : {0, Copula::kMostDigits + 1}) {
    EXPECT_THROW((void)copula->exact(Quantity::log_pdf, Points::Constant(1, 3, 0.5), digits), std::invalid_argument);
  }
  Points missing = Points::Constant(1, 3, 0.5);
  missing(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(isnan(copula->exact(Quantity::h, missing, 30)[0]));
}

}  // namespace
}  // namespace sklar::test
