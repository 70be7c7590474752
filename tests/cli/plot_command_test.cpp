/// `sklar copula plot`: what it writes; how it looks is not judged.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

using CopulaPlot = CommandTest;

constexpr const char* kNames[] = {"pairs", "kendall", "quantiles"};

TEST_F(CopulaPlot, WritesThreePictures) {
  ASSERT_EQ(run("copula sample --family gumbel --theta 2 -n 300 -o data.csv").status, 0);
  const Result result = run("copula plot data.csv --families gumbel,clayton@180 --out new/folder");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "new/folder/pairs.png\nnew/folder/kendall.png\nnew/folder/quantiles.png\n");
  EXPECT_EQ(result.err, "");
  for (const std::string name : kNames) EXPECT_TRUE(read("new/folder/" + name + ".png").starts_with("\x89PNG")) << name;
}

TEST_F(CopulaPlot, AsSvgWithTheBestFamilyNamed) {
  ASSERT_EQ(run("copula sample --family clayton --theta 3 --dim 3 -n 200 -o data.csv").status, 0);
  const Result result =
      run("copula plot data.csv --families gumbel,clayton,frank@u1 --margins none --format svg --out . --json");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto document = nlohmann::json::parse(result.out);
  EXPECT_EQ(document["best"], "clayton");
  ASSERT_EQ(document["files"].size(), 3u);
  for (const std::string name : kNames) EXPECT_TRUE(read(name + ".svg").ends_with("</svg>\n")) << name;
}

TEST_F(CopulaPlot, WithAPanelForEachFittedMargin) {
  ASSERT_EQ(run("copula sample --family frank --theta 2 -n 100 -o data.csv").status, 0);
  std::vector<std::size_t> panels;
  for (const std::string margins : {"empirical", "beta,empirical", "normal,beta"}) {
    const Result result = run("copula plot data.csv --families frank --format svg --margins " + margins);
    ASSERT_EQ(result.status, 0) << result.err;
    panels.push_back(read("out/quantiles.svg").size());
  }
  EXPECT_LT(1.4 * static_cast<double>(panels[0]), static_cast<double>(panels[1]));  // a panel more
  EXPECT_LT(1.2 * static_cast<double>(panels[1]), static_cast<double>(panels[2]));
  expect_usage_error("copula plot data.csv --margins poisson");
}

TEST_F(CopulaPlot, LeavesOutWhatCannotBeFitted) {
  ASSERT_EQ(run("copula sample --family frank --theta 2 --dim 3 -n 50 -o data.csv").status, 0);
  const Result result = run("copula plot data.csv --families frank,frank@90");
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(result.err.starts_with("sklar: frank@90 is left out: ")) << result.err;
  EXPECT_TRUE(read("out/kendall.png").starts_with("\x89PNG"));
}

TEST_F(CopulaPlot, RefusesBadInput) {
  expect_refused("copula plot missing.csv", "missing.csv");
  write("one.csv", "x\n1\n2\n3\n");
  expect_refused("copula plot one.csv", "2 or more columns");
  write("data.csv", "x,y\n1,2\n2,1\n3,3\n");
  expect_refused("copula plot data.csv --margins none",
                 "line 2, column x: --margins none needs values in (0, 1), got 1");
  expect_refused("copula plot data.csv --families nobody", "unknown family 'nobody'");
  expect_usage_error("copula plot data.csv --format pdf");
}

}  // namespace
}  // namespace sklar::cli
