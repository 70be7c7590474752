/// Mixtures of the families and of rotations of them.

#include "copula/mixture.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "copula/rotated.hpp"
#include "tests/conformance/agreement.hpp"
#include "tests/conformance/composite_reference.hpp"
#include "tests/conformance/family_test.hpp"

namespace sklar::test {
namespace {

SKLAR_FAMILY_SUITE(MixtureOfFamily);

constexpr double kSmallest = 1e-100;  // takes the judge of three components a fraction of the digits of 1e-300
const std::vector<double> kWeights = {0.5, 0.3, 0.2};

/// Of a copula, its survival copula and a weak Frank copula.
CopulaPtr mixture_with(const FamilyCase& next) {
  const CopulaPtr own = next.copula();
  return std::make_shared<Mixture>(
      std::vector{own, survival_copula(own), families::find("frank").make(next.dim, {1.0})}, kWeights);
}

MixtureReference reference_of(const FamilyCase& next) {
  const std::vector<bool> none(static_cast<std::size_t>(next.dim), false), all(none.size(), true);
  return {{{*next.family, next.theta, none}, {*next.family, next.theta, all}, {families::find("frank"), {1.0}, none}},
          kWeights};
}

TEST_P(MixtureOfFamily, LogDensityAndCdf) {
  const WorkingPrecision precision(kCompositeDigits);
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr mixture = mixture_with(next);
    const MixtureReference reference = reference_of(next);
    const Points u = extreme_points(1, next.dim, kSmallest, rng);
    const Column log_pdf = mixture->log_pdf(u), log_cdf = mixture->log_cdf(u);
    for (Index i = 0; i < u.rows(); ++i) {
      EXPECT_TRUE(logarithm_agrees(log_pdf(i), reference.log_density(row_of(u, i)))) << "log_pdf" << row_text(u, i);
      const Digits cdf = reference.cdf(row_of(u, i));
      if (cdf > 1e-290) {
        EXPECT_TRUE(logarithm_agrees(log_cdf(i), log(cdf))) << "log_cdf" << row_text(u, i);
      }
    }
  }
}

TEST_P(MixtureOfFamily, ConditionalAndItsInverse) {
  const WorkingPrecision precision(kCompositeDigits);
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3})) {
    SCOPED_TRACE(next.name());
    expect_conditionals(*mixture_with(next), reference_of(next), extreme_points(1, next.dim, kSmallest, rng));
  }
}

Column quantity(const Copula& copula, int which, const Points& u) {
  switch (which) {
    case 0:
      return copula.log_pdf(u);
    case 1:
      return copula.log_cdf(u);
    case 2:
      return copula.h(u);
    case 3:
      return copula.h_upper(u);
    case 4:
      return copula.h_inv(u);
    default:
      return copula.h_inv_upper(u);
  }
}

void expect_identical(const Column& a, const Column& b) {
  for (Index i = 0; i < a.size(); ++i) EXPECT_TRUE(a(i) == b(i) || (std::isnan(a(i)) && std::isnan(b(i)))) << a(i);
}

TEST_P(MixtureOfFamily, OfOneIsThatCopula) {
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    const Mixture mixture({copula}, {1.0});
    const Points u = hard_points(20, next.dim, rng);
    for (int which = 0; which < 6; ++which) {
      expect_identical(quantity(mixture, which, u), quantity(*copula, which, u));
    }
  }
}

TEST_P(MixtureOfFamily, ABatchDoesNotDependOnItsOtherRows) {
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases_near(0.4, {2, 3})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr mixture = mixture_with(next);
    Points u = hard_points(12, next.dim, rng);
    u(3, 0) = std::nan("");
    for (int which = 0; which < 6; ++which) {
      const Column all = quantity(*mixture, which, u);
      EXPECT_TRUE(std::isnan(all(3)));
      for (Index i = 0; i < u.rows(); ++i) {
        expect_identical(quantity(*mixture, which, u.row(i)), all.segment(i, 1));
      }
    }
  }
}

TEST_P(MixtureOfFamily, DensityIntegratesToTheConditional) {
  constexpr double kQuadrature = 1e-8;
  using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
  for (const FamilyCase& next : cases_near(0.4, {2, 3})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr mixture = mixture_with(next);
    Points u = Points::Constant(1, next.dim, 0.3);
    const auto pdf_at = [&](double v) {
      u(0, next.dim - 1) = v;
      return mixture->pdf(u)(0);
    };
    const double whole = Rule::integrate(pdf_at, 0.0, 1.0, 15, 1e-10);
    const double part = Rule::integrate(pdf_at, 0.0, 0.6, 15, 1e-10);
    u(0, next.dim - 1) = 0.6;
    EXPECT_NEAR(part / whole, mixture->h(u)(0), kQuadrature);
    EXPECT_NEAR(1 - part / whole, mixture->h_upper(u)(0), kQuadrature);
    if (next.dim == 2) {
      EXPECT_NEAR(whole, 1, kQuadrature);
    }
  }
}

