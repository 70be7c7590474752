/// `sklar copula test`, intervals in `sklar copula fit`, `sklar copula predict`.

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
  EXPECT_TRUE(tied.err.starts_with("sklar: 2 values have a tie")) << tied.err;
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

TEST_F(FitIntervals, AreThereOfFittedMarginsAndCounts) {
  const std::string arguments = "copula fit clayton.csv --families clayton --confidence 0.9 --json ";
  const auto intervals = [&](const std::string& options) {
    return nlohmann::json::parse(run(arguments + options).out)["families"][0]["intervals"];
  };
  for (const std::string fit : {"two-step", "joint", "two-step --interval bootstrap --replicates 19"}) {
    const auto found = intervals("--margins beta,normal --fit " + fit);
    EXPECT_LT(found["tau_low"], 0.5) << fit;
    EXPECT_GT(found["tau_high"], 0.5) << fit;
    EXPECT_EQ(found["margins"][0]["column"], "u1") << fit;
    EXPECT_LT(found["margins"][0]["low"]["a"], 1) << fit;
    EXPECT_GT(found["margins"][0]["high"]["a"], 1) << fit;
    EXPECT_GT(found["margins"][1]["se"]["sd"], 0) << fit;
  }
  EXPECT_FALSE(intervals("").contains("margins"));
  write("counts.csv", "x,y,k\n1,2,3\n2,1,1\n3,5,2\n4,3,1\n5,4,1\n");
  write("rows.csv", "x,y\n1,2\n1,2\n1,2\n2,1\n3,5\n3,5\n4,3\n5,4\n");
  const auto low = [&](const std::string& file) {
    const std::string out = run("copula fit " + file + " --families frank --confidence 0.9 --json").out;
    return nlohmann::json::parse(out)["families"][0]["intervals"]["tau_low"].get<double>();
  };
  EXPECT_NEAR(low("counts.csv --weights k"), low("rows.csv"), 1e-6) << "two searches, to 1e-7";
}

TEST_F(FitIntervals, RefuseWhatTheyCannotDo) {
  write("shares.csv", "x,y,w\n1,2,0.5\n2,1,1\n3,5,1\n4,3,1\n");
  expect_refused("copula fit shares.csv --weights w --families frank --confidence 0.9",
                 "weights must be whole numbers, counts of equal rows, got weights(0) = 0.5");
  expect_refused("copula fit clayton.csv --margins kernel --families frank --confidence 0.9",
                 "no intervals with kernel margins");
  expect_refused("copula fit clayton.csv --confidence 1", "confidence must be in (0,1), got 1");
  expect_refused("copula fit clayton.csv --confidence 0.99 --interval bootstrap --replicates 100",
                 "need 199 fitted replicates or more, got 100");
  expect_usage_error("copula fit clayton.csv --interval wald");
}

/// Three columns, the second against the others.
class CopulaPredict : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    write("model.json", R"({"format": "sklar copula", "version": 2, "family": "clayton@u2", "dim": 3, "theta": [3],
      "margins": [{"kind": "histogram", "edges": [0, 10], "masses": [1]}, {"kind": "histogram", "edges": [0, 1],
      "masses": [1]}, {"kind": "histogram", "edges": [-1, 1], "masses": [1]}]})");
    write("data.csv", "x2\n0.1\n0.9\n");
  }
};

TEST_F(CopulaPredict, PrintsQuantilesOfTheOtherColumns) {
  const Result result = run("copula predict model.json data.csv --quantiles 0.1,0.5");
  EXPECT_TRUE(result.out.starts_with("x1_q0.1,x1_q0.5,x3_q0.1,x3_q0.5\n")) << result.out << result.err;
  const auto rows = nlohmann::json::parse(run("copula predict model.json data.csv --json").out)["rows"];
  ASSERT_EQ(rows.size(), 2);
  EXPECT_GT(rows[0][1], 7) << "the median of x1 where x2 is low";
  EXPECT_LT(rows[1][1], 3);
  write("named.csv", "c,a\n0.5,7.5\n");
  const Result named = run("copula predict model.json named.csv --columns a,b,c --quantiles 0.5");
  EXPECT_TRUE(named.out.starts_with("b_q0.5\n0.2")) << named.out << named.err;
}

TEST_F(CopulaPredict, TakesTheNamesThatAFitWrote) {
  write("losses.csv", "id,loss,alae\n1,10,3\n2,24,5\n3,45,4\n4,51,9\n5,60,8\n");
  ASSERT_EQ(run("copula fit losses.csv --columns alae,loss --families frank --model losses.json").status, 0);
  write("known.csv", "loss\n45\n");
  const Result result = run("copula predict losses.json known.csv --quantiles 0.5");
  EXPECT_TRUE(result.out.starts_with("alae_q0.5\n")) << result.out << result.err;
  EXPECT_TRUE(run("copula predict losses.json known.csv -n 1").out.starts_with("alae,loss\n"));
  EXPECT_TRUE(run("copula sample --model losses.json -n 1").out.starts_with("alae,loss\n"));
  expect_refused("copula predict losses.json known.csv --columns loss,alae",
                 "--columns: the model has the names of its columns: alae, loss");
}

TEST_F(CopulaPredict, DrawsPointsOfAllColumns) {
  const Result result = run("copula predict model.json data.csv -n 2 --seed 5");
  EXPECT_TRUE(result.out.starts_with("x1,x2,x3\n")) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 5);
  EXPECT_EQ(result.out, run("copula predict model.json data.csv -n 2 --seed 5 --threads 1").out);
  EXPECT_NE(result.out, run("copula predict model.json data.csv -n 2 --seed 6").out);
}

TEST_F(CopulaPredict, RefusesOtherColumns) {
  write("other.csv", "y\n1\n");
  expect_refused("copula predict model.json other.csv", "the model has no column 'y'; its columns: x1, x2, x3");
  write("all.csv", "x1,x2,x3\n1,0.5,0\n");
  expect_refused("copula predict model.json all.csv", "all 3 columns are given");
  expect_refused("copula predict model.json data.csv --columns a,b", "the model has 3 columns, got 2 names");
  expect_refused("copula predict model.json data.csv --quantiles 1.5", "--quantiles must be in [0,1], got 1.5");
  expect_usage_error("copula predict model.json data.csv -n 0");
  expect_usage_error("copula predict model.json data.csv -n 3 --quantiles 0.5");
}

}  // namespace
}  // namespace sklar::cli
