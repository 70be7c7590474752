#include "examples/cli/pass_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace sklar::cli {
namespace {

Verdict verdict(Rule rule, double value, const std::string& expected) {
  return judge(rule, value, parse_expected(expected).value());
}

TEST(PassRule, LogarithmIsAbsoluteBelowOneAndRelativeAbove) {
  EXPECT_TRUE(verdict(Rule::logarithm, 1e-3 + 0.9e-13, "1e-3").passes());
  EXPECT_FALSE(verdict(Rule::logarithm, 1e-3 + 1.1e-13, "1e-3").passes());
  EXPECT_TRUE(verdict(Rule::logarithm, -1000 + 0.9e-10, "-1.000e3").passes());
  EXPECT_FALSE(verdict(Rule::logarithm, -1000 + 1.1e-10, "-1.000e3").passes());
  EXPECT_EQ(verdict(Rule::logarithm, -INFINITY, "-inf").error, 0);
  EXPECT_FALSE(verdict(Rule::logarithm, std::nan(""), "1").passes());
}

TEST(PassRule, ProbabilityIsRelativeWithRoomForTheLogarithm) {
  EXPECT_TRUE(verdict(Rule::probability, 0.5 * (1 + 0.9e-13), "0.5").passes());
  EXPECT_FALSE(verdict(Rule::probability, 0.5 * (1 + 1.1e-13), "0.5").passes());
  const double factor = std::log(1e300) / 20;
  EXPECT_TRUE(verdict(Rule::probability, 1e-300 * (1 + 0.9e-13 * factor), "1e-300").passes());
  EXPECT_FALSE(verdict(Rule::probability, 1e-300 * (1 + 1.1e-13 * factor), "1e-300").passes());
  EXPECT_FALSE(verdict(Rule::probability, -0.5, "0.5").passes());
  EXPECT_FALSE(verdict(Rule::probability, 0, "0.5").passes());
}

TEST(PassRule, ProbabilityBelowTheNormalDoublesIsTheNearestButOne) {
  const double smallest = std::numeric_limits<double>::denorm_min();
  EXPECT_TRUE(verdict(Rule::probability, 0, "1.310677292093550227702747e-401").passes());
  EXPECT_TRUE(verdict(Rule::probability, 0, "1e-300300").passes());
  EXPECT_FALSE(verdict(Rule::probability, smallest, "1e-300300").passes());
  EXPECT_TRUE(verdict(Rule::probability, 6.901797771575729968621495e-310, "6.901797771575729968621495e-310").passes());
  EXPECT_FALSE(
      verdict(Rule::probability, 6.901797771575729968621495e-310 + 2 * smallest, "6.901797771575729968621495e-310")
          .passes());
}

TEST(PassRule, InverseIsRelative) {
  EXPECT_TRUE(verdict(Rule::inverse, 1e-20 * (1 + 0.9e-12), "1.0e-20").passes());
  EXPECT_FALSE(verdict(Rule::inverse, 1e-20 * (1 + 1.1e-12), "1.0e-20").passes());
  EXPECT_TRUE(is_best_double(0.5, 0.25, 0.25 + 4e-16, 1.0));
  EXPECT_FALSE(is_best_double(0.5, 0.25, 0.25 + 4e-15, 1.0));
}

TEST(PassRule, TheLogarithmOfAReferenceSurvivesUnderflow) {
  EXPECT_NEAR(static_cast<double>(parse_expected("1.000010010050225650415275e-300300")->log_value),
              -300300 * std::log(10.0) + 1.001e-5, 1e-9);
  EXPECT_EQ(parse_expected("0")->log_value, -std::numeric_limits<long double>::infinity());
  EXPECT_FALSE(parse_expected("1e-3x"));
  EXPECT_FALSE(parse_expected(""));
}

}  // namespace
}  // namespace sklar::cli
