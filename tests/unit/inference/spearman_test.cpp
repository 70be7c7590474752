#include "copula/inference/spearman.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

#include "tests/support/family_cases.hpp"

namespace sklar {
namespace {

constexpr double kRho = 1e-10;

double frank_debye(int n, double x) {
  const auto integrand = [n](double t) { return std::pow(t, n) / std::expm1(t); };
  return n / std::pow(x, n) *
         boost::math::quadrature::gauss_kronrod<double, 61>::integrate(integrand, 0.0, x, 15, 1e-14);
}

TEST(Spearman, ClosedForms) {
  // Frank: 1 - 12/theta (D_1 - D_2), Nelsen (2006), exercise 5.9.
  for (const double theta : {0.1, 2.0, 10.0, 35.0}) {
    const double expected = 1 - 12 / theta * (frank_debye(1, theta) - frank_debye(2, theta));
    EXPECT_NEAR(spearman_rho(*families::find("frank").make(2, {theta})), expected, kRho) << theta;
    EXPECT_NEAR(spearman_rho(*families::find("frank").make(2, {-theta})), -expected, kRho) << theta;
  }
  // Ali-Mikhail-Haq at theta = -1: 33 - 48 log 2, Nelsen (2006), p. 172.
  EXPECT_NEAR(spearman_rho(*families::find("amh").make(2, {-1.0})), 33 - 48 * std::log(2.0), kRho);
  // Clayton with a bounded support, by quadrature in 20 digits of (u^-theta + v^-theta - 1)^(-1/theta).
  EXPECT_NEAR(spearman_rho(*families::find("clayton").make(2, {-0.3})), -0.25986034054290760927, kRho);
  EXPECT_NEAR(spearman_rho(*families::find("clayton").make(2, {-0.8})), -0.79246829989067246605, kRho);
  // Clayton at the lower bound is countermonotone.
  EXPECT_NEAR(spearman_rho(*families::find("clayton").make(2, {-1.0})), -1, kRho);
  EXPECT_NEAR(spearman_rho(*families::find("independence").make(3, {})), 0, kRho);
}

TEST(Spearman, ThetaFromRhoInvertsIt) {
  for (const test::FamilyCase& next : test::family_cases({2})) {
    if (next.theta.size() != 1 || std::abs(next.tau()) > 0.95) continue;
    const double rho = spearman_rho(*next.copula());
    const Theta theta = theta_from_rho(*next.family, 2, rho);
    EXPECT_NEAR(next.family->tau(theta), next.tau(), 10 * kRho) << next.name();
  }
}

TEST(Spearman, TailsDetermineTheta) {
  EXPECT_NEAR(theta_from_lower_tail(families::find("clayton"), 2, std::sqrt(0.5))[0], 2, 1e-11);
  EXPECT_NEAR(theta_from_upper_tail(families::find("gumbel"), 3, 2 - std::sqrt(2.0))[0], 2, 1e-11);
  EXPECT_NEAR(theta_from_upper_tail(families::find("joe"), 2, 2 - std::sqrt(2.0))[0], 2, 1e-11);
}

TEST(Spearman, RefusesWhatIsNotAttainable) {
  EXPECT_THROW((void)theta_from_rho(families::find("gumbel"), 2, -0.2), std::domain_error);
  EXPECT_THROW((void)theta_from_upper_tail(families::find("clayton"), 2, 0.2), std::domain_error);
  EXPECT_THROW((void)theta_from_rho(families::find("independence"), 2, 0.2), std::invalid_argument);
}

}  // namespace
}  // namespace sklar
