#include "copula/inference/intervals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "copula/inference/dependence.hpp"
#include "families/registry.hpp"
#include "tests/support/message.hpp"

namespace sklar {
namespace {

const FamilyInfo& family(std::string_view name) {
  return families::resolve(name);
}

Points simulated(const FamilyInfo& family, int dim, double tau, Index n, std::uint64_t seed) {
  Rng rng(seed);
  return family.make(dim, family.from_tau(dim, tau))->sample(n, rng);
}

constexpr int kSamples = 1000;
constexpr double kConfidence = 0.9;
constexpr double kStandardErrors = 4;  ///< a seeded simulation may be off by this many
const double kChance = kStandardErrors * std::sqrt(kConfidence * (1 - kConfidence) / kSamples);

/// Two orders of ten rows, over 11.
Points ten_rows() {
  Points ranks(10, 2);
  ranks << 1, 3, 2, 1, 3, 4, 4, 2, 5, 7, 6, 5, 7, 6, 8, 10, 9, 8, 10, 9;
  return ranks / 11;
}

void expect_interval(const Interval& found, double lowest, double highest, double tolerance) {
  EXPECT_NEAR(found.lowest, lowest, tolerance * std::abs(lowest));
  EXPECT_NEAR(found.highest, highest, tolerance * std::abs(highest));
}

// By a program of its own in decimal arithmetic of 60 digits: theta by Newton's method, derivatives by differences of
// 1e-12, the sums of Genest, Ghoudi and Rivest over all pairs of rows, the ends of the profile by bisection.
TEST(Intervals, AreThoseOfSixtyDigits) {
  constexpr double kDifferences = 1e-5;  ///< relative: central differences with steps of 1e-3
  constexpr double kProfile = 1e-6;      ///< they enter by the factor of the ranks alone
  constexpr double kSearch = 1e-7;       ///< the tolerance of the fit
  struct Case {
    bool ranks;
    double error;
    Interval wald, wald_tau, profile;
  };
  const Case known{false,
                   0.957606081447579177476,
                   {0.942852771111249604726, 4.89210251870668701679},
                   {0.320387339919563594030, 0.709812790136020366964},
                   {0.723693219648890776557, 4.57054102915454366972}};
  const Case ranked{true,
                    0.891230696789394436623,
                    {1.01901086669669579388, 4.66984947677379166748},
                    {0.337531367620304255560, 0.700143158108059637670},
                    {0.828676152050468231703, 4.39720168254291178841}};
  const Points u = ten_rows();
  const FitResult fitted = fit_maximum_likelihood(family("clayton"), u);
  EXPECT_NEAR(fitted.theta[0], 2.38341361736055857635, 10 * kSearch);
  for (const Case& expected : {known, ranked}) {
    const auto wald = confidence_intervals(family("clayton"), fitted, u, Column(), {.ranks = expected.ranks});
    EXPECT_NEAR(wald.standard_error[0], expected.error, kDifferences * expected.error);
    expect_interval(wald.theta[0], expected.wald.lowest, expected.wald.highest, kDifferences);
    expect_interval(wald.tau, expected.wald_tau.lowest, expected.wald_tau.highest, kDifferences);
    const auto profile = confidence_intervals(family("clayton"), fitted, u, Column(),
                                              {.method = IntervalMethod::profile, .ranks = expected.ranks});
    expect_interval(profile.theta[0], expected.profile.lowest, expected.profile.highest,
                    expected.ranks ? kDifferences : kProfile);
    const auto tau = [](double theta) { return theta / (theta + 2); };
    expect_interval(profile.tau, tau(profile.theta[0].lowest), tau(profile.theta[0].highest), 1e-14);
  }
}

/// The share of samples of 200 rows whose interval for tau covers the true one.
double coverage(const FamilyInfo& family, double tau, const IntervalOptions& options, bool rank_them) {
  int covered = 0;
  for (int sample = 0; sample < kSamples; ++sample) {
    const Points points = simulated(family, 2, tau, 200, 5000 + static_cast<std::uint64_t>(sample));
    const Points u = rank_them ? pseudo_observations(points) : points;
    const auto intervals = confidence_intervals(family, fit_maximum_likelihood(family, u), u, Column(), options);
    if (intervals.tau.contains(tau)) ++covered;
  }
  return static_cast<double>(covered) / kSamples;
}

TEST(Intervals, CoverTheParameterAsOftenAsTheySay) {
  for (const IntervalMethod method : {IntervalMethod::wald, IntervalMethod::profile}) {
    for (const bool ranks : {false, true}) {
      const IntervalOptions options{.method = method, .confidence = kConfidence, .ranks = ranks};
      EXPECT_NEAR(coverage(family("clayton"), 0.5, options, ranks), kConfidence, kChance) << to_text(method) << ranks;
    }
  }
}

TEST(Intervals, CoverTooSeldomWhereTheRanksAreIgnored) {
  const IntervalOptions options{.confidence = kConfidence, .ranks = false};
  EXPECT_LT(coverage(family("clayton"), 0.5, options, true), kConfidence - kChance);
}

TEST(Intervals, OfTheBootstrapHaveTheSpreadOfTheLikelihood) {
  constexpr int kReplicates = 400;
  const Points points = simulated(family("gumbel"), 3, 0.4, 300, 2);
  for (const bool ranks : {false, true}) {
    const Points u = ranks ? pseudo_observations(points) : points;
    const FitResult fitted = fit_maximum_likelihood(family("gumbel"), u);
    IntervalOptions options{.ranks = ranks, .bootstrap = {.replicates = kReplicates}};
    const auto wald = confidence_intervals(family("gumbel"), fitted, u, Column(), options);
    options.method = IntervalMethod::bootstrap;
    const auto bootstrap = confidence_intervals(family("gumbel"), fitted, u, Column(), options);
    EXPECT_NEAR(bootstrap.standard_error[0] / wald.standard_error[0], 1,
                kStandardErrors / std::sqrt(2.0 * kReplicates));
    EXPECT_EQ(bootstrap.failed, 0);
  }
}

TEST(Intervals, OfTheBootstrapAreOrderStatistics) {
  const Points u = pseudo_observations(simulated(family("frank"), 2, 0.3, 60, 4));
  const FitResult fitted = fit_tau_inversion(family("frank"), u);
  const IntervalOptions options{
      .method = IntervalMethod::bootstrap, .confidence = 0.9, .bootstrap = {.replicates = 19, .seed = 6}};
  std::vector<double> thetas(19);
  for_each_replicate(*family("frank").make(2, fitted.theta), 60, options.bootstrap,
                     [&](int replicate, const Points& x) {
                       thetas[static_cast<std::size_t>(replicate)] =
                           fit_tau_inversion(family("frank"), pseudo_observations(x)).theta[0];
                     });
  const Interval found = confidence_intervals(family("frank"), fitted, u, Column(), options).theta[0];
  EXPECT_EQ(found.lowest, std::ranges::min(thetas));
  EXPECT_EQ(found.highest, std::ranges::max(thetas));
}

TEST(Intervals, OfANegativeDependenceAreInOrder) {
  const FamilyInfo& turned = family("gumbel@90");
  const Points u = pseudo_observations(simulated(turned, 2, -0.4, 200, 3));
  for (const IntervalMethod method : {IntervalMethod::wald, IntervalMethod::profile}) {
    const FitResult fitted = fit_maximum_likelihood(turned, u);
    const auto found = confidence_intervals(turned, fitted, u, Column(), {.method = method});
    EXPECT_TRUE(found.tau.contains(fitted.tau) && found.tau.highest < 0) << to_text(method);
    EXPECT_TRUE(found.theta[0].contains(fitted.theta[0]) && found.theta[0].lowest > 1) << to_text(method);
  }
}

constexpr const char* kTwoParameters = R"json({"format": "sklar family", "version": 1, "name": "two", "title": "Two",
  "psi": "(1+t^(1/delta))^(-1/theta)", "source": "Joe 1997, BB1",
  "parameters": [{"name": "theta", "lowest": 0, "lowest_included": false, "highest": "inf"},
                 {"name": "delta", "lowest": 1, "highest": "inf"}], "examples": [[0.5, 1.5]]})json";

