/// The contract of every subcommand: exit status, one line on stderr, nothing half-written.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "families/registry.hpp"
#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

using Command = CommandTest;
using Families = CommandTest;
using CopulaFit = CommandTest;
using CopulaSample = CommandTest;
using CopulaTable = CommandTest;

const std::string kHeader = "family,theta,quantity,d,u\n";
const std::string kHeaderExpected = "family,theta,quantity,d,u,expected\n";

TEST_F(Command, EverySubcommandHasHelpAndTheCommonOptions) {
  for (const std::string command : {"families", "copula table", "copula sample", "copula fit", "tradeoff"}) {
    const Result result = run(command + " --help");
    EXPECT_EQ(result.status, 0) << command;
    EXPECT_EQ(result.err, "") << command;
    for (const std::string option : {"--help", "--json", "--seed", "--threads"}) {
      EXPECT_NE(result.out.find(option), std::string::npos) << command << " " << option;
    }
  }
}

TEST_F(Command, WrongUsageIsStatus2) {
  for (const std::string arguments :
       {"", "copula", "nonsense", "families --nonsense", "families --threads 0", "families --seed x",
        "copula sample --family independence", "copula sample -n ten", "copula sample -n 1 --theta 1 --tau .5",
        "copula table", "copula fit", "copula fit data.csv --method x", "copula fit data.csv --margins x"}) {
    expect_usage_error(arguments);
  }
}

TEST_F(Families, ListsEveryRegisteredFamily) {
  const Result result = run("families");
  EXPECT_EQ(result.status, 0);
  for (const FamilyInfo& family : families::all()) {
    EXPECT_NE(result.out.find("\n" + family.name + " "), std::string::npos) << family.name;
  }
  expect_refused("families --dim 1", "dim must be 2 or more, got 1");
}

TEST_F(CopulaSample, PrintsAHeaderAndNRows) {
  const Result result = run("copula sample --family independence --dim 3 -n 2 --given 0.25 --seed 7");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("u1,u2,u3\n0.25,")) << result.out;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3);
  EXPECT_EQ(run("copula sample --family independence --dim 3 -n 2 --given 0.25 --seed 7").out, result.out);
  EXPECT_NE(run("copula sample --family independence --dim 3 -n 2 --given 0.25 --seed 8").out, result.out);
}

TEST_F(CopulaSample, RefusesWhatHasNoSample) {
  const std::string sample = "copula sample --family independence -o out.csv ";
  expect_refused(sample + "-n 0", "n must be 1 or more, got 0");
  expect_refused(sample + "-n 1 --dim 1", "dimension must be 2 or more, got 1");
  expect_refused(sample + "-n 1 --given 0.1,1.5 --dim 3", "1.5");
  expect_refused(sample + "-n 1 --given 0.1,0.5", "given must have 0 to 1 columns, got 2");
  expect_refused(sample + "-n 1 --given 0.1,x --dim 3", "'x' is not a number");
  expect_refused("copula sample --family gaussian -n 1", "known families: " + families::all().front().name);
}

TEST_F(CopulaSample, RefusesAnOutputThatCannotBeWritten) {
  expect_refused("copula sample --family independence -n 1 -o missing/out.csv", "missing/out.csv");
  expect_refused("copula sample --family independence -n 1 -o .", "directory");
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  expect_refused("copula sample --family independence -n 1 -o /dev/full", "/dev/full: cannot be written");
}

TEST_F(CopulaSample, TakesARoute) {
  for (const std::string route : {"conditional", "frailty", "radial"}) {
    const Result result = run("copula sample --theta 5 --dim 3 -n 4 --route " + route);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 5) << result.out;
  }
  EXPECT_NE(run("copula sample --theta 5 -n 4 --route frailty").out, run("copula sample --theta 5 -n 4").out);
  expect_refused("copula sample --theta -5 -n 4 --route frailty", "this copula has no frailty");
  expect_refused("copula sample --theta 5 -n 4 --route radial --given 0.5", "--given needs the conditional route");
  expect_usage_error("copula sample --theta 5 -n 4 --route other");
}

