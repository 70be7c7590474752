/// `copula fit` on data as statisticians have them: missing values, weights, ties, margins, selection.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "copula/inference/csv.hpp"
#include "copula/inference/model_io.hpp"
#include "families/registry.hpp"
#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

using CopulaFitData = CommandTest;
using CopulaFitMargins = CommandTest;
using CopulaFitSelect = CommandTest;
using nlohmann::json;

const std::string kRows =
    "0.1,0.3,2\n0.4,0.2,1\n0.3,0.45,1\n0.6,0.5,3\n0.8,0.7,1\n0.7,0.9,1\n0.2,0.15,2\n0.9,0.8,1\n0.55,0.6,1\n";

TEST_F(CopulaFitData, MissingValuesAreAnErrorOrTheirRowsDropped) {
  write("whole.csv", "x,y,w\n" + kRows);
  write("gaps.csv", "x,y,w\nNA,0.5,1\n" + kRows + "0.5,,1\n.,NaN,2\n");
  expect_refused(
      "copula fit gaps.csv -o out.csv --columns x,y",
      "gaps.csv: 4 values are missing in 3 of 12 rows, the first in line 2, column x; drop such rows (missing: "
      "drop)");
  const std::string fit = " --families frank,clayton --columns x,y --missing drop";
  const Result dropped = run("copula fit gaps.csv" + fit);
  ASSERT_EQ(dropped.status, 0) << dropped.err;
  EXPECT_EQ(dropped.out, run("copula fit whole.csv" + fit).out);
  EXPECT_NE(dropped.err.find("sklar: 3 of 12 rows dropped for missing values\n"), std::string::npos) << dropped.err;
  EXPECT_EQ(json::parse(run("copula fit gaps.csv --json" + fit).out)["dropped"], 3);
  expect_usage_error("copula fit gaps.csv --missing impute");
}

TEST_F(CopulaFitData, AWeightCountsRowsInEveryMethod) {
  write("weighted.csv",
        "x,w,y,place\n0.1,2,0.3,a\n0.4,0,0.2,b\n0.3,1,0.45,c\n0.6,3,0.4,d\n0.8,1,0.7,e\n0.5,1,0.25,f\n");
  write("repeated.csv", "x,y\n0.1,0.3\n0.1,0.3\n0.3,0.45\n0.6,0.4\n0.6,0.4\n0.6,0.4\n0.8,0.7\n0.5,0.25\n");
  for (const std::string options : {"--method ml", "--method ls", "--method tau", "--method rho", "--margins none",
                                    "--margins gamma,beta", "--margins normal --fit joint", "--margins kernel"}) {
    const std::string fit = " --json --columns x,y --families frank " + options;
    const Result weighted = run("copula fit weighted.csv --weights w" + fit),
                 repeated = run("copula fit repeated.csv" + fit);
    ASSERT_EQ(weighted.status, 0) << weighted.err;
    ASSERT_EQ(repeated.status, 0) << repeated.err;
    const json a = json::parse(weighted.out), b = json::parse(repeated.out);
    for (const std::string key : {"loglik", "bic"}) {
      // Estimates agree to the tolerance of the search, the likelihood to its square.
      EXPECT_NEAR(a["families"][0][key].get<double>(), b["families"][0][key].get<double>(), 1e-5) << options << key;
    }
    EXPECT_EQ(a["total_weight"], 8);
    EXPECT_EQ(a["rows"], 6);
  }
  expect_refused("copula fit weighted.csv -o out.csv --columns x,y --weights place",
                 "line 2: column place: 'a' is not a number");
  expect_refused("copula fit weighted.csv -o out.csv --columns x,z", "line 1: no column 'z'; columns: x, w, y, place");
  write("negative.csv", "x,y,w\n1,2,1\n3,4,-1\n");
  expect_refused("copula fit negative.csv -o out.csv --weights w",
                 "line 3, column w: a weight must be finite and 0 or more, got -1");
  expect_refused("copula fit negative.csv -o out.csv --weights z", "no column 'z' for --weights");
}

