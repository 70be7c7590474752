#include "copula/inference/goodness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "copula/inference/dependence.hpp"
#include "families/registry.hpp"
#include "tests/support/chi_square.hpp"
#include "tests/support/message.hpp"

namespace sklar {
namespace {

constexpr double kRounding = 1e-13;  ///< relative, of sums over ten rows

const FamilyInfo& family(std::string_view name) {
  return families::resolve(name);
}

Points simulated(std::string_view name, int dim, double tau, Index n, std::uint64_t seed) {
  Rng rng(seed);
  return family(name).make(dim, family(name).from_tau(dim, tau))->sample(n, rng);
}

/// Three orders of ten rows, over 11.
Points ten_rows() {
  Points ranks(10, 3);
  ranks << 1, 3, 2, 2, 1, 4, 3, 4, 1, 4, 2, 3, 5, 7, 5, 6, 5, 8, 7, 6, 6, 8, 10, 7, 9, 8, 10, 10, 9, 9;
  return ranks / 11;
}

// By a program of its own in decimal arithmetic of 60 digits: C and its conditionals as u^-theta formulas, C_n by
// comparing all pairs, the integral of S_n^(B) cell by cell of the grid that the transforms make.
TEST(GoodnessStatistics, AreThoseOfSixtyDigits) {
  struct Case {
    Index dim;
    double theta, cramer_von_mises, rosenblatt;
  };
  for (const Case& expected : {Case{2, 2, 0.108488615495645934712, 0.0374401527117654213543},
                               Case{2, 0.5, 0.224773879715253428318, 0.0836845026690213986751},
                               Case{3, 2, 0.152736916445388533366, 0.0289360320226156496574},
                               Case{3, 0.5, 0.363568621976822233266, 0.0985881668679077078558}}) {
    const CopulaPtr copula = family("clayton").make(static_cast<int>(expected.dim), {expected.theta});
    const Points u = ten_rows().leftCols(expected.dim);
    EXPECT_NEAR(cramer_von_mises(*copula, u), expected.cramer_von_mises, kRounding * expected.cramer_von_mises);
    // Terms of the size of n cancel.
    EXPECT_NEAR(rosenblatt_distance(*copula, u), expected.rosenblatt, kRounding * 10);
  }
}

TEST(GoodnessStatistics, CountTiedRowsAsTheDefinitionDoes) {
  Points u = (simulated("frank", 3, 0.3, 150, 5) * 20).ceil() / 21;
  const CopulaPtr copula = family("frank").make(3, {2});
  const Column cdf = copula->cdf(u);
  double sum = 0;
  for (Index i = 0; i < u.rows(); ++i) {
    Index below = 0;
    for (Index j = 0; j < u.rows(); ++j) below += (u.row(j) <= u.row(i)).all() ? 1 : 0;
    sum += std::pow(static_cast<double>(below) / 150 - cdf[i], 2);
  }
  EXPECT_NEAR(cramer_von_mises(*copula, u), sum, kRounding * sum);
}

TEST(GoodnessStatistics, RefuseWhatIsNotInTheCube) {
  const CopulaPtr copula = family("frank").make(2, {2});
  for (const auto statistic : {cramer_von_mises, rosenblatt_distance}) {
    EXPECT_THROW((void)statistic(*copula, Points(0, 2)), std::invalid_argument);
    EXPECT_THROW((void)statistic(*copula, Points::Constant(3, 3, 0.5)), std::invalid_argument);
    EXPECT_THROW((void)statistic(*copula, Points::Constant(3, 2, 1.5)), std::domain_error);
    EXPECT_THROW((void)statistic(*copula, Points::Constant(3, 2, std::nan(""))), std::domain_error);
  }
}

GoodnessOptions quick(GoodnessStatistic statistic, int replicates, std::uint64_t seed) {
  return {.statistic = statistic, .bootstrap = {.replicates = replicates, .seed = seed}};
}

class GoodnessTest : public testing::TestWithParam<GoodnessStatistic> {};

// Where the family is right, p takes its N + 1 values equally often.
TEST_P(GoodnessTest, HasUniformPValuesUnderTheNullHypothesis) {
  constexpr int kReplicates = 9, kSamples = 600, kTests = 2;
  std::vector<double> counts(kReplicates + 1);
  for (int sample = 0; sample < kSamples; ++sample) {
    const std::uint64_t seed = test::seed_of_this_test() + static_cast<std::uint64_t>(sample);
    const Points x = simulated("clayton", 2, 0.4, 60, seed);
    const GoodnessResult result = test_goodness(family("clayton"), x, quick(GetParam(), kReplicates, seed));
    ASSERT_EQ(result.replicates, kReplicates);
    ++counts.at(static_cast<std::size_t>(std::lround(result.p_value * (kReplicates + 1)) - 1));
  }
  const std::vector<double> expected(counts.size(), static_cast<double>(kSamples) / (kReplicates + 1));
  test::expect_chi_square(counts, expected, kTests, "p-values");
}

TEST_P(GoodnessTest, RejectsAnotherFamily) {
  for (const int dim : {2, 3}) {
    const Points x = simulated("clayton", dim, 0.5, 200, 7);
    const GoodnessResult wrong = test_goodness(family("gumbel"), x, quick(GetParam(), 99, 1));
    EXPECT_EQ(wrong.p_value, 0.01) << dim;
    EXPECT_NEAR(wrong.p_error, std::sqrt(0.01 * 0.99 / 99), 1e-15);
    EXPECT_GT(test_goodness(family("clayton"), x, quick(GetParam(), 99, 1)).p_value, 0.05) << dim;
  }
}

/// 10, or $SKLAR_SAMPLES: docs/statistics.md.
int samples() {
  const char* given = std::getenv("SKLAR_SAMPLES");
  return given != nullptr ? std::atoi(given) : 10;
}

// Of samples of 150 rows, tau 0.5, the share that a test at 0.05 rejects. Prints it.
TEST_P(GoodnessTest, KeepsItsLevelAndRejectsOtherTails) {
  constexpr int kReplicates = 99;
  constexpr double kLevel = 0.05, kStandardErrors = 4;
  const int n = samples();
  for (const std::string drawn : {"clayton", "gumbel", "frank"}) {
    for (const std::string tested : {"clayton", "gumbel", "frank"}) {
      int rejected = 0;
      for (int sample = 0; sample < n; ++sample) {
        const std::uint64_t seed = test::seed_of_this_test() + static_cast<std::uint64_t>(sample);
        const Points x = simulated(drawn, 2, 0.5, 150, seed);
        const double p = test_goodness(family(tested), x, quick(GetParam(), kReplicates, seed)).p_value;
        rejected += p <= kLevel ? 1 : 0;
      }
      const double share = static_cast<double>(rejected) / n;
      std::cout << drawn << " tested as " << tested << ": " << 100 * share << " % of " << n << " rejected\n";
      const double chance = kStandardErrors * std::sqrt(kLevel * (1 - kLevel) / n);
      if (drawn == tested) {
        EXPECT_LE(share, kLevel + chance) << drawn;
      } else if (drawn != "frank" && tested != "frank") {
        EXPECT_GT(share, 0.8) << drawn << tested;
      }
    }
  }
}

TEST_P(GoodnessTest, SeesRanksAloneAndIsReproducible) {
  const Points x = simulated("frank", 2, 0.3, 80, 3);
  const GoodnessResult first = test_goodness(family("frank"), x, quick(GetParam(), 50, 4));
  const GoodnessResult again = test_goodness(family("frank"), (5 * x).exp(), quick(GetParam(), 50, 4));
  EXPECT_EQ(first.statistic, again.statistic);
  EXPECT_EQ(first.p_value, again.p_value);
  EXPECT_EQ(first.tied, 0);
  EXPECT_NE(first.p_value, test_goodness(family("frank"), x, quick(GetParam(), 50, 5)).p_value);
}

INSTANTIATE_TEST_SUITE_P(Both, GoodnessTest,
                         testing::Values(GoodnessStatistic::cramer_von_mises, GoodnessStatistic::rosenblatt),
                         [](const auto& one) { return std::string(to_text(one.param)); });

TEST(Goodness, TakesKnownMarginsAndOtherMethods) {
  const Points u = simulated("gumbel", 2, 0.4, 150, 9);
  for (const FitMethod method : {FitMethod::tau_inversion, FitMethod::maximum_likelihood}) {
    for (const bool ranks : {false, true}) {
      const GoodnessOptions options{.method = method, .ranks = ranks, .bootstrap = {.replicates = 49}};
      const GoodnessResult result = test_goodness(family("gumbel"), u, options);
      EXPECT_EQ(result.fit.method, method);
      EXPECT_EQ(result.fit.theta, fit(family("gumbel"), method, ranks ? pseudo_observations(u) : u).theta);
      EXPECT_GT(result.p_value, 0.02);
    }
  }
  EXPECT_THROW((void)test_goodness(family("gumbel"), 3 * u, {.ranks = false}), std::domain_error);
}

TEST(Goodness, SaysWhatItCannotDo) {
  Points x = simulated("frank", 2, 0.3, 30, 3);
  EXPECT_THROW((void)test_goodness(family("frank"), x, {.bootstrap = {.replicates = 0}}), std::invalid_argument);
  x.col(1) = 1;
  const GoodnessResult result = test_goodness(family("frank"), x, {.method = FitMethod::tau_inversion});
  EXPECT_EQ(result.fit.status, FitStatus::failed);
  EXPECT_TRUE(std::isnan(result.p_value));
  EXPECT_EQ(result.tied, 30);
}

TEST(Bootstrap, TellsItsProgressAndIsInterrupted) {
  const CopulaPtr copula = family("frank").make(2, {2});
  std::vector<double> shares;
  const auto nothing = [](int, const Points&) {};
  for_each_replicate(*copula, 5, {.replicates = 4, .progress = [&](double share) { shares.push_back(share); }},
                     nothing);
  EXPECT_EQ(shares, (std::vector<double>{0.25, 0.5, 0.75, 1}));
  const BootstrapOptions stop{.progress = [](double) { throw std::runtime_error("stop"); }};
  EXPECT_EQ(test::message_of<std::runtime_error>([&] { for_each_replicate(*copula, 5, stop, nothing); }), "stop");
}

TEST(Bootstrap, DrawsAnotherSampleForEveryReplicateAndSeed) {
  const CopulaPtr copula = family("frank").make(2, {2});
  std::vector<double> first(20);
  for (const std::uint64_t seed : {1, 2}) {
    for_each_replicate(*copula, 1, {.replicates = 10, .seed = seed}, [&](int replicate, const Points& u) {
      first[10 * (seed - 1) + static_cast<std::size_t>(replicate)] = u(0, 0);
    });
  }
  std::ranges::sort(first);
  EXPECT_EQ(std::ranges::adjacent_find(first), first.end());
}

}  // namespace
}  // namespace sklar