TEST_F(CopulaTable, AnswersInTheOrderOfTheFile) {
  write("in.csv", kHeader +
                      "independence,,h,2,0.5 0.25\r\n"
                      "independence,,log_pdf,3,0.5 0.25 1\n"
                      "independence,,h,2,1 0.1\n"
                      "independence,,log_cdf,2,0 0.5\n"
                      "independence,,h,2,0.5 nan\n"
                      "independence,,log_dpsi:5,2,3\n"
                      "independence,,log_dpsi:0,2,-1\n");
  const Result result = run("copula table in.csv -o out.csv");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(read("out.csv"),
            "family,theta,quantity,d,u,value\n"
            "independence,,h,2,0.5 0.25,0.25\n"
            "independence,,log_pdf,3,0.5 0.25 1,0\n"
            "independence,,h,2,1 0.1,0.10000000000000001\n"
            "independence,,log_cdf,2,0 0.5,-inf\n"
            "independence,,h,2,0.5 nan,nan\n"
            "independence,,log_dpsi:5,2,3,-3\n"
            "independence,,log_dpsi:0,2,-1,\"error: log_abs_dpsi: t must be >= 0, got t(0) = -1\"\n");
  EXPECT_NE(result.err.find("independence h: 3 rows\n"), std::string::npos) << result.err;
}

TEST_F(CopulaTable, ComparesWithTheExpectedValue) {
  write("in.csv", kHeaderExpected +
                      "independence,,h,2,0.5 0.25,2.500000000000000000000001e-1\n"
                      "independence,,h,2,0.5 0.25,0.26\n"
                      "independence,,h,2,0.5 0,1e-300300\n"
                      "independence,,log_pdf,2,0.5 0,\n");
  const Result result = run("copula table in.csv");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("family,theta,quantity,d,u,expected,value,error\n")) << result.out;
  EXPECT_NE(result.out.find("1e-300300,0,0\n"), std::string::npos) << result.out;
  EXPECT_TRUE(result.out.ends_with("0.5 0,,0,\n")) << result.out;
  EXPECT_NE(result.err.find("independence h: 3 rows, 2 of 3 pass, worst error 0.0392"), std::string::npos)
      << result.err;
  EXPECT_NE(result.err.find("in line 3\n"), std::string::npos) << result.err;
}

TEST_F(CopulaTable, GivesAsManyDigitsAsAskedFor) {
  write("in.csv", kHeaderExpected +
                      "independence,,log_cdf,2,0.5 0.5,-1.3862943611198906188344642429163531\n"
                      "independence,,cdf,2,0.5 1,0.5\n"
                      "independence,,h,2,0.5 1.25,\n");
  const Result result = run("copula table in.csv --accuracy exact --digits 30");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find(",-1.38629436111989061883446424292e+00,"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(",5.00000000000000000000000000000e-01,0\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\"error: "), std::string::npos) << result.out;
  expect_usage_error("copula table in.csv --accuracy exact --digits 0");
}

TEST_F(CopulaTable, EveryLevelIsAsAccurateAsItSays) {
  write("in.csv", kHeaderExpected + "frank,5,log_pdf,2,0.25 0.75,-0.96622135369235653246\n");
  const auto error = [&](const std::string& level) {
    const Result result = run("copula table in.csv --json --accuracy " + level);
    EXPECT_EQ(result.status, 0) << result.err;
    return nlohmann::json::parse(result.out)["rows"][0]["error"].get<double>();
  };
  EXPECT_LE(error("standard"), 1e-13);
  EXPECT_LE(error("symbolic"), 1e-13);
  EXPECT_LE(error("fast"), 1e-5);
  EXPECT_GT(error("fast"), 1e-13);
  expect_usage_error("copula table in.csv --accuracy slow");
}

TEST_F(CopulaTable, AnInadmissibleRowSaysWhyAndHarmsNoOther) {
  write("in.csv", kHeader +
                      "independence,,h,2,0.5 0.25\n"
                      "independence,,h,2,0.5 1.25\n"
                      "independence,,h,2,0.5 0.75\n");
  const Result result = run("copula table in.csv");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.out.find(",0.5 0.25,0.25\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(",0.5 1.25,\"error: h: u must be in [0,1]"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(",0.5 0.75,0.75\n"), std::string::npos) << result.out;
  EXPECT_NE(result.err.find("3 rows, 1 without a value"), std::string::npos) << result.err;
}

