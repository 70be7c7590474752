/// Every quantity against digits that come from elsewhere: the textbook psi of each family in multiprecision, and the
/// reference tables in $SKLAR_TEST_DATA/conformance.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "copula/archimedean_copula.hpp"
#include "tests/conformance/agreement.hpp"
#include "tests/conformance/family_test.hpp"
#include "tests/support/psi_reference.hpp"

namespace sklar::test {
namespace {

constexpr int kDigits = 60;

SKLAR_FAMILY_SUITE(TextbookPsi);

/// visit(copula, reference, points) for each case.
template <class Visit>
void for_each_case(const std::vector<FamilyCase>& cases, Index points, const Visit& visit) {
  const WorkingPrecision precision(kDigits);
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases) {
    SCOPED_TRACE(next.name());
    visit(*next.copula(), PsiReference(*next.family, next.theta), hard_points(points, next.dim, rng));
  }
}

TEST_P(TextbookPsi, LogDensityAndLogCdf) {
  for_each_case(
      cases({2, 3, 4, 5, 6, 10}), 6, [](const Copula& copula, const PsiReference& reference, const Points& u) {
        const Column log_pdf = copula.log_pdf(u), log_cdf = copula.log_cdf(u);
        for (Index i = 0; i < u.rows(); ++i) {
          const std::vector<double> row = row_of(u, i);
          EXPECT_TRUE(logarithm_agrees(log_pdf(i), reference.log_density(row))) << "log_pdf" << row_text(u, i);
          EXPECT_TRUE(logarithm_agrees(log_cdf(i), reference.log_cdf(row))) << "log_cdf" << row_text(u, i);
        }
      });
}

TEST_P(TextbookPsi, HighDimension) {
  for_each_case(cases_near(0.5, {50, 100}), 1,
                [](const Copula& copula, const PsiReference& reference, const Points& u) {
                  EXPECT_TRUE(logarithm_agrees(copula.log_pdf(u)(0), reference.log_density(row_of(u, 0))));
                });
}

TEST_P(TextbookPsi, ConditionalAndItsInverse) {
  for_each_case(cases({2, 3, 4, 5}), 5, expect_conditionals<PsiReference>);
}

/// Almost independence, of either sign if there are two, and almost the ends of the domain; 1000 for an infinite one.
std::vector<Theta> extreme_parameters(const FamilyInfo& family, int dim) {
  constexpr double kFar = 1000, kNear = 1e-9;
  if (family.parameters.size() != 1) return {};
  const Interval domain = family.parameters[0].domain(dim), taus = family.tau_range(dim);
  std::vector<Theta> thetas;
  for (const double end : {domain.lowest, domain.highest}) {
    thetas.push_back({std::clamp(end, -kFar, kFar)});
    if (!family.admits(dim, thetas.back()) || std::abs(end) <= 1) thetas.back()[0] = end * (1 - kNear);
  }
  for (const double tau : {-kNear, kNear}) {
    if (taus.contains(tau)) thetas.push_back(family.from_tau(dim, tau));
  }
  std::erase_if(thetas, [&](const Theta& theta) { return !family.admits(dim, theta); });
  return thetas;
}

TEST_P(TextbookPsi, ConditionalAndItsInverseAtExtremes) {
  constexpr std::array<double, 4> kExtremes = {1e-300, 1e-12, 0.5, 1 - 1e-14};
  constexpr Index kPoints = 8;
  const WorkingPrecision precision(350);  // 1 - 1e-300, and room
  Rng rng(seed_of_this_test());
  for (const int dim : {2, 3, 4, 5}) {
    for (const Theta& theta : extreme_parameters(family(), dim)) {
      SCOPED_TRACE("d = " + std::to_string(dim) + ", theta = " + to_text(theta[0]));
      Points u(kPoints, dim);
      for (Index i = 0; i < kPoints; ++i) {
        for (int k = 0; k < dim - 1; ++k) u(i, k) = kExtremes[rng() % kExtremes.size()];
        u(i, dim - 1) = kExtremes[static_cast<std::size_t>(i) % kExtremes.size()];
      }
      expect_conditionals(*family().make(dim, theta), PsiReference(family(), theta), u);
    }
  }
}

TEST_P(TextbookPsi, InverseIsInsideWhereADoubleIs) {
  for (const FamilyCase& next : cases({2, 3})) {
    SCOPED_TRACE(next.name());
    Points u = Points::Constant(6, next.dim, 0.5);
    u.bottomRows(3).setConstant(1 - 0x1p-52);
    for (Index i = 0; i < u.rows(); ++i) u(i, next.dim - 1) = std::array{0x1p-52, 0x1.8p-53, 1 - 0x1p-52}[i % 3];
    const WorkingPrecision precision(kDigits);
    expect_conditionals(*next.copula(), PsiReference(family(), next.theta), u);
  }
}

TEST_P(TextbookPsi, SubnormalProbabilitiesAreTheNearestDoubles) {
  for (const FamilyCase& next : cases({2, 3})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    for (const double p : {3e-309, 7e-312, 2e-320}) {
      Points u = Points::Constant(1, next.dim, 0.3);
      u(0, next.dim - 1) = p;
      u(0, next.dim - 1) = copula->h_inv(u)(0);
      if (u(0, next.dim - 1) == 0) continue;
      const std::vector<double> row = row_of(u, 0);
      const std::span<const double> given(row.data(), row.size() - 1);
      if (given.size() > 1 && isinf(PsiReference(family(), next.theta).log_density(given))) continue;
      const Digits expected = PsiReference(family(), next.theta).conditional(given, Digits(row.back())).value;
      const double h = copula->h(u)(0);
      EXPECT_TRUE(verdict(abs(h - expected) <= 0.51 * kSmallestDouble || expected > kSmallestNormal, h, expected));
    }
  }
}

TEST_P(TextbookPsi, Derivatives) {
  const WorkingPrecision precision(kDigits);
  for (const FamilyCase& next : cases({2, 5})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    const auto* archimedean = dynamic_cast<const ArchimedeanCopula*>(copula.get());
    if (archimedean == nullptr) continue;
    Column t(5);
    t << 1e-12, 1e-3, 0.7, 3, 40;
    const PsiReference reference(family(), next.theta);
    for (int order = 0; order <= next.dim; ++order) {
      const Column value = archimedean->log_abs_dpsi(order, t);
      for (Index i = 0; i < t.size(); ++i) {
        EXPECT_TRUE(logarithm_agrees(value(i), reference.log_abs_dpsi(order, t(i)))) << order << " at " << t(i);
      }
    }
  }
}

TEST_P(TextbookPsi, KendallDistribution) {
  const WorkingPrecision precision(kDigits);
  for (const FamilyCase& next : cases({2, 3, 10})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    const auto& archimedean = dynamic_cast<const ArchimedeanCopula&>(*copula);
    Column v(6);
    v << 1e-100, 1e-12, 1e-3, 0.5, 1 - 1e-3, 1 - 1e-14;
    const Column lower = archimedean.kendall_cdf(v), upper = archimedean.kendall_survival(v);
    const PsiReference reference(family(), next.theta);
    for (Index i = 0; i < v.size(); ++i) {
      const auto expected = reference.kendall(next.dim, v(i));
      EXPECT_TRUE(probability_agrees(lower(i), expected.value)) << v(i);
      EXPECT_TRUE(probability_agrees(upper(i), expected.complement)) << v(i);
    }
  }
}

/// One row of a table: family,theta,quantity,d,u (space-separated),expected.
struct TableRow {
  std::string text, family, quantity, expected;
  double theta = 0;
  Points u;
};

TableRow parse(const std::string& line) {
  std::istringstream fields(line);
  std::string theta, dim, values;
  TableRow row;
  row.text = line;
  std::getline(fields, row.family, ',');
  std::getline(fields, theta, ',');
  std::getline(fields, row.quantity, ',');
  std::getline(fields, dim, ',');
  std::getline(fields, values, ',');
  std::getline(fields, row.expected, ',');
  row.theta = std::strtod(theta.c_str(), nullptr);
  row.u.resize(1, std::atoi(dim.c_str()));
  std::istringstream each(values);
  std::string value;
  for (Index k = 0; k < row.u.cols() && each >> value; ++k) row.u(0, k) = std::strtod(value.c_str(), nullptr);
  return row;
}

testing::AssertionResult inverse_agrees(const FamilyInfo& family, const TableRow& row, bool upper, double value,
                                        const Digits& expected) {
  if (abs(value - expected) <= kInverseTolerance * abs(expected)) return testing::AssertionSuccess();
  const std::vector<double> given = row_of(row.u.leftCols(row.u.cols() - 1), 0);
  const PsiReference reference(family, {row.theta});
  const auto h_at = [&](const Digits& v) { return reference.conditional(given, v); };
  return is_inverse(h_at, row.u(0, row.u.cols() - 1), upper, value);
}

testing::AssertionResult row_agrees(const FamilyInfo& family, const TableRow& row) {
  const CopulaPtr copula = family.make(static_cast<int>(row.u.cols()), {row.theta});
  const Digits expected(row.expected);
  if (row.quantity == "log_pdf") return logarithm_agrees(copula->log_pdf(row.u)(0), expected);
  if (row.quantity == "h") return probability_agrees(copula->h(row.u)(0), expected);
  if (row.quantity == "h_upper") return probability_agrees(copula->h_upper(row.u)(0), expected);
  if (row.quantity == "h_inv") return inverse_agrees(family, row, false, copula->h_inv(row.u)(0), expected);
  if (row.quantity == "h_inv_upper") return inverse_agrees(family, row, true, copula->h_inv_upper(row.u)(0), expected);
  return testing::AssertionFailure() << "unknown quantity";
}

TEST(ReferenceTables, EveryRowOfARegisteredFamilyPasses) {
  const char* folder = std::getenv("SKLAR_TEST_DATA");
  if (folder == nullptr) GTEST_SKIP() << "SKLAR_TEST_DATA names no folder with conformance/*.csv";
  const WorkingPrecision precision(kDigits);
  int rows = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(folder) / "conformance")) {
    std::ifstream file(entry.path());
    std::string line;
    std::getline(file, line);
    if (line != "family,theta,quantity,d,u,expected") continue;
    while (std::getline(file, line)) {
      const TableRow row = parse(line);
      for (const FamilyInfo& family : families::all()) {
        if (family.name != row.family) continue;
        ++rows;
        EXPECT_TRUE(row_agrees(family, row)) << entry.path().filename() << ": " << row.text;
      }
    }
  }
  EXPECT_GT(rows, 0) << folder;
}

}  // namespace
}  // namespace sklar::test
