#include "copula/study/tradeoff.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "copula/study/timing.hpp"
#include "copula/tolerance.hpp"
#include "families/registry.hpp"

namespace sklar {
namespace {

std::vector<BigFloat> big(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

TEST(ValueErrors, AreRelativeAndOfLogarithmsAbsoluteBelowOne) {
  const std::vector<BigFloat> exact = big({0.5, 4, -8});
  const std::vector<BigFloat> values = big({0.25, 5, -8});
  const ValueErrors relative = value_errors(ErrorMeasure::relative, values, exact);
  EXPECT_EQ(relative.maximum, 0.5);
  EXPECT_EQ(relative.median, 0.25);
  const ValueErrors logarithm = value_errors(ErrorMeasure::logarithm, values, exact);
  EXPECT_EQ(logarithm.maximum, 0.25);
  EXPECT_EQ(logarithm.median, 0.25);
}

TEST(ValueErrors, HoldDigitsBeyondADouble) {
  const WorkingPrecision precision(80);
  const std::vector<BigFloat> exact{BigFloat(1) / BigFloat(3)};
  const std::vector<BigFloat> values{exact[0] + BigFloat("1e-60")};
  const double error = value_errors(ErrorMeasure::relative, values, exact).maximum;
  EXPECT_NEAR(error / 3e-60, 1, 1e-12);
}

TEST(ValueErrors, InfinitiesAndNanCount) {
  const double inf = std::numeric_limits<double>::infinity();
  const auto error = [](double value, double exact) {
    return value_errors(ErrorMeasure::logarithm, big({value}), big({exact})).maximum;
  };
  EXPECT_EQ(error(-inf, -inf), 0);
  EXPECT_EQ(error(-inf, 1), inf);
  EXPECT_EQ(error(std::nan(""), 1), inf);
  EXPECT_EQ(value_errors(ErrorMeasure::relative, big({1e-300}), big({0})).maximum, inf);
}

TEST(Timing, IsThatOfOneCall) {
  int calls = 0;
  const double seconds = seconds_per_call([&] { ++calls; });
  EXPECT_GT(calls, 100);
  EXPECT_GT(seconds, 0);
  EXPECT_LE(seconds * calls, 0.11);  // of the tenth of a second for all of them
}

TEST(MediumTheta, HasAMediumTau) {
  for (const FamilyInfo& family : families::all()) {
    if (family.parameters.empty()) continue;
    const double highest = family.tau_range(2).highest;
    const double expected = highest > 0.5 ? 0.5 : 0.75 * highest;
    EXPECT_NEAR(family.tau(medium_theta(family, 2)), expected, 1e-9) << family.name;
  }
  EXPECT_EQ(medium_theta(families::find("independence"), 2), Theta());
  FamilyInfo family = families::find("frank");  // as one whose tau has no inverse
  family.theta_from_tau = {};
  family.examples = {{30}, {1}, {3}, {-1}};
  EXPECT_EQ(medium_theta(family, 2), Theta{3});
  EXPECT_EQ(medium_theta(family, 3), Theta{3});
}

TEST(Tradeoff, EveryLevelKeepsItsAccuracy) {
  const auto bound = [](const std::string& level) {
    if (level == "fast") return kFastTolerance;
    return level == "exact" ? 1e-30 : 1e-13;
  };
  for (const std::string name : {"clayton", "clayton@180"}) {
    const std::vector<TradeoffRow> rows = measure_tradeoff(families::find(name), {.dim = 3, .rows = 20, .digits = 30});
    ASSERT_EQ(rows.size(), 12u);
    for (const TradeoffRow& row : rows) {
      EXPECT_EQ(row.family, name);
      EXPECT_GT(row.ns, 0) << row.level;
      EXPECT_LE(row.errors.median, row.errors.maximum);
      EXPECT_LE(row.errors.maximum, bound(row.level)) << name << " " << row.quantity << row.level;
    }
    EXPECT_NE(rows[1].errors.maximum, rows[2].errors.maximum) << "the formula goes another way";
  }
}

TEST(Tradeoff, RefusesWhatCannotBeMeasured) {
  EXPECT_THROW((void)measure_tradeoff(families::find("frank"), {.dim = 1}), std::invalid_argument);
  EXPECT_THROW((void)measure_tradeoff(families::find("frank"), {.rows = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace sklar
