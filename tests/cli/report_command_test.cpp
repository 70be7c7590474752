/// Pages that commands write for a browser, as text and in one.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "copula/file.hpp"
#include "copula/inference/csv.hpp"
#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

constexpr double kSameSphere = 1e-3;  // mean difference of displayed values, of 1; a lamp 10 % brighter makes 1e-2

struct Visit {
  std::string page;     ///< after its scripts
  std::string console;  ///< what they complained of
};

/// The value of an attribute where it stands first.
std::string attribute(const std::string& page, const std::string& name) {
  const std::size_t at = page.find(name + "=\"");
  if (at == std::string::npos) return "";
  const std::size_t begin = at + name.size() + 2;
  return page.substr(begin, page.find('"', begin) - begin);
}

class Report : public CommandTest {
 protected:
  static bool has_browser() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }

  [[nodiscard]] Visit visit(const std::string& name) const {
    const std::string command = "cd '" + folder_.string() +
                                "' && chromium --headless=new --no-sandbox --use-angle=swiftshader "
                                "--enable-unsafe-swiftshader --user-data-dir=profile --virtual-time-budget=20000 "
                                "--enable-logging=stderr --v=0 --dump-dom 'file://" +
                                (folder_ / "work" / name).string() + "' >page 2>log; grep CONSOLE log >console";
    (void)std::system(command.c_str());
    return {read_file(folder_ / "page"), read_file(folder_ / "console")};
  }

  /// Nothing stands in the console after every choice has been made and every button pressed once.
  void expect_controls_work(const std::string& name) const {
    write("used.html", read(name) + R"(<script>
for (const select of document.querySelectorAll('select')) {
  for (const {value} of [...select.options]) { select.value = value; select.dispatchEvent(new Event('change')); }
}
for (const id of ['input[type=radio]', 'summary', 'thead button', 'tbody input', '#chosen button']) {
  for (let n = 0; n < document.querySelectorAll(id).length; ++n) document.querySelectorAll(id)[n].click();
}
document.body.dataset.used = 'yes';
</script>)");
    const Visit used = visit("used.html");
    EXPECT_EQ(used.console, "");
    EXPECT_EQ(attribute(used.page, "data-used"), "yes");
  }

  void expect_works_in_a_browser(const std::string& name, const std::string& text) const {
    const Visit visited = visit(name);
    EXPECT_EQ(visited.console, "");
    EXPECT_NE(visited.page.find(text), std::string::npos) << text;
    expect_controls_work(name);
  }
};

nlohmann::json data_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t at = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST_F(Report, RunsInABrowserAndDrawsTheModel) {
  const Result result = run("brdf compare --mode refined --max-bytes 600 --evaluations 40 --families frank --out out");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto data = data_of(read("out/report.html"));
  ASSERT_EQ(data["rows"].size(), 1U);
  EXPECT_EQ(data["rows"][0]["curves"]["lobes"].size(), data["axes"]["lobe_theta_i"].size());
  EXPECT_EQ(data["materials"][0]["curves"]["lobes"].size(), data["axes"]["lobe_theta_i"].size());
  if (!has_browser()) GTEST_SKIP() << "no chromium in the path: the page is not opened";
  const Visit visited = visit("out/report.html");
  EXPECT_EQ(visited.console, "");
  EXPECT_NE(visited.page.find("refined · frank"), std::string::npos);
  const std::string difference = attribute(visited.page, "data-difference");
  ASSERT_NE(difference, "") << "the live sphere was not drawn";
  EXPECT_LT(std::stod(difference), kSameSphere);
  EXPECT_GT(std::stod(difference), 0);  // two evaluations, not one picture
  expect_controls_work("out/report.html");
}

TEST_F(Report, OfCopulasRecommendsALevel) {
  ASSERT_EQ(run("tradeoff --families frank,independence --rows 20 --report t.html").status, 0);
  const auto data = data_of(read("t.html"));
  EXPECT_EQ(data["kind"], "copulas");
  EXPECT_EQ(data["rows"].size(), 24U) << "two families, three quantities, four levels";
  if (!has_browser()) GTEST_SKIP() << "no chromium in the path: the page is not opened";
  expect_works_in_a_browser("t.html", "largest error is at most 10⁻¹³: frank, standard");
}

