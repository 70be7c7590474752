#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "copula/inference/intervals.hpp"
#include "copula/inference/joint.hpp"
#include "families/registry.hpp"
#include "tests/support/message.hpp"

namespace sklar {
namespace {

constexpr MarginSpec kNormal{.kind = MarginKind::normal};
constexpr MarginSpec kGamma{.kind = MarginKind::gamma};
constexpr MarginSpec kRanks{.kind = MarginKind::empirical};
constexpr double kDifferences = 2e-5;  ///< relative: central differences with steps of 1e-3

const FamilyInfo& clayton() {
  return families::find("clayton");
}

Points ten_rows() {
  Points x(10, 2);
  x << 0.3, 4.1, 1.1, 5.6, -0.4, 3.9, 0.9, 6.4, 2.2, 7.1, 1.6, 5.2, -1.2, 2.8, 0.1, 4.9, 2.9, 7.7, 1.4, 6.8;
  return x;
}

Column counts_of_ten() {
  return (Column(10) << 2, 1, 3, 1, 1, 2, 1, 1, 1, 2).finished();
}

JointFit two_steps(const FamilyInfo& family, const std::vector<MarginSpec>& specs, const Points& x,
                   const Column& weights = Column()) {
  std::vector<MarginFit> margins = fit_margins(specs, x, weights);
  FitResult copula = fit_maximum_likelihood(family, uniforms_of(margins, x, weights), weights);
  const double total = weights.size() > 0 ? weights.sum() : static_cast<double>(x.rows());
  return two_step_fit(std::move(margins), std::move(copula), total);
}

void expect_relative(double found, double expected, double tolerance, const std::string& what) {
  EXPECT_NEAR(found, expected, tolerance * std::abs(expected)) << what;
}

/// Estimates and standard errors in turn of two margins, then of the copula, with its interval of confidence 0.95.
struct Reference {
  std::vector<double> margin_errors;
  double theta, error;
  Interval wald;
};

void expect_reference(const JointFit& fit, const ConfidenceIntervals& found, const Reference& expected,
                      double tolerance, const std::string& what) {
  expect_relative(fit.copula.theta.at(0), expected.theta, 1e-5, what);
  expect_relative(found.standard_error.at(0), expected.error, tolerance, what);
  expect_relative(found.theta.at(0).lowest, expected.wald.lowest, tolerance, what);
  expect_relative(found.theta.at(0).highest, expected.wald.highest, tolerance, what);
  auto next = expected.margin_errors.begin();
  for (const MarginIntervals& margin : found.margins) {
    for (const double error : margin.standard_error) expect_relative(error, *next++, tolerance, what + ", margin");
  }
  EXPECT_EQ(next, expected.margin_errors.end());
}

struct Case {
  std::string what;
  std::vector<MarginSpec> specs;
  Column weights;
  Reference expected;
};

// By a program of its own in decimal arithmetic of 60 digits: the estimates by Newton's method, the stacked inference
// functions of the five parameters and their derivatives by differences of 1e-13, D^-1 M D^-T; with ranks the sums of
// Genest, Ghoudi and Rivest over all pairs of rows.
std::vector<Case> cases_in_two_steps() {
  return {{"normal",
           {kNormal, kNormal},
           Column(),
           {{0.36836123574556538834, 0.2082548482127422522, 0.470584742634097732389, 0.229466677258382571924},
            4.77090589136084500083,
            2.52027505713401199115,
            {1.45192121500763634883, 12.582555019754004549}}},
          {"normal, weights",
           {kNormal, kNormal},
           counts_of_ten(),
           {{0.280919126361227948974, 0.15642579090218061479, 0.36459617437703644996, 0.16936181800388237586},
            4.46670340936497526178,
            1.82618286426167394933,
            {1.84038279720981531298, 9.52141499917522923783}}},
          {"normal and ranks",
           {kNormal, kRanks},
           Column(),
           {{0.36836123574556538834, 0.2082548482127422522},
            3.87851924657852607227,
            1.85330841919907470937,
            {1.31698764249536557409, 9.27193654498945572216}}},
          {"normal and ranks, weights",
           {kNormal, kRanks},
           counts_of_ten(),
           {{0.280919126361227948974, 0.15642579090218061479},
            5.25844775297680031911,
            2.02766749221646774274,
            {2.31655187365529752888, 10.8099067250745691365}}},
          {"ranks, weights",
           {kRanks, kRanks},
           counts_of_ten(),
           {{}, 7.50576939755256313321, 4.22980516248396127056, {2.20938989645825793281, 21.5426375038389384658}}}};
}

TEST(JointIntervals, InTwoStepsAreThoseOfSixtyDigits) {
  for (const Case& one : cases_in_two_steps()) {
    const JointFit fit = two_steps(clayton(), one.specs, ten_rows(), one.weights);
    const auto found = joint_intervals(clayton(), fit, ten_rows(), one.weights);
    expect_reference(fit, found, one.expected, kDifferences, one.what);
    if (!one.what.starts_with("ranks")) continue;
    const auto alone =
        confidence_intervals(clayton(), fit.copula, uniforms_of(fit.margins, ten_rows(), one.weights), one.weights);
    EXPECT_EQ(alone.theta[0].lowest, found.theta[0].lowest);
  }
}

// By the same program: the maximum of the likelihood in five parameters, the inverse of its second differences.
TEST(JointIntervals, TogetherAreThoseOfSixtyDigits) {
  constexpr double kSteps = 2e-3;  ///< relative: second differences over 0.01 standard errors, which ten rows make wide
  const Reference plain{
      {0.359875198025243634443, 0.227770077719209619546, 0.464275405774114892046, 0.298530295077190104536},
      4.74189774366707411899,
      2.31778734071665962918,
      {1.60290026159027487507, 11.6664053115066232624}};
  const Reference weighted{
      {0.283895628955031132679, 0.178209207553793905388, 0.349143307373158057561, 0.22049874362013713409},
      4.66697680354499869066,
      1.8233697043034371221,
      {2.01629869849104994045, 9.64703111398845509501}};
  for (const Column& weights : {Column(), counts_of_ten()}) {
    const JointFit start = two_steps(clayton(), {kNormal, kNormal}, ten_rows(), weights);
    const JointFit fit = fit_together(clayton(), start, ten_rows(), weights);
    expect_reference(fit, joint_intervals(clayton(), fit, ten_rows(), weights), weights.size() > 0 ? weighted : plain,
                     kSteps, "together");
  }
}

/// n rows of a family behind a normal and another margin.
Points sample_of(const FamilyInfo& family, double tau, Index n, std::uint64_t seed,
                 const StoredMarginal& second = GammaMarginal(2, 3)) {
  Rng rng(seed);
  const JointDistribution joint({std::make_shared<NormalMarginal>(1, 2), share(second)},
                                family.make(2, family.from_tau(2, tau)));
  return joint.sample(n, rng);
}

void expect_same(const ConfidenceIntervals& a, const ConfidenceIntervals& b, double tolerance) {
  expect_relative(a.standard_error.at(0), b.standard_error.at(0), tolerance, "standard error");
  expect_relative(a.theta[0].lowest, b.theta[0].lowest, tolerance, "theta");
  expect_relative(a.tau.highest, b.tau.highest, tolerance, "tau");
  ASSERT_EQ(a.margins.size(), b.margins.size());
  for (std::size_t i = 0; i < a.margins.size(); ++i) {
    for (std::size_t k = 0; k < a.margins[i].parameters.size(); ++k) {
      expect_relative(a.margins[i].standard_error[k], b.margins[i].standard_error[k], tolerance, "margin");
      expect_relative(a.margins[i].parameters[k].lowest, b.margins[i].parameters[k].lowest, tolerance, "margin");
    }
  }
}

// The fit of the weighted rows serves both, so that only sums in another order differ.
TEST(JointIntervals, OfWeightsAreThoseOfRepeatedRows) {
  constexpr double kRounding = 1e-8;  ///< relative: of sums, over the square of a step of 1e-3
  const Points x = sample_of(clayton(), 0.4, 60, 11);
  Column weights = Column::Constant(60, 2);
  weights.head(20) = 1;
  weights.tail(5) = 0;
  std::vector<Index> rows;
  for (Index i = 0; i < 60; ++i) rows.insert(rows.end(), static_cast<std::size_t>(weights[i]), i);
  const Points repeated = x(rows, Eigen::all);
  for (const std::vector<MarginSpec>& specs : {std::vector{kNormal, kGamma}, {kRanks, kGamma}, {kRanks, kRanks}}) {
    const JointFit fit = two_steps(clayton(), specs, x, weights);
    for (const IntervalMethod method : {IntervalMethod::wald, IntervalMethod::profile}) {
      expect_same(joint_intervals(clayton(), fit, x, weights, {.method = method}),
                  joint_intervals(clayton(), fit, repeated, Column(), {.method = method}), kRounding);
    }
    const IntervalOptions bootstrap{
        .method = IntervalMethod::bootstrap, .confidence = 0.5, .bootstrap = {.replicates = 19}};
    EXPECT_EQ(joint_intervals(clayton(), fit, x, weights, bootstrap).theta[0].lowest,
              joint_intervals(clayton(), fit, repeated, Column(), bootstrap).theta[0].lowest);
  }
  constexpr double kSearch = 1e-3;  ///< relative: a search of its own each, to 1e-5 standard errors
  const auto together = [&](const Points& data, const Column& counts) {
    const JointFit fit = fit_together(clayton(), two_steps(clayton(), {kNormal, kGamma}, data, counts), data, counts);
    return joint_intervals(clayton(), fit, data, counts);
  };
  expect_same(together(x, weights), together(repeated, Column()), kSearch);
}

// Twice the drop of the likelihood, over q^2, is the ratio of the variances.
TEST(JointIntervals, OfTheProfileEndWhereTheLikelihoodSays) {
  constexpr double kQuantile = 1.9599639845400542;
  const Points x = sample_of(clayton(), 0.4, 200, 12);
  const JointFit fit = two_steps(clayton(), {kNormal, kGamma}, x);
  const auto profile = joint_intervals(clayton(), fit, x, Column(), {.method = IntervalMethod::profile});
  const auto wald = joint_intervals(clayton(), fit, x);
  const Points u = uniforms_of(fit.margins, x);
  const auto likelihood = [&](double theta) { return clayton().make(2, {theta})->log_pdf(u).sum(); };
  const double ratio = std::pow(wald.standard_error[0] / fit.copula.standard_error[0], 2);
  EXPECT_GT(std::abs(ratio - 1), 0.05) << "estimated margins change the spread";
  for (const double end : {profile.theta[0].lowest, profile.theta[0].highest}) {
    const double drop = fit.copula.log_likelihood - likelihood(end);
    expect_relative(2 * drop, kQuantile * kQuantile * ratio, 1e-3, "profile");
  }
  EXPECT_TRUE(profile.margins.empty());
}

TEST(JointIntervals, HaveTheSpreadOfTheBootstrap) {
  constexpr int kReplicates = 200;
  constexpr double kStandardErrors = 4;
  const Points x = sample_of(clayton(), 0.5, 200, 13);
  const JointFit fit = two_steps(clayton(), {kNormal, kGamma}, x);
  IntervalOptions options{.bootstrap = {.replicates = kReplicates}};
  const auto wald = joint_intervals(clayton(), fit, x, Column(), options);
  options.method = IntervalMethod::bootstrap;
  const auto bootstrap = joint_intervals(clayton(), fit, x, Column(), options);
  const double chance = kStandardErrors / std::sqrt(2.0 * kReplicates);
  EXPECT_NEAR(bootstrap.standard_error[0] / wald.standard_error[0], 1, chance);
  for (std::size_t i : {0, 1}) {
    for (std::size_t k : {0, 1}) {
      const double ratio = bootstrap.margins[i].standard_error[k] / wald.margins[i].standard_error[k];
      EXPECT_NEAR(ratio, 1, chance + 0.1) << "of one sample, whose fourth moments the sandwich takes" << i << k;
      EXPECT_TRUE(bootstrap.margins[i].parameters[k].contains(fit.margins[i].parameters[k]));
    }
  }
}

/// 100 of a fit in two steps, 20 of one together, or $SKLAR_SAMPLES: docs/statistics.md.
int samples(bool together) {
  const char* given = std::getenv("SKLAR_SAMPLES");
  return given != nullptr ? std::atoi(given) : together ? 20 : 100;
}

// Of samples of 200 rows, for tau and the standard deviation of the first margin. Prints the shares.
TEST(JointIntervals, CoverTheParametersAsOftenAsTheySay) {
  constexpr double kConfidence = 0.9, kStandardErrors = 4, kTau = 0.5, kDeviation = 2;
  for (const std::string name : {"clayton", "gumbel", "frank"}) {
    const FamilyInfo& family = families::find(name);
    for (const bool together : {false, true}) {
      const int n = samples(together);
      const StoredMarginal second = together ? StoredMarginal(NormalMarginal(5, 1)) : GammaMarginal(2, 3);
      int tau = 0, deviation = 0;
      for (int sample = 0; sample < n; ++sample) {
        const Points x = sample_of(family, kTau, 200, 7000 + static_cast<std::uint64_t>(sample), second);
        JointFit fit = two_steps(family, {kNormal, together ? kNormal : kGamma}, x);
        if (together) fit = fit_together(family, fit, x);
        const auto found = joint_intervals(family, fit, x, Column(), {.confidence = kConfidence});
        tau += found.tau.contains(kTau) ? 1 : 0;
        deviation += found.margins[0].parameters[1].contains(kDeviation) ? 1 : 0;
      }
      const double chance = kStandardErrors * std::sqrt(kConfidence * (1 - kConfidence) / n);
      std::cout << name << (together ? " together" : " in two steps") << ": tau " << 100.0 * tau / n << " %, sd "
                << 100.0 * deviation / n << " % of " << n << '\n';
      EXPECT_NEAR(static_cast<double>(tau) / n, kConfidence, chance) << name << together;
      EXPECT_NEAR(static_cast<double>(deviation) / n, kConfidence, chance) << name << together;
    }
  }
}

TEST(JointIntervals, SayWhatTheyCannotDo) {
  const Points x = sample_of(clayton(), 0.4, 60, 14);
  const JointFit fit = two_steps(clayton(), {kNormal, kGamma}, x);
  const JointFit together = fit_together(clayton(), fit, x);
  EXPECT_EQ(joint_intervals(clayton(), together, x, Column(), {.method = IntervalMethod::profile}).message,
            "a joint fit has wald and bootstrap intervals");
  const JointFit kernel = two_steps(clayton(), {kNormal, {.kind = MarginKind::kernel}}, x);
  const auto refused = [&](const JointFit& of) {
    return test::message_of<std::invalid_argument>([&] { (void)joint_intervals(clayton(), of, x); });
  };
  EXPECT_NE(refused(kernel).find("no intervals with kernel margins"), std::string::npos);
  const JointFit bare = fit_together(clayton(), fit, x, Column(), {.standard_errors = false});
  EXPECT_NE(refused(bare).find("needs FitOptions::standard_errors"), std::string::npos);
  Column weights = Column::Ones(60);
  weights[3] = 0.5;
  const std::string fraction =
      test::message_of<std::domain_error>([&] { (void)joint_intervals(clayton(), fit, x, weights); });
  EXPECT_NE(fraction.find("must be whole numbers, counts of equal rows, got weights(3) = 0.5"), std::string::npos)
      << fraction;
}

}  // namespace
}  // namespace sklar
