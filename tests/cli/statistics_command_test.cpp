/// `sklar copula test` and intervals in `sklar copula fit`.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

/// Eighty points of a Clayton copula.
class Statistics : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    ASSERT_EQ(run("copula sample --family clayton --tau 0.5 -n 80 -o clayton.csv").status, 0);
  }
};

using CopulaTest = Statistics;

TEST_F(CopulaTest, PrintsStatisticAndPValue) {
  const std::string arguments = "copula test clayton.csv --replicates 99 --family ";
  const auto right = nlohmann::json::parse(run(arguments + "clayton --json").out);
  EXPECT_GT(right["p_value"], 0.05);
  EXPECT_EQ(right["replicates"], 99);
  const auto wrong = nlohmann::json::parse(run(arguments + "gumbel --json --statistic rosenblatt").out);
  EXPECT_EQ(wrong["statistic"], "rosenblatt");
  EXPECT_LT(wrong["p_value"], 0.05);
  const Result csv = run(arguments + "clayton --method tau");
  EXPECT_TRUE(
      csv.out.starts_with("family,method,theta,tau,statistic,value,p_value,p_error,replicates,failed,tied\n"
                          "clayton,tau,"))
      << csv.out;
  EXPECT_EQ(csv.err, "");
}

TEST_F(CopulaTest, DependsOnTheSeedAloneNotOnThreads) {
  const std::string arguments =
      "copula test clayton.csv --family clayton --statistic rosenblatt --replicates 60 --seed ";
  const Result one = run(arguments + "3 --threads 1");
  EXPECT_EQ(one.out, run(arguments + "3 --threads 4").out);
  EXPECT_NE(one.out, run(arguments + "4 --threads 4").out);
}

TEST_F(CopulaTest, WarnsOfTiesAndRefusesBadInput) {
  write("tied.csv", "a,b\n1,2\n1,3\n2,5\n4,4\n5,6\n");
  const Result tied = run("copula test tied.csv --family frank --replicates 9");
  EXPECT_EQ(tied.status, 0);
  EXPECT_TRUE(tied.err.starts_with("warning: 2 values have a tie")) << tied.err;
  write("constant.csv", "a,b\n1,2\n2,2\n3,2\n");
  expect_refused("copula test constant.csv --family frank --method tau -o out.csv", "frank could not be fitted");
  expect_refused("copula test clayton.csv --family frank --replicates 0", "replicates must be 1 or more, got 0");
  expect_refused("copula test missing.csv --family frank", "missing.csv");
  expect_usage_error("copula test clayton.csv");
  expect_usage_error("copula test clayton.csv --family frank --statistic x");
}

using FitIntervals = Statistics;

TEST_F(FitIntervals, AreAddedWhereAskedFor) {
  const std::string arguments = "copula fit clayton.csv --families clayton,independence ";
  const std::string plain = run(arguments).out;
  const std::string header = plain.substr(0, plain.find('\n'));
  const Result wald = run(arguments + "--confidence 0.9");
  EXPECT_TRUE(wald.out.starts_with(header + ",theta_low,theta_high,tau_low,tau_high,interval_se,interval_message\n"))
      << wald.out;
  EXPECT_NE(wald.out.find("the family has no parameters"), std::string::npos) << wald.out;
  const auto intervals = [&](const std::string& options) {
    return nlohmann::json::parse(run(arguments + "--json " + options).out)["families"][0]["intervals"];
  };
  EXPECT_TRUE(intervals("").is_null());
  for (const std::string method : {"wald", "profile", "bootstrap --replicates 99"}) {
    const auto found = intervals("--confidence 0.9 --interval " + method);
    EXPECT_LT(found["tau_low"], 0.5) << method;
    EXPECT_GT(found["tau_high"], 0.5) << method;
  }
  EXPECT_NE(intervals("--confidence 0.9"), intervals("--confidence 0.9 --margins none"));
}

TEST_F(FitIntervals, RefuseWhatTheyCannotDo) {
  expect_refused("copula fit clayton.csv --confidence 1", "confidence must be in (0,1), got 1");
  expect_refused("copula fit clayton.csv --confidence 0.99 --interval bootstrap --replicates 100",
                 "need 199 fitted replicates or more, got 100");
  expect_usage_error("copula fit clayton.csv --interval wald");
}

}  // namespace
}  // namespace sklar::cli