TEST_F(CopulaFitData, TellsOfTiesWhereRanksAreTaken) {
  write("tied.csv", "\"a, b\",y\n1,1\n2,1\n2,3\n4,4\n2,5\n");
  const std::string fit = "copula fit tied.csv --families frank --method tau";
  const Result average = run(fit);
  ASSERT_EQ(average.status, 0) << average.err;
  EXPECT_EQ(average.err,
            "sklar: column a, b: 3 of 5 rows share their value with another; --ties says which rank they get\n"
            "sklar: column y: 2 of 5 rows share their value with another; --ties says which rank they get\n");
  EXPECT_EQ(run(fit + " --margins normal").err, "");
  const auto likelihood = [&](const std::string& options) {
    return json::parse(run(fit + " --json " + options).out)["families"][0]["loglik"].get<double>();
  };
  EXPECT_EQ(likelihood("--ties average"), likelihood(""));
  EXPECT_NE(likelihood("--ties min"), likelihood(""));
  EXPECT_NE(likelihood("--ties max"), likelihood("--ties min"));
  EXPECT_EQ(likelihood("--ties random --seed 3"), likelihood("--ties random --seed 3"));
  expect_usage_error(fit + " --ties first");
}

TEST_F(CopulaFitMargins, AreFittedAndStoredWithTheBestCopula) {
  write("data.csv", "x,y,w\n" + kRows);
  const Result result =
      run("copula fit data.csv --columns x,y --margins gamma,beta:-1:2 --model model.json --json --families "
          "frank,independence,clayton@180");
  ASSERT_EQ(result.status, 0) << result.err;
  const json document = json::parse(result.out);
  const json& margins = document["margins"];
  EXPECT_EQ(margins[0]["column"], "x");
  EXPECT_EQ(margins[0]["kind"], "gamma");
  EXPECT_EQ(margins[1]["kind"], "beta");
  const CopulaModel model = parse_model(read("model.json"), "model.json", families::all());
  EXPECT_EQ(model.components.at(0).family, document["best"]);
  const auto gamma = std::get<GammaMarginal>(model.margins.at(0)).parameters();
  EXPECT_EQ(gamma[0], margins[0]["parameters"]["shape"].get<double>());
  EXPECT_EQ(gamma[1], margins[0]["parameters"]["scale"].get<double>());
  const auto support = std::get<BetaMarginal>(model.margins.at(1)).support();
  EXPECT_EQ(support[0], -1);
  EXPECT_EQ(support[1], 2);
  for (const json& family : document["families"]) {
    const double total = margins[0]["loglik"].get<double>() + margins[1]["loglik"].get<double>();
    EXPECT_NEAR(family["joint_loglik"].get<double>(), family["loglik"].get<double>() + total, 1e-12);
  }
  EXPECT_EQ(run("copula sample --family model.json -n 3").status, 0);
  const Result sample = run("copula sample --model model.json -n 3 --given 0.5 --seed 4");
  ASSERT_EQ(sample.status, 0) << sample.err;
  Rng rng(4);
  const Points expected = make_joint(model, families::all()).sample(3, rng, Points::Constant(1, 1, 0.5));
  EXPECT_EQ(sample.out, to_csv(std::vector<std::string>{"x", "y"}, expected));
  expect_usage_error("copula sample --model model.json --family frank -n 3");
  write("alone.json", to_json({.dim = 2, .components = {{.family = "clayton", .theta = {2}}}}));
  expect_refused("copula sample --model alone.json -n 3 -o out.csv", "alone.json: has no margins");
}

