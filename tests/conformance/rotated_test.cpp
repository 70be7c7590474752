/// Rotated copulas against the textbook psi at 1 - u in many digits.

#include "copula/rotated.hpp"

#include "tests/conformance/agreement.hpp"
#include "tests/conformance/composite_reference.hpp"
#include "tests/conformance/family_test.hpp"

namespace sklar::test {
namespace {

SKLAR_FAMILY_SUITE(RotatedFamily);

std::vector<std::vector<bool>> reflections(int dim) {
  if (dim == 2) return {{true, false}, {false, true}, {true, true}};
  return {{false, true, false}, {true, false, true}, {true, true, true}};
}

/// visit(copula, reference, points) for each case, by one rotation after another.
template <class Visit>
void for_each_rotated(const std::vector<FamilyCase>& cases, const Visit& visit) {
  const WorkingPrecision precision(kCompositeDigits);
  Rng rng(seed_of_this_test());
  std::size_t turn = 0;
  for (const FamilyCase& next : cases) {
    const std::vector<bool> reflected = reflections(next.dim)[turn++ % 3];
    SCOPED_TRACE(next.name() + testing::PrintToString(reflected));
    visit(Rotated(next.copula(), reflected), RotatedReference(*next.family, next.theta, reflected),
          extreme_points(2, next.dim, next.dim == 2 ? 1e-300 : 1e-100, rng));
  }
}

TEST_P(RotatedFamily, LogDensityAndCdf) {
  for_each_rotated(cases({2, 3}), [](const Copula& copula, const RotatedReference& reference, const Points& u) {
    const Column log_pdf = copula.log_pdf(u), log_cdf = copula.log_cdf(u);
    for (Index i = 0; i < u.rows(); ++i) {
      EXPECT_TRUE(logarithm_agrees(log_pdf(i), reference.log_density(row_of(u, i)))) << "log_pdf" << row_text(u, i);
      const Digits cdf = reference.cdf(row_of(u, i));
      if (cdf > 1e-290) {
        EXPECT_TRUE(logarithm_agrees(log_cdf(i), log(cdf))) << "log_cdf" << row_text(u, i);
      }
    }
  });
}

TEST_P(RotatedFamily, ConditionalAndItsInverse) {
  for_each_rotated(cases({2, 3}), expect_conditionals<RotatedReference>);
}

void expect_identical(const Column& a, const Column& b) {
  for (Index i = 0; i < a.size(); ++i) EXPECT_TRUE(a(i) == b(i) || (std::isnan(a(i)) && std::isnan(b(i)))) << a(i);
}

void expect_identical(const Copula& a, const Copula& b, const Points& u) {
  expect_identical(a.log_pdf(u), b.log_pdf(u));
  expect_identical(a.log_cdf(u), b.log_cdf(u));
  expect_identical(a.h(u), b.h(u));
  expect_identical(a.h_upper(u), b.h_upper(u));
  expect_identical(a.h_inv(u), b.h_inv(u));
  expect_identical(a.h_inv_upper(u), b.h_inv_upper(u));
}

TEST_P(RotatedFamily, TwiceIsTheIdentity) {
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3, 20})) {
    SCOPED_TRACE(next.name());
    std::vector<bool> some(static_cast<std::size_t>(next.dim));
    for (std::size_t k = 0; k < some.size(); ++k) some[k] = k % 3 != 1;
    const CopulaPtr base = next.copula();
    const Points u = hard_points(10, next.dim, rng);
    expect_identical(*base, *survival_copula(survival_copula(base)), u);
    expect_identical(*base, Rotated(std::make_shared<Rotated>(base, some), some), u);
  }
}

TEST_P(RotatedFamily, ABatchDoesNotDependOnItsOtherRows) {
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = survival_copula(next.copula());
    Points u = hard_points(12, next.dim, rng);
    u(3, 0) = std::nan("");
    const Column log_pdf = copula->log_pdf(u), log_cdf = copula->log_cdf(u), h = copula->h(u), v = copula->h_inv(u);
    for (Index i = 0; i < u.rows(); ++i) {
      const Points row = u.row(i);
      expect_identical(copula->log_pdf(row), log_pdf.segment(i, 1));
      expect_identical(copula->log_cdf(row), log_cdf.segment(i, 1));
      expect_identical(copula->h(row), h.segment(i, 1));
      expect_identical(copula->h_inv(row), v.segment(i, 1));
    }
    EXPECT_TRUE(std::isnan(log_pdf(3)));
  }
}

TEST_P(RotatedFamily, RosenblattThereAndBack) {
  constexpr double kRoundTrip = 1e-9;
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases_near(0.4, {2, 3})) {
    SCOPED_TRACE(next.name());
    for (const std::vector<bool>& reflected : reflections(next.dim)) {
      const Rotated copula(next.copula(), reflected);
      const Points w = uniforms(rng, 200, next.dim);
      const Points back = copula.rosenblatt(copula.inverse_rosenblatt(w));
      EXPECT_LE((back - w).abs().maxCoeff(), kRoundTrip);
    }
  }
}

TEST_P(RotatedFamily, BoundaryIsThatOfTheBase) {
  for (const FamilyCase& next : cases({2, 3})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr base = next.copula(), survival = survival_copula(base);
    Points u = Points::Constant(4, next.dim, 0.5);  // 1 - u is exact
    u(0, 0) = 0;
    u(1, 0) = 1;
    u.row(2) = 0;
    u.row(3) = 1;
    expect_identical(survival->log_pdf(u), base->log_pdf(1 - u));
    u.col(next.dim - 1) = 0.25;
    expect_identical(survival->h(u), base->h_upper(1 - u));
    expect_identical(survival->h_inv(u), base->h_inv_upper(1 - u));
    EXPECT_EQ(survival->cdf(u)(0), 0);
    EXPECT_EQ(survival->cdf(Points::Ones(1, next.dim))(0), 1);
  }
}

// The terms of inclusion and exclusion agree to thousands of digits.
TEST(Rotated, CdfWhereItsTermsCancel) {
  const double theta = 200, t = 1e-12;  // t - C(1-t, t) to first order in t^theta
  const CopulaPtr base = families::find("clayton").make(2, {theta});
  const double expected = (1 + theta) * std::log(t) + std::log(std::expm1(-theta * std::log1p(-t)) / theta);
  const Column log_cdf = Rotated(base, {true, false}).log_cdf(Points::Constant(1, 2, t));
  EXPECT_TRUE(logarithm_agrees(log_cdf(0), Digits(expected)));

  constexpr int kDim = 15;  // |psi^(d)(0)| u^d to first order in u
  const double weak = 2, u = 1e-300;
  double survival = kDim * std::log(u);
  for (int k = 0; k < kDim; ++k) survival += std::log1p(k * weak);
  const Column of_all =
      survival_copula(families::find("clayton").make(kDim, {weak}))->log_cdf(Points::Constant(1, kDim, u));
  EXPECT_TRUE(logarithm_agrees(of_all(0), Digits(survival)));
}

TEST(Rotated, SaysWhatIsWrong) {
  const CopulaPtr base = families::find("clayton").make(25, {2.0});
  EXPECT_THROW(Rotated(nullptr, {true}), std::invalid_argument);
  EXPECT_THROW(Rotated(base, {true, false}), std::invalid_argument);
  EXPECT_THROW((void)survival_copula(base)->cdf(Points::Constant(1, 25, 0.5)), std::domain_error);
}

}  // namespace
}  // namespace sklar::test
