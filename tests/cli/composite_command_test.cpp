/// Rotated families and mixtures on the command line.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "copula/inference/csv.hpp"
#include "copula/inference/dependence.hpp"
#include "copula/mixture.hpp"
#include "families/registry.hpp"
#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

using RotatedCommand = CommandTest;

const std::string kModel = SKLAR_EXAMPLE_FAMILIES "/../models/two_tails.json";
const std::string kFormula = SKLAR_EXAMPLE_FAMILIES "/bb1.json";

class MixtureCommand : public CommandTest {};

TEST_F(RotatedCommand, SamplesHaveTheSignOfTau) {
  for (const std::string name : {"clayton@90", "gumbel@270", "joe@90"}) {
    ASSERT_EQ(run("copula sample --family " + name + " --tau -0.5 -n 2000 -o data.csv").status, 0);
    const Points u = parse_csv(read("data.csv"), "data.csv").values;
    EXPECT_NEAR(kendall_tau(u.col(0), u.col(1)), -0.5, 0.06) << name;
  }
  const Result lists = run("copula sample --family gumbel@u1+u3 --theta 2 --dim 4 -n 3 --route frailty");
  EXPECT_TRUE(lists.status == 0 && lists.out.starts_with("u1,u2,u3,u4\n")) << lists.err << lists.out;
  const Result formula = run("copula sample --family " + kFormula + "@180 --theta 0.5,1.5 --dim 3 -n 2");
  EXPECT_TRUE(formula.status == 0 && formula.out.starts_with("u1,u2,u3\n")) << formula.err << formula.out;
}

TEST_F(RotatedCommand, FitSelectsTheOneBehindNegativeDependence) {
  ASSERT_EQ(run("copula sample --family gumbel@90 --theta 2 -n 1000 -o data.csv").status, 0);
  const Result result = run("copula fit data.csv --json --families frank,clayton@90,gumbel@90,gumbel@270,gumbel");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto document = nlohmann::json::parse(result.out);
  EXPECT_EQ(document["best"], "gumbel@90");
  const auto& best = document["families"].at(0);
  EXPECT_NEAR(best["theta"].at(0).get<double>(), 2, 4 * best["se"].at(0).get<double>());
  EXPECT_LT(best["tau"].get<double>(), -0.4);
}

TEST_F(RotatedCommand, TablesAreExactToo) {
  write("in.csv",
        "family,theta,quantity,d,u\n"
        "independence@180,,cdf,3,0.5 0.5 0.25\n"
        "clayton@180,1,h,2,0.5 0.5\n"  // 1 - (1 + 1/2)^-2 = 5/9
        "clayton@90,1,log_dpsi:1,2,0.5\n"
        "clayton@90,1,h,3,0.5 0.5 0.5\n");
  const Result result = run("copula table in.csv --accuracy exact --digits 50");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find(",6.25" + std::string(47, '0') + "e-02\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(",5." + std::string(48, '5') + "6e-01\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("the copula is not Archimedean"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("error: clayton@90: dimension must be 2, got 3"), std::string::npos) << result.out;
}

TEST_F(RotatedCommand, FamiliesShowsThoseAskedFor) {
  const Result result = run("families --families clayton@180,clayton@90");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("\nclayton@180  theta in [-1, inf)  [-1, 1)  upper"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("\nclayton@90   theta in [-1, inf)  (-1, 1]  none"), std::string::npos) << result.out;
  EXPECT_EQ(run("families").out.find('@'), std::string::npos);
  EXPECT_NE(run("families --help").out.find("@180"), std::string::npos);
}

TEST_F(RotatedCommand, StoredReflectanceKeepsTheRotation) {
  ASSERT_EQ(run("brdf fit --mode paper --slices 1 --method tau --family clayton@180 -o model.json").status, 0);
  EXPECT_NE(read("model.json").find("\"family\":\"clayton@180\""), std::string::npos);
  EXPECT_EQ(run("brdf albedo model.json").status, 0);
}

TEST_F(RotatedCommand, RefusesNamesThatMeanNothing) {
  const std::string sample = "copula sample -n 1 --theta 2 --family ";
  expect_refused(sample + "clayton@45", "unknown rotation '@45'; allowed: @180, in dimension 2 @90 and @270");
  expect_refused(sample + "clayton@", "unknown rotation '@'");
  expect_refused(sample + "x@180", "unknown family 'x'; known families: ");
  expect_refused(sample + "clayton@90@90", "clayton@90 is rotated already");
  expect_refused(sample + "clayton@90 --dim 3", "clayton@90: dimension must be 2, got 3");
  expect_refused(sample + "clayton@u1+u4 --dim 3", "clayton@u1+u4: dimension must be 4 or more, got 3");
  expect_refused("copula sample -n 1 --tau 0.5 --family gumbel@90", "gumbel@90: tau must be in (-1, 0]");
  expect_refused("copula sample -n 1 --tau 0.5 --family gumbel@u1", "has no inverse of Kendall's tau");
  expect_refused("brdf compare --families frank,clayton@90 --out out", "clayton@90: dimension must be 2, got 3");
  expect_refused("families --families clayton@90 --dim 3", "clayton@90: dimension must be 2, got 3");
}

TEST_F(MixtureCommand, AModelFileIsAFamilyWithoutParameters) {
  const Mixture mixture({families::find("clayton").make(2, {2}), families::find("clayton@180").make(2, {1})},
                        {0.7, 0.3});
  const Result sample = run("copula sample --seed 3 -n 5 --family " + kModel);
  ASSERT_EQ(sample.status, 0) << sample.err;
  Rng rng(3);
  EXPECT_TRUE((parse_csv(sample.out, "out").values == mixture.sample(5, rng)).all()) << sample.out;

  write("in.csv", "family,theta,quantity,d,u\n" + kModel + ",,log_pdf,2,0.25 0.5\n" + kModel + "@90,,h,2,0.25 0.5\n");
  const Result table = run("copula table in.csv --json");
  ASSERT_EQ(table.status, 0) << table.err;
  const auto rows = nlohmann::json::parse(table.out)["rows"];
  EXPECT_EQ(rows[0]["value"].get<double>(), mixture.log_pdf((Points(1, 2) << 0.25, 0.5).finished())(0));
  EXPECT_EQ(rows[1]["value"].get<double>(), mixture.h((Points(1, 2) << 0.75, 0.5).finished())(0));
  EXPECT_EQ(run("copula table in.csv --accuracy exact").status, 0);
}

TEST_F(MixtureCommand, IsComparedWithFamiliesByFit) {
  ASSERT_EQ(run("copula sample -n 2000 -o data.csv --family " + kModel).status, 0);
  const Result result = run("copula fit data.csv --families frank,clayton,gumbel," + kModel);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("message\ntwo_tails,,nan,"), std::string::npos) << result.out;
}

TEST_F(MixtureCommand, RefusesWhatAModelIsNot) {
  expect_refused("copula sample -n 1 --theta 2 --family " + kModel, "two_tails: takes 0 parameters, got 1");
  expect_refused("copula sample -n 1 --dim 3 --family " + kModel, "two_tails: dimension must be 2, got 3");
  write("model.json", R"({"format":"sklar copula","version":2,"dim":2,"components":[)"
                      R"({"weight":0.5,"family":"clayton","theta":[2]}],"margins":[]})");
  expect_refused("copula sample -n 1 --family model.json", "model.json: the weights of a mixture must have the sum 1");
  write("model.json", R"({"format":"other"})");
  expect_refused("copula sample -n 1 --family model.json", R"(expected "format": "sklar family")");
}

}  // namespace
}  // namespace sklar::cli