// What a relative change of the inverse of kStep moves h by must bracket p, from the end where the inverse is exact.
TEST_P(MixtureOfFamily, InverseOfTheConditional) {
  constexpr double kStep = 1e-11;
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases_near(0.4, {2, 3})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr mixture = mixture_with(next);
    std::vector<bool> last(static_cast<std::size_t>(next.dim), false);
    last.back() = true;
    const CopulaPtr reflected = std::make_shared<Rotated>(mixture, last);  // takes 1 - v
    Points u = hard_points(40, next.dim, rng);
    u(0, next.dim - 1) = 1e-300;
    u(1, next.dim - 1) = 1e-18;
    const auto p = u.col(next.dim - 1).eval();
    const Column v = mixture->h_inv(u), w = mixture->h_inv_upper(u);
    const auto at = [&](const Copula& copula, const Column& x, bool upper) {
      Points point = u;
      point.col(next.dim - 1) = x.min(1.0);
      return Column(upper ? copula.h_upper(point) : copula.h(point));
    };
    const Column below = at(*mixture, v * (1 - kStep), false), above = at(*mixture, v * (1 + kStep), false);
    const Column far = at(*reflected, w * (1 + kStep), true), near = at(*reflected, w * (1 - kStep), true);
    for (Index i = 0; i < u.rows(); ++i) {
      constexpr double kRounding = 1e-15;
      EXPECT_LE(below(i), p(i) * (1 + kRounding)) << row_text(u, i) << " v " << v(i);
      EXPECT_GE(above(i), p(i) * (1 - kRounding)) << row_text(u, i) << " v " << v(i);
      EXPECT_LE(far(i), p(i) * (1 + kRounding)) << row_text(u, i) << " 1 - v " << w(i);
      EXPECT_GE(near(i), p(i) * (1 - kRounding)) << row_text(u, i) << " 1 - v " << w(i);
    }
  }
}

TEST_P(MixtureOfFamily, DrawsFillCellsAsTheCdfSays) {
  constexpr Index kDraws = 20000;
  const std::vector<double> edges = {0, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1};
  const auto n = static_cast<Index>(edges.size()) - 1;
  const FamilyCase next = cases_near(0.4, {2}).front();
  const CopulaPtr mixture = mixture_with(next);
  std::vector<double> observed(static_cast<std::size_t>(n * n)), expected(observed.size());
  const auto cdf = [&](Index i, Index j) {
    Points corner(1, 2);
    corner << edges[static_cast<std::size_t>(i)], edges[static_cast<std::size_t>(j)];
    return mixture->cdf(corner)(0);
  };
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const double volume = cdf(i + 1, j + 1) - cdf(i, j + 1) - cdf(i + 1, j) + cdf(i, j);
      expected[static_cast<std::size_t>(i * n + j)] = volume * static_cast<double>(kDraws);
    }
  }
  Rng rng(seed_of_this_test());
  const Points u = mixture->sample(kDraws, rng);
  const auto cell = [&](double value) {
    return std::upper_bound(edges.begin(), edges.end() - 1, value) - edges.begin() - 1;
  };
  for (Index i = 0; i < kDraws; ++i) ++observed[static_cast<std::size_t>(cell(u(i, 0)) * n + cell(u(i, 1)))];
  expect_chi_square(observed, expected, static_cast<int>(families::all().size()), next.name());
}

TEST(Mixture, SaysWhatIsWrong) {
  const CopulaPtr two = families::find("clayton").make(2, {2.0}), three = families::find("clayton").make(3, {2.0});
  EXPECT_THROW(Mixture({}, {}), std::invalid_argument);
  EXPECT_THROW(Mixture({nullptr}, {1.0}), std::invalid_argument);
  EXPECT_THROW(Mixture({two, three}, {0.5, 0.5}), std::invalid_argument);
  EXPECT_THROW(Mixture({two, two}, {1.0}), std::invalid_argument);
  EXPECT_THROW(Mixture({two, two}, {1.5, -0.5}), std::domain_error);
  EXPECT_THROW(Mixture({two, two}, {0.5, 0.4}), std::domain_error);
}

}  // namespace
}  // namespace sklar::test
