#include "copula/inference/joint_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "copula/inference/joint.hpp"
#include "families/registry.hpp"
#include "tests/support/message.hpp"

namespace sklar {
namespace {

constexpr MarginSpec kNormal{.kind = MarginKind::normal};
constexpr MarginSpec kGamma{.kind = MarginKind::gamma};
constexpr MarginSpec kRanks{.kind = MarginKind::empirical};

/// n rows of a family with margins.
Points sample_of(const std::string& family, const Theta& theta, const std::vector<StoredMarginal>& margins, Index n,
                 std::uint64_t seed) {
  std::vector<std::shared_ptr<const Marginal>> shared(margins.size());
  std::transform(margins.begin(), margins.end(), shared.begin(), share);
  const auto dim = static_cast<int>(margins.size());
  Rng rng(seed);
  return JointDistribution(std::move(shared), families::find(family).make(dim, theta)).sample(n, rng);
}

JointFit two_steps(const std::string& family, const std::vector<MarginSpec>& specs, const Points& x) {
  std::vector<MarginFit> margins = fit_margins(specs, x);
  const FitResult copula = fit_maximum_likelihood(families::find(family), uniforms_of(margins, x));
  return two_step_fit(std::move(margins), copula, static_cast<double>(x.rows()));
}

std::vector<double> parameters_of(const JointFit& fit) {
  std::vector<double> all;
  for (const MarginFit& margin : fit.margins) {
    all.insert(all.end(), margin.parameters.begin(), margin.parameters.end());
  }
  all.insert(all.end(), fit.copula.theta.begin(), fit.copula.theta.end());
  return all;
}

std::vector<double> errors_of(const JointFit& fit) {
  std::vector<double> all;
  for (const MarginFit& margin : fit.margins) {
    all.insert(all.end(), margin.standard_error.begin(), margin.standard_error.end());
  }
  all.insert(all.end(), fit.copula.standard_error.begin(), fit.copula.standard_error.end());
  return all;
}

TEST(JointFit, TwoStepsAddUp) {
  const Points x = sample_of("frank", {4}, {NormalMarginal(1, 2), GammaMarginal(2, 3)}, 200, 1);
  const JointFit fit = two_steps("frank", {kNormal, kGamma}, x);
  const double total = fit.margins[0].log_likelihood + fit.margins[1].log_likelihood + fit.copula.log_likelihood;
  EXPECT_DOUBLE_EQ(fit.log_likelihood, total);
  EXPECT_DOUBLE_EQ(fit.aic, 2 * 5 - 2 * total);
  EXPECT_DOUBLE_EQ(fit.bic, 5 * std::log(200) - 2 * total);
  const JointDensity joint({density_of(fit.margins[0].margin), density_of(fit.margins[1].margin)},
                           families::find("frank").make(2, fit.copula.theta));
  EXPECT_NEAR(joint.log_pdf(x).sum(), total, 1e-10);
  EXPECT_TRUE(std::isnan(two_steps("frank", {kNormal, kRanks}, x).aic));
}

// Without dependence the margins are their own likelihood: closed forms.
TEST(JointFit, IndependenceLeavesTheMargins) {
  constexpr double kSearch = 1e-4;  // of a standard error
  const Points x = sample_of("independence", {}, {NormalMarginal(1, 2), NormalMarginal(5, 0.1)}, 100, 2);
  const JointFit start = two_steps("independence", {kNormal, kNormal}, x);
  const JointFit fit = fit_together(families::find("independence"), start, x);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(parameters_of(fit)[i], parameters_of(start)[i], kSearch * errors_of(start)[i]) << i;
    EXPECT_NEAR(errors_of(fit)[i] / errors_of(start)[i], 1, 1e-3) << i;
  }
  EXPECT_NEAR(fit.log_likelihood, start.log_likelihood, 1e-6);
}

// The errors again from second differences by the parameters themselves, with steps of another length.
TEST(JointFit, StandardErrorsAreThoseOfTheJointInformation) {
  const Points x = sample_of("clayton", {2}, {NormalMarginal(1, 2), GammaMarginal(2, 3)}, 300, 3);
  const FamilyInfo& clayton = families::find("clayton");
  const JointFit fit = fit_together(clayton, two_steps("clayton", {kNormal, kGamma}, x), x);
  ASSERT_EQ(fit.copula.status, FitStatus::converged) << fit.copula.message;
  const std::vector<double> best = parameters_of(fit), errors = errors_of(fit);
  const auto likelihood = [&](const std::vector<double>& p) {
    const JointDensity joint(
        {std::make_shared<NormalMarginal>(p[0], p[1]), std::make_shared<GammaMarginal>(p[2], p[3])},
        clayton.make(2, {p[4]}));
    return joint.log_pdf(x).sum();
  };
  const double top = likelihood(best);
  EXPECT_NEAR(fit.log_likelihood, top, 1e-9 * std::abs(top));
  Eigen::MatrixXd information(5, 5);
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      const auto at = [&](double step_i, double step_j) {
        std::vector<double> moved = best;
        moved[static_cast<std::size_t>(i)] += step_i * errors[static_cast<std::size_t>(i)];
        moved[static_cast<std::size_t>(j)] += step_j * errors[static_cast<std::size_t>(j)];
        return likelihood(moved);
      };
      constexpr double h = 0.02;
      information(i, j) = -(at(h, h) - at(h, -h) - at(-h, h) + at(-h, -h)) / (4 * h * h);
    }
    EXPECT_LT(likelihood([&] {
                std::vector<double> moved = best;
                moved[static_cast<std::size_t>(i)] += 0.05 * errors[static_cast<std::size_t>(i)];
                return moved;
              }()),
              top);
  }
  const Eigen::MatrixXd covariance = information.inverse();
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(covariance(i, i), 1, 0.01) << i;
}