/// The largest likelihood over the second parameter, by thirds of its interval.
double profile_likelihood(const FamilyInfo& two, const Points& u, double theta) {
  const auto at = [&](double delta) { return two.make(2, {theta, delta})->log_pdf(u).sum(); };
  double low = 1, high = 4;
  for (int step = 0; step < 40; ++step) {
    const double third = (high - low) / 3;
    if (at(low + third) < at(high - third)) {
      low += third;
    } else {
      high -= third;
    }
  }
  return at(0.5 * (low + high));
}

TEST(Intervals, OfTwoParametersEndWhereTheProfileSays) {
  constexpr double kProfile = 1e-6;
  constexpr double kQuantile = 1.6448536269514722;  // of confidence 0.9
  const FamilyInfo two = families::from_definition(kTwoParameters, "");
  Rng rng(5);
  const Points u = two.make(2, {0.5, 1.5})->sample(300, rng);
  const FitResult fitted = fit_maximum_likelihood(two, u);
  IntervalOptions options{.method = IntervalMethod::profile, .confidence = 0.9, .ranks = false};
  const auto profile = confidence_intervals(two, fitted, u, Column(), options);
  for (const double theta : {profile.theta[0].lowest, profile.theta[0].highest}) {
    const double drop = fitted.log_likelihood - profile_likelihood(two, u, theta);
    EXPECT_NEAR(std::sqrt(2 * drop), kQuantile, kProfile) << theta;
  }
  EXPECT_TRUE(std::isnan(profile.tau.lowest));
  options.method = IntervalMethod::wald;
  const auto wald = confidence_intervals(two, fitted, u, Column(), options);
  for (std::size_t a : {0, 1}) {
    EXPECT_NEAR(wald.standard_error[a], fitted.standard_error[a], 1e-3 * fitted.standard_error[a]);
    EXPECT_TRUE(wald.theta[a].contains(fitted.theta[a]));
  }
  EXPECT_TRUE(wald.tau.contains(fitted.tau));
}

