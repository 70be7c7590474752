/// Families and formulas on the command line.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "copula/inference/csv.hpp"
#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

class FormulaCommand : public CommandTest {
 protected:
  /// The file mine.json with these pieces.
  void define(const std::string& psi, const std::string& bounds = R"("lowest": 0, "highest": "inf")") const {
    write("mine.json", R"({"format": "sklar family", "version": 1, "name": "mine", "title": "Mine", "psi": ")" + psi +
                           R"(", "source": "none", "parameters": [{"name": "theta", )" + bounds +
                           R"(}], "examples": []})");
  }

  /// Status 1, the message and below it the formula with a caret.
  void expect_caret(const std::string& arguments, const std::string& message) const {
    SCOPED_TRACE("sklar " + arguments);
    const Result result = run(arguments);
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, message);
  }

  static std::string example(const std::string& name) {
    return std::string(SKLAR_EXAMPLE_FAMILIES) + "/" + name + ".json";
  }
};

using CopulaDerive = FormulaCommand;

TEST_F(CopulaDerive, PrintsOneLine) {
  EXPECT_EQ(run("copula derive 'exp(-theta*t)' --order 3").out, "-theta^3*exp(-t*theta)\n");
  EXPECT_EQ(run("copula derive '-log(t)' --order 1 --to latex").out, "-\\frac{1}{t}\n");
  EXPECT_EQ(run("copula derive --order 2 -t^2").out, "-2\n");
  EXPECT_EQ(run("copula derive -t --order 0").out, "-t\n");
  const Result cpp = run("copula derive '1/(1+t)' --order 2 --to cpp");
  EXPECT_NE(cpp.out.find("double dpsi_2(double t) {"), std::string::npos) << cpp.out;
  const auto document = nlohmann::json::parse(run("copula derive '-t^2' --order 1 --json").out);
  EXPECT_EQ(document["psi"], "-t^2");
  EXPECT_EQ(document["derivative"], "-2*t");
}

TEST_F(CopulaDerive, TheTextReadsBack) {
  const Result first = run("copula derive '-log(1-(1-exp(-theta))*exp(-t))/theta' --order 2");
  std::string text = first.out;
  text.pop_back();
  EXPECT_EQ(run("copula derive '" + text + "' --order 2").out,
            run("copula derive '-log(1-(1-exp(-theta))*exp(-t))/theta' --order 4").out);
}

TEST_F(CopulaDerive, RefusesBadFormulasAndOrders) {
  expect_caret("copula derive '-log(t+)' --order 1",
               "sklar: a number, a symbol, a function or '(' was expected, got ')' at position 8\n"
               "  -log(t+)\n"
               "         ^\n");
  expect_refused("copula derive t --order -1", "the order must be from 0 to 100, got -1");
  expect_refused("copula derive t --order 101", "the order must be from 0 to 100, got 101");
  for (const std::string arguments : {"copula derive t", "copula derive --order 1", "copula derive t t --order 1",
                                      "copula derive t --order x", "copula derive t --order 1 --to html"}) {
    expect_usage_error(arguments);
  }
}

TEST_F(FormulaCommand, EveryCommandTakesAFile) {
  for (const std::string name : {"inverse_gaussian", "bb1", "nelsen_4_2_12"}) {
    const Result listed = run("families --dim 3 --families frank," + example(name));
    EXPECT_EQ(listed.status, 0) << listed.err;
    EXPECT_EQ(std::count(listed.out.begin(), listed.out.end(), '\n'), 3) << listed.out;
    const std::string theta = name == "bb1" ? "0.5,1.5" : "2";
    ASSERT_EQ(
        run("copula sample --family " + example(name) + " --theta " + theta + " --dim 3 -n 400 -o data.csv").status, 0);
    const Result fit = run("copula fit data.csv --json --families independence," + example(name));
    ASSERT_EQ(fit.status, 0) << fit.err;
    EXPECT_NE(nlohmann::json::parse(fit.out)["best"], "independence");
  }
}

TEST_F(FormulaCommand, TheTableHasAllQuantities) {
  std::string rows = "family,theta,quantity,d,u,expected\n";
  const std::vector<std::string> quantities{"log_pdf", "cdf", "log_cdf", "h", "h_upper", "h_inv", "h_inv_upper"};
  for (const std::string& quantity : quantities) rows += example("bb1") + ",0.5 1.5," + quantity + ",2,0.25 0.75,\n";
  rows += example("bb1") + ",0.5 1.5,log_dpsi:3,2,0.5,\n";
  write("in.csv", rows);
  const Result result = run("copula table in.csv");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out.find("error:"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("nan"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("log_pdf,2,0.25 0.75,,-0.625357417945263"), std::string::npos) << result.out;
}

TEST_F(FormulaCommand, AFittedReflectanceModelStandsAlone) {
  define("exp(-t^(1/theta))", R"("lowest": 1, "highest": "inf")");
  ASSERT_EQ(run("brdf fit --mode paper --method tau --slices 1 --family mine.json -o model.json").status, 0);
  write("mine.json", "");
  const auto model = nlohmann::json::parse(read("model.json"));
  EXPECT_EQ(model["family"]["name"], "mine");
  EXPECT_EQ(model["family"]["psi"], "exp(-t^(1/theta))");
  const Result albedo = run("brdf albedo model.json");
  EXPECT_EQ(albedo.status, 0) << albedo.err;
}

TEST_F(FormulaCommand, CompareTakesAFile) {
  define("exp(-t^(1/theta))", R"("lowest": 1, "highest": "inf")");
  const Result result = run("brdf compare --method tau --slices 1 --families mine.json --out out");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(read("out/results.json"))["rows"][0]["family"], "mine");
}

TEST_F(FormulaCommand, RefusesWhatIsNoFamily) {
  const std::string sample = "copula sample -n 1 --family mine.json --theta 2 --dim ";
  expect_refused(sample + "2", "mine.json: no such file");
  define("exp(-theta*t");
  expect_caret(sample + "2",
               "sklar: mine.json: field 'psi': ',' or ')' was expected, got the end at position 13\n"
               "  exp(-theta*t\n"
               "              ^\n");
  define("exp(-alpha*t)");
  expect_caret("copula fit data.csv --families mine.json",
               "sklar: mine.json: field 'psi': unknown symbol 'alpha'; allowed are t, theta at position 6\n"
               "  exp(-alpha*t)\n"
               "       ^\n");
  define("exp(-theta*t)", R"("lowest": 0)");
  expect_refused(sample + "2", "mine.json: parameters[0]: unbounded parameter 'theta': field 'highest' is missing");
  define("exp(-t^theta)");
  expect_refused(sample + "2",
                 "mine (theta = 2): psi is no generator in dimension 2: (-1)^2 psi^(2)(t) must not be "
                 "negative, found psi^(2)(");
  define("exp(-theta*t)/2");
  expect_refused(sample + "2", "mine (theta = 2): psi is no generator in dimension 2: psi(0) must be 1, found 0.5");
}

TEST_F(FormulaCommand, RefusesADimensionInWhichPsiIsNoGenerator) {
  define("(1-theta*t)^(1/theta)", R"("lowest": 0, "lowest_included": false, "highest": 1)");
  const std::string sample = "copula sample -n 1 --family mine.json --theta 0.45 --dim ";
  EXPECT_EQ(run(sample + "3").status, 0);
  expect_refused(sample + "4", "mine (theta = 0.45): psi is no generator in dimension 4: (-1)^4 psi^(4)(t)");
  expect_refused(sample + "21", "mine: dimension must be 2 to 20, got 21");
}

}  // namespace
}  // namespace sklar::cli
