/// Measures of dependence: Kendall's tau and its inverse, tail coefficients, the limit of independence.

#include "copula/inference/dependence.hpp"

#include <array>
#include <boost/math/quadrature/tanh_sinh.hpp>

#include "tests/conformance/family_test.hpp"
#include "tests/support/psi_reference.hpp"

namespace sklar::test {
namespace {

SKLAR_FAMILY_SUITE(Dependence);

TEST_P(Dependence, TauIsThatOfTheGenerator) {
  constexpr double kTolerance = 1e-8;  // of the quadrature
  for (const FamilyCase& next : cases({2})) {
    SCOPED_TRACE(next.name());
    const PsiReference reference(family(), next.theta);
    boost::math::quadrature::tanh_sinh<double> quadrature(6);
    const auto integrand = [&](double v) {
      return v < 1e-30 || v == 1 ? 0.0 : static_cast<double>(reference.tau_integrand(v));
    };
    EXPECT_NEAR(next.tau(), 1 + 4 * quadrature.integrate(integrand, 0.0, 1.0, 1e-7), kTolerance);
  }
}

TEST_P(Dependence, ThetaFromTauInvertsTau) {
  constexpr double kTolerance = 1e-12;  // of tau, and of theta as far as tau determines it
  if (!family().theta_from_tau) {
    EXPECT_THROW((void)family().from_tau(2, 0.1), std::invalid_argument);
    return;
  }
  for (const FamilyCase& next : cases({2, 5})) {
    SCOPED_TRACE(next.name());
    const double tau = next.tau(), theta = family().theta_from_tau(tau)[0];
    EXPECT_NEAR(family().tau({theta}), tau, kTolerance * std::abs(tau));
    const double step = 1e-6 * std::max(1e-6, std::abs(next.theta[0]));
    const double slope = std::abs(family().tau({next.theta[0] + step}) - tau) / step;
    EXPECT_NEAR(theta, next.theta[0], 1e-14 * std::abs(next.theta[0]) + 1e-14 / slope);
    EXPECT_EQ(family().from_tau(next.dim, tau), Theta{theta});
  }
  const Interval range = family().tau_range(2);
  EXPECT_THROW((void)family().from_tau(2, 1.5), std::domain_error);
  EXPECT_THROW((void)family().from_tau(2, -1.5), std::domain_error);
  EXPECT_THROW((void)family().from_tau(2, std::nan("")), std::domain_error);
  for (double tau = range.lowest + 0.05; tau < range.highest - 0.04; tau += 0.05) {
    EXPECT_NEAR(family().tau(family().from_tau(2, tau)), tau, kTolerance);
  }
}

TEST_P(Dependence, TailCoefficientsAreLimits) {
  // lambda_L = lim dC(u,u)/du = lim 2 h(u,u) at 0, lambda_U = lim 2 (1 - h(u,u)) at 1.
  constexpr double kNear = 0.1;  // slowest: powers of u of about 1/theta
  for (const FamilyCase& next : cases({2})) {
    SCOPED_TRACE(next.name());
    const TailDependence tails = family().tails(next.theta);
    Points low(3, 2), high(3, 2);
    low << 1e-30, 1e-30, 1e-100, 1e-100, 1e-300, 1e-300;
    for (Index i = 0; i < 3; ++i) high.row(i).setConstant(1 - std::ldexp(1.0, -15 - 19 * static_cast<int>(i)));
    const Column lower = (2 * next.copula()->h(low) - tails.lower).abs();
    const Column upper = (2 * next.copula()->h_upper(high) - tails.upper).abs();
    for (const Column& distance : {lower, upper}) {
      EXPECT_LE(distance(1), distance(0) + 1e-12);
      EXPECT_LE(distance(2), distance(1) + 1e-12);
      EXPECT_LE(distance(2), kNear);
    }
  }
}

TEST_P(Dependence, IndependenceIsReachedContinuously) {
  if (!family().theta_from_tau) {
    EXPECT_THROW((void)family().from_tau(2, 0.1), std::invalid_argument);
    return;
  }
  // The limit is not uniform: points further out than 1e-3 from the faces feel any tau above 1e-15.
  constexpr double kScale = 1e6;  // above (log u)^2 / (1 - u) times the number of pairs
  Rng rng(seed_of_this_test());
  for (const int dim : {2, 5, 10}) {
    const Points u = hard_points(40, dim, rng).max(1e-3).min(1 - 1e-3);
    const Column last = u.col(dim - 1);
    const Interval range = family().tau_range(dim);
    for (const double tau : {-1e-3, -1e-6, -1e-9, -1e-12, -1e-300, 0.0, 1e-300, 1e-15, 1e-12, 1e-9, 1e-6}) {
      if (!range.contains(tau)) continue;
      SCOPED_TRACE("d = " + std::to_string(dim) + ", tau = " + to_text(tau));
      const CopulaPtr copula = family().make(dim, family().from_tau(dim, tau));
      const double tolerance = std::abs(tau) * kScale + (tau == 0 ? 0 : 1e-13);
      EXPECT_LE(copula->log_pdf(u).abs().maxCoeff(), tolerance);
      EXPECT_LE((copula->log_cdf(u) - u.log().rowwise().sum()).abs().maxCoeff(), tolerance + 1e-12);
      EXPECT_LE((copula->h(u) - last).abs().maxCoeff(), tolerance);
      EXPECT_LE((copula->h_inv(u) - last).abs().maxCoeff(), tolerance);
    }
  }
}

TEST_P(Dependence, SampleHasItsTau) {
  constexpr Index kBatches = 100, kDraws = 400;
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    for (int k = 1; k < next.dim; ++k) {
      Column tau(kBatches);
      for (double& estimate : tau) {
        const Points u = copula->sample(kDraws, rng);
        estimate = kendall_tau(u.col(0), u.col(k));
      }
      const double standard_error = std::sqrt((tau - tau.mean()).square().sum() / (kBatches - 1) / kBatches);
      EXPECT_NEAR(tau.mean(), next.tau(), 4 * standard_error) << k;
    }
  }
}

}  // namespace
}  // namespace sklar::test