TEST(Intervals, SayWhyThereAreNone) {
  const Points u = pseudo_observations(simulated(family("frank"), 2, 0.3, 60, 4));
  const auto message = [&](const FamilyInfo& of, const FitResult& fitted, const PointsRef& at) {
    const auto none = confidence_intervals(of, fitted, at);
    EXPECT_TRUE(std::isnan(none.tau.lowest));
    return none.message;
  };
  EXPECT_EQ(message(family("frank"), fit_tau_inversion(family("frank"), u), u),
            "wald intervals need a fit by maximum likelihood");
  EXPECT_EQ(message(family("independence"), fit_maximum_likelihood(family("independence"), u), u),
            "the family has no parameters");
  const Points turned = (Points(60, 2) << u.col(0), 1 - u.col(1)).finished();
  const FitResult bound = fit_maximum_likelihood(family("gumbel"), turned);
  EXPECT_EQ(bound.status, FitStatus::at_bound);
  EXPECT_EQ(message(family("gumbel"), bound, turned), bound.message);
}

TEST(Intervals, RefuseOptionsOutOfRange) {
  const Points u = pseudo_observations(simulated(family("frank"), 2, 0.3, 60, 4));
  const FitResult fitted = fit_maximum_likelihood(family("frank"), u);
  const auto refused = [&](const IntervalOptions& options) {
    return test::message_of<std::invalid_argument>(
        [&] { (void)confidence_intervals(family("frank"), fitted, u, Column(), options); });
  };
  for (const double confidence : {0.0, 1.0, std::nan("")}) {
    EXPECT_NE(refused({.confidence = confidence}).find("confidence must be in (0,1)"), std::string::npos);
  }
  EXPECT_NE(refused({.method = IntervalMethod::bootstrap, .bootstrap = {.replicates = 38}}).find("need 39 fitted"),
            std::string::npos);
}

}  // namespace
}  // namespace sklar