TEST_F(CopulaTable, RefusesABadRowWithItsLine) {
  const std::string good = "independence,,cdf,2,0.5 0.25\n";
  const auto refused = [&](const std::string& text, const std::string& message) {
    write("in.csv", text);
    expect_refused("copula table in.csv -o out.csv", message);
  };
  refused("", "line 1: the header must be");
  refused("a,b\n", "line 1: the header must be");
  refused(kHeader + good + "independence,,cdf,2\n", "line 3: must have 5 fields, got 4");
  refused(kHeader + "independence,,cdf,2,0.5\n" + good, "line 2: u must hold 2 numbers, got 1");
  refused(kHeader + good + good + "independence,,cdf,2,0.5 x\n", "line 4: u: 'x' is not a number");
  refused(kHeader + good + "gaussian,,cdf,2,0.5 0.5\n", "line 3: unknown family 'gaussian'; known families: ");
  refused(kHeader + good + "independence,,pdf,2,0.5 0.5\n",
          "line 3: unknown quantity 'pdf'; known quantities: log_pdf");
  refused(kHeader + good + "independence,,log_dpsi:x,2,1\n", "line 3: unknown quantity 'log_dpsi:x'");
  refused(kHeader + good + "independence,,log_dpsi:1,2,1 2\n", "line 3: u must hold 1 numbers, got 2");
  refused(kHeader + good + "independence,1,cdf,2,0.5 0.5\n", "line 3: independence takes 0 parameters, got 1");
  refused(kHeader + "independence,,cdf,1,0.5\n", "line 2: d must be a whole number from 2, got '1'");
  refused(kHeader + good + "\n" + good, "line 3: must have 5 fields, got 1");
  refused(kHeaderExpected + "independence,,cdf,2,0.5 0.5,abc\n", "line 2: expected: 'abc' is not a number");
}

TEST_F(CopulaTable, RefusesWhatIsNoFile) {
  expect_refused("copula table missing.csv", "missing.csv: no such file");
  expect_refused("copula table .", "is a directory");
}

TEST_F(CopulaFit, RecoversTheFamilyOfASample) {
  for (const FamilyInfo& family : families::all()) {
    if (family.parameters.size() != 1) continue;
    ASSERT_EQ(run("copula sample --family " + family.name + " --tau 0.3 -n 4000 -o data.csv").status, 0);
    for (const std::string method : {"ml", "ls", "tau"}) {
      const Result result = run("copula fit data.csv --method " + method + " --json --families " + family.name);
      ASSERT_EQ(result.status, 0) << result.err;
      const auto document = nlohmann::json::parse(result.out);
      EXPECT_EQ(document["best"], family.name);
      const auto& fitted = document["families"].at(0);
      // Kendall's tau of n observations has a standard error of about 0.7 / sqrt(n) = 0.011; least squares sees the
      // coarse histogram of them.
      EXPECT_NEAR(fitted["tau"].get<double>(), 0.3, method == "ls" ? 0.1 : 0.044) << family.name << " " << method;
      EXPECT_EQ(fitted["theta"].size(), 1u);
      for (const std::string key : {"name", "loglik", "aic", "bic", "se", "status", "evaluations"}) {
        EXPECT_TRUE(fitted.contains(key)) << key;
      }
    }
  }
}

TEST_F(CopulaFit, PrintsTheBestFirst) {
  ASSERT_EQ(run("copula sample --family frank --tau 0.5 -n 500 -o data.csv").status, 0);
  const Result result = run("copula fit data.csv --families independence,frank");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("name,theta,tau,loglik,aic,bic,se,status,evaluations,message\nfrank,"))
      << result.out;
  EXPECT_NE(result.out.find("\nindependence,,"), std::string::npos) << result.out;
}

TEST_F(CopulaFit, RefusesBadData) {
  write("data.csv", "x,y\n1,2\n3,nan\n");
  expect_refused("copula fit data.csv -o out.csv",
                 "data.csv: 1 value is missing in 1 of 2 rows, the first in line 3, column y");
  write("data.csv", "x,y\n1,2\n3,-inf\n");
  expect_refused("copula fit data.csv -o out.csv", "data.csv: line 3, column y: must be finite, got -inf");
  write("data.csv", "x,y\n1,2\n3\n");
  expect_refused("copula fit data.csv -o out.csv", "line 3");
  write("data.csv", "x\n1\n2\n");
  expect_refused("copula fit data.csv -o out.csv", "columns");
  write("data.csv", "x,y\n0.5,0.5\n0.25,1.5\n");
  expect_refused("copula fit data.csv --margins none -o out.csv", "1.5");
  expect_refused("copula fit data.csv --families frank,x -o out.csv", "unknown family 'x'; known families: ");
  expect_refused("copula fit missing.csv", "missing.csv: no such file");
}

}  // namespace
}  // namespace sklar::cli