TEST_F(Report, OfModelsRecommendsOne) {
  ASSERT_EQ(run("tradeoff --brdf --families independence --slices 1 --max-bytes 1 --report m.html").status, 0);
  const auto data = data_of(read("m.html"));
  EXPECT_EQ(data["kind"], "models");
  EXPECT_EQ(data["rows"].size(), 1U);
  if (!has_browser()) GTEST_SKIP() << "no chromium in the path: the page is not opened";
  expect_works_in_a_browser("m.html", ": paper · independence, 1 slice (");
}

TEST_F(Report, OfConvergenceHasCurvesAndPictures) {
  ASSERT_EQ(run("brdf converge --size 12 --spp-max 2 --spp-reference 4 --out .").status, 0);
  const auto data = data_of(read("report.html"));
  EXPECT_EQ(data["kind"], "convergence");
  EXPECT_EQ(data["rows"].size(), 6U);
  EXPECT_TRUE(data["picture"].get<std::string>().starts_with("data:image/png;base64,iVBORw0KGgo"));
  if (!has_browser()) GTEST_SKIP() << "no chromium in the path: the page is not opened";
  expect_works_in_a_browser("report.html", "Recommended, the cheapest whose error of the materials is at most");
}

/// The largest difference of two lists of numbers.
double distance(const nlohmann::json& a, const nlohmann::json& b) {
  double largest = a.size() == b.size() ? 0 : 1;
  for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) {
    largest = std::max(largest, std::abs(a[n].get<double>() - b[n].get<double>()));
  }
  return largest;
}

TEST_F(Report, OfAFitShowsEvenlySpacedRows) {
  ASSERT_EQ(run("copula sample --family gumbel --tau 0.4 -n 2500 -o data.csv").status, 0);
  ASSERT_EQ(run("copula fit data.csv --margins none --families gumbel,amh --method tau --report f.html").status, 0);
  const auto data = data_of(read("f.html"));
  const Points u = parse_csv(read("data.csv"), "data.csv").values;
  EXPECT_EQ(data["n"], 2500);
  ASSERT_EQ(data["points"].size(), 2U);
  ASSERT_EQ(data["points"][1].size(), 2000U);
  constexpr double kFiveDigits = 5e-5;
  for (const Index i : {0, 1, 4, 1999}) {
    EXPECT_NEAR(data["points"][1][static_cast<std::size_t>(i)].get<double>() / u(i * 2500 / 2000, 1), 1, kFiveDigits);
  }
  if (!has_browser()) GTEST_SKIP() << "no chromium in the path: the page is not opened";
  expect_works_in_a_browser("f.html", "2,000 of 2,500 rows");
}

TEST_F(Report, OfAFitComparesKendallDistributions) {
  constexpr double kSame = 0.05;  // 2.2 / sqrt(2000): a distance of Kolmogorov that one sample in 10000 exceeds
  ASSERT_EQ(run("copula sample --family clayton@u1 --theta 3 --dim 3 -n 2000 -o data.csv").status, 0);
  ASSERT_EQ(run("copula fit data.csv --families clayton@u1,gumbel --report f.html").status, 0);
  const auto data = data_of(read("f.html"));
  EXPECT_EQ(data["pairs"].size(), 3U);
  const auto& best = data["rows"][0];
  ASSERT_EQ(best["name"], "clayton@u1");
  EXPECT_EQ(best["reflected"], nlohmann::json::parse("[true, false, false]"));
  EXPECT_LT(distance(data["kendall"], best["kendall"]), kSame);
  EXPECT_GT(distance(data["kendall"], data["rows"][1]["kendall"]), kSame);
}

TEST_F(Report, IsRefusedBeforeAnythingIsWritten) {
  write("data.csv", "a,b\n0.1,0.2\n0.5,0.4\n0.9,0.8\n");
  expect_refused("copula fit data.csv --families frank -o out.csv --report missing/f.html", "missing/f.html");
  expect_refused("tradeoff --families frank --rows 5 --report missing/t.html",
                 "missing/t.html: its folder does not exist");
}

}  // namespace
}  // namespace sklar::cli