TEST_F(CopulaFitMargins, JointFitGainsOnTwoSteps) {
  ASSERT_EQ(run("copula sample --family gumbel --tau 0.4 -n 100 -o data.csv").status, 0);
  const auto document = [&](const std::string& options) {
    const Result result = run("copula fit data.csv --json --families clayton --margins beta " + options);
    EXPECT_EQ(result.status, 0) << result.err;
    return json::parse(result.out);
  };
  const json steps = document(""), joint = document("--fit joint --model model.json");
  const json &before = steps["families"][0], &after = joint["families"][0];
  EXPECT_GT(after["joint_loglik"].get<double>(), before["joint_loglik"].get<double>());
  EXPECT_GT(after["se"][0].get<double>(), 0);
  EXPECT_GT(after["margins"][1]["se"]["b"].get<double>(), 0);
  const CopulaModel model = parse_model(read("model.json"), "model.json", families::all());
  EXPECT_EQ(std::get<BetaMarginal>(model.margins.at(0)).parameters()[0],
            after["margins"][0]["parameters"]["a"].get<double>());
}

TEST_F(CopulaFitMargins, RefusesWhatDoesNotFit) {
  write("data.csv", "loss,claim\n1,2\n3,4\n5,-6\n7,1\n");
  const std::string fit = "copula fit data.csv -o out.csv --margins ";
  expect_refused(fit + "gamma", "data.csv: line 4, column claim: a gamma margin needs values in (0, inf), got -6");
  expect_refused(fit + "normal,beta:0:7",
                 "data.csv: line 4, column claim: a beta margin needs values in (0, 7), got -6");
  expect_refused(fit + "none", "data.csv: line 2, column loss: --margins none needs values in (0, 1), got 1");
  expect_refused(fit + "normal,normal,normal", "--margins names 3 margins for 2 columns; give one, or one a column");
  expect_refused(fit + "normal,empirical --fit joint", "--fit joint needs --margins normal, gamma or beta");
  for (const std::string margins : {"weibull", "normal,x", "beta:1", "beta:2:1", "gamma:0:1", "\"\""}) {
    expect_usage_error(fit + margins);
  }
  write("flat.csv", "x,y\n1,2\n1,4\n1,-6\n");
  expect_refused("copula fit flat.csv --margins normal -o out.csv", "normal margin: all values are 1");
}

TEST_F(CopulaFitSelect, OrdersByTheCriterion) {
  ASSERT_EQ(run("copula sample --family clayton --tau 0.4 -n 300 -o data.csv").status, 0);
  const std::string fit = "copula fit data.csv --families frank,clayton,independence ";
  const std::string select_by = fit + "--json --select ";
  for (const std::string select : {"aic", "bic", "cv", "holdout"}) {
    const Result result = run(std::string(select_by).append(select));
    ASSERT_EQ(result.status, 0) << result.err;
    const json document = json::parse(result.out);
    EXPECT_EQ(document["best"], "clayton") << select;
    const bool held_out = select == "cv" || select == "holdout";
    EXPECT_EQ(document["families"][0].contains("heldout"), held_out);
    if (!held_out) continue;
    double last = document["families"][0]["heldout"];
    for (const json& family : document["families"]) {
      EXPECT_LE(family["heldout"].get<double>(), last);
      last = family["heldout"];
    }
    EXPECT_GT(document["families"][0]["heldout_se"].get<double>(), 0);
  }
  const Result csv = run(fit + "--select cv --folds 3");
  EXPECT_TRUE(
      csv.out.starts_with("name,theta,tau,loglik,aic,bic,se,status,evaluations,message,heldout,heldout_se,"
                          "heldout_message\nclayton,"))
      << csv.out;
  EXPECT_EQ(run(fit + "--select cv --folds 3 --threads 3").out, csv.out);
  EXPECT_NE(run(fit + "--select cv --folds 3 --seed 2").out, csv.out);
  expect_refused(fit + "-o out.csv --select cv --folds 1", "folds must be in 2 to the number of rows, 300, got 1");
  expect_usage_error(fit + "--select best");
}

}  // namespace
}  // namespace sklar::cli
