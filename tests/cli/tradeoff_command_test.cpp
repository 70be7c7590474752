/// `sklar tradeoff`: what it writes, on few rows; times are not judged.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

using Tradeoff = CommandTest;

TEST_F(Tradeoff, WritesTableCsvAndPicture) {
  const Result result = run("tradeoff --families frank,gumbel --rows 20 --csv t.csv -o t.png");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(result.out.starts_with("family  quantity  accuracy  ns a row  median error  largest error\nfrank "))
      << result.out;
  const std::string csv = read("t.csv");
  EXPECT_TRUE(csv.starts_with("family,theta,d,quantity,accuracy,ns,median_error,max_error\nfrank,")) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), std::count(result.out.begin(), result.out.end(), '\n'));
  EXPECT_TRUE(read("t.png").starts_with("\x89PNG"));
}

TEST_F(Tradeoff, EveryLevelIsAsAccurateAsItSays) {
  const Result result = run("tradeoff --families clayton --rows 20 --dim 3 --seed 5 --json");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto document = nlohmann::json::parse(result.out);
  EXPECT_EQ(document["n"], 20);
  EXPECT_EQ(document["seed"], 5);
  int standard = 0;
  for (const auto& row : document["rows"]) {
    EXPECT_EQ(row["d"], 3);
    EXPECT_EQ(row["theta"].size(), 1u);
    const std::string level = row["accuracy"];
    const double error = row["max_error"].get<double>();
    EXPECT_LE(error, level == "exact" ? 1e-50 : level == "fast" ? 1e-5 : 1e-13) << row;
    EXPECT_GT(row["ns"].get<double>(), 0) << row;
    EXPECT_LE(row["median_error"].get<double>(), error) << row;
    standard += level == "standard";
  }
  EXPECT_EQ(standard, 3) << "log_pdf, h, h_inv";
}

TEST_F(Tradeoff, TheSeedChoosesThePoints) {
  const auto errors = [&](const std::string& seed) {
    std::vector<double> all;
    const Result result = run("tradeoff --families frank --rows 5 --json --seed " + seed);
    const auto document = nlohmann::json::parse(result.out);
    for (const auto& row : document["rows"]) all.push_back(row["max_error"]);
    return all;
  };
  EXPECT_EQ(errors("1"), errors("1"));
  EXPECT_NE(errors("1"), errors("2"));
}

TEST_F(Tradeoff, OfModelsMarksTheBestForTheirCost) {
  const Result result =
      run("tradeoff --brdf --families independence --slices 1,6 --max-bytes 700 --csv m.csv -o m.png --json");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto document = nlohmann::json::parse(result.out);
  EXPECT_EQ(document["material"], "synthetic");
  ASSERT_EQ(document["rows"].size(), 3u) << "two paper models and the smallest refined one";
  const auto& refined = document["rows"][2];
  EXPECT_EQ(refined["mode"], "refined");
  EXPECT_TRUE(refined["best_for_bytes"]) << refined;
  for (const auto& row : document["rows"]) {
    EXPECT_GT(row["bytes"].get<double>(), 0) << row;
    EXPECT_GT(row["single_ns"].get<double>(), 0) << row;
    EXPECT_GE(row["log1p_mae"].get<double>(), refined["log1p_mae"].get<double>()) << row;
  }
  EXPECT_TRUE(read("m.csv").starts_with("material,mode,family,structure,bytes,batch_ns,")) << read("m.csv");
  EXPECT_TRUE(read("m.png").starts_with("\x89PNG"));
}

TEST_F(Tradeoff, RefusesBadInput) {
  expect_refused("tradeoff --brdf missing.binary", "missing.binary");
  expect_refused("tradeoff --brdf --slices 7 --families frank", "7");
  expect_usage_error("tradeoff --brdf --dim 3");
  expect_usage_error("tradeoff --max-bytes 700");
  expect_refused("tradeoff --families nobody", "unknown family 'nobody'");
  expect_refused("tradeoff --families frank --dim 1", "1");
  expect_refused("tradeoff --families frank --rows 0", "n must be 1 or more, got 0");
  expect_refused("tradeoff --families frank --rows 5 -o t.jpg", "t.jpg: a plot must end in .png or .svg");
  expect_refused("tradeoff --families frank --rows 5 --csv missing/t.csv", "missing/t.csv: its folder does not exist");
  expect_usage_error("tradeoff --rows many");
}

}  // namespace
}  // namespace sklar::cli