// Of a mean itself, of a positive parameter the logarithm, of Clayton's theta atanh(theta / (theta + 2)).
TEST(JointFit, CovarianceIsThatOfTheStandardErrors) {
  constexpr double kSlopes = 1e-3;  ///< relative: the errors come by differences
  const Points x = sample_of("clayton", {2}, {NormalMarginal(1, 2), GammaMarginal(2, 3)}, 100, 3);
  const JointFit start = two_steps("clayton", {kNormal, kGamma}, x);
  EXPECT_FALSE(start.together);
  EXPECT_EQ(start.covariance.size(), 0);
  const JointFit fit = fit_together(families::find("clayton"), start, x);
  ASSERT_TRUE(fit.together);
  const double theta = fit.copula.theta[0];
  const std::vector<double> p = parameters_of(fit), errors = errors_of(fit);
  const std::vector<double> slopes = {1, p[1], p[2], p[3], 2 * (theta + 1)};
  ASSERT_EQ(fit.covariance.rows(), 5);
  for (std::size_t i = 0; i < 5; ++i) {
    const auto entry = static_cast<Index>(i);
    EXPECT_NEAR(slopes[i] * std::sqrt(fit.covariance(entry, entry)) / errors[i], 1, kSlopes) << i;
  }
}

TEST(JointFit, RecoversWhatItWasDrawnFromAndGainsOnTwoSteps) {
  const std::vector<double> truth = {-1, 3, 1.5, 2, 1.8};
  const Points x = sample_of("gumbel", {1.8}, {NormalMarginal(-1, 3), GammaMarginal(1.5, 2)}, 800, 4);
  const JointFit start = two_steps("gumbel", {kNormal, kGamma}, x);
  const JointFit fit = fit_together(families::find("gumbel"), start, x);
  EXPECT_GT(fit.log_likelihood, start.log_likelihood);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LE(std::abs(parameters_of(fit)[i] - truth[i]), 4 * errors_of(fit)[i]) << i;
  }
}

TEST(JointFit, NeedsParametersInEveryMargin) {
  const Points x = sample_of("frank", {4}, {NormalMarginal(1, 2), NormalMarginal(1, 2)}, 50, 5);
  const auto refusal = [&](const std::vector<MarginSpec>& specs) {
    return test::message_of<std::invalid_argument>(
        [&] { (void)fit_together(families::find("frank"), two_steps("frank", specs, x), x); });
  };
  EXPECT_EQ(refusal({kNormal, kRanks}), "fit_together: margins must be normal, gamma or beta, got empirical");
  EXPECT_EQ(refusal({kNormal}), "fit_margins: 2 columns need as many margins, got 1");
}

}  // namespace
}  // namespace sklar
