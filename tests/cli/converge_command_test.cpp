#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

using ConvergeCommand = CommandTest;

TEST_F(ConvergeCommand, WritesTableAndPictures) {
  const Result result = run("brdf converge --size 12 --spp-max 2 --spp-reference 4 --out r");
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string csv = read("r/convergence.csv");
  EXPECT_TRUE(csv.starts_with("sampler,samples,seconds,rms,relative,of_materials\nconditional,1,")) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  for (const char* name : {"r/convergence.png", "r/equal_time.png"}) {
    EXPECT_TRUE(read(name).starts_with("\x89PNG")) << name;
    EXPECT_NE(result.out.find(name), std::string::npos) << name;
  }
  EXPECT_NE(read("r/convergence.svg").find("<svg"), std::string::npos);
}

TEST_F(ConvergeCommand, ErrorsAreTheSameOnAnyThreads) {
  const auto errors = [&](const std::string& more) {
    const Result result =
        run("brdf converge --scene sphere --size 9 --spp-max 1 --spp-reference 2 --json --out r " + more);
    EXPECT_EQ(result.status, 0) << result.err;
    auto document = nlohmann::json::parse(result.out);
    for (auto& row : document["rows"]) row.erase("seconds");
    return document.dump();
  };
  EXPECT_EQ(errors("--threads 1"), errors("--threads 2"));
}

TEST_F(ConvergeCommand, RefusesWhatItCannotDraw) {
  expect_refused("brdf converge synthetic-anisotropic", "anisotropic");
  expect_usage_error("brdf converge --scene nowhere");
  expect_usage_error("brdf converge --spp-max 0");
}

}  // namespace
}  // namespace sklar::cli
