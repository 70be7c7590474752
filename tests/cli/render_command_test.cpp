#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "brdf/render/image.hpp"
#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

class RenderCommand : public CommandTest {
 protected:
  [[nodiscard]] brdf::Image picture(const std::string& name) const { return brdf::read_exr(folder_ / "work" / name); }
};

/// A scene whose mesh is m.obj, with a place for one more key of its object.
std::string mesh_scene(const std::string& more) {
  return R"({"format": "sklar scene", "version": 1, "environment": "studio", "materials": {"m": {"given": 1}},
    "objects": [{"shape": "mesh", "file": "m.obj", "material": "m")" +
         more + "}]}";
}

TEST_F(RenderCommand, RoomIsTheSameOnAnyThreadsAndSwapped) {
  ASSERT_EQ(run("brdf render --scene room --size 18x14 --spp 2 -o a.exr").status, 0);
  EXPECT_TRUE(read("a.png").starts_with("\x89PNG")) << "beside it";
  ASSERT_EQ(run("brdf render --scene room --size 18x14 --spp 2 --threads 1 --swap -o b.exr").status, 0);
  EXPECT_TRUE(read("a.exr") == read("b.exr"));
  ASSERT_EQ(run("brdf render --scene room --size 18x14 --spp 2 --seed 2 -o c.exr").status, 0);
  EXPECT_FALSE(read("a.exr") == read("c.exr"));
}

TEST_F(RenderCommand, SpheresAreOneAMaterial) {
  const Result result =
      run("brdf render synthetic synthetic-anisotropic synthetic --scene spheres --size 10 --spp 8 -o a.exr --json");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto document = nlohmann::json::parse(result.out);
  EXPECT_EQ(document["output"], "a.exr");
  EXPECT_EQ(document["png"], "a.png");
  EXPECT_EQ(document["width"], 30);
  EXPECT_EQ(document["height"], 10);
  const brdf::Image image = picture("a.exr");
  EXPECT_GT(image.at(5, 5, 2), image.at(5, 5, 0)) << "blue";
  EXPECT_LT(image.at(5, 15, 2), image.at(5, 15, 0)) << "brass";
  EXPECT_GT(image.at(5, 25, 2), image.at(5, 25, 0)) << "blue";
}

TEST_F(RenderCommand, FilesAreScenes) {
  const Result result =
      run("brdf render --scene '" SKLAR_EXAMPLE_SCENES "/corner.json' --size 9 --spp 1 -o a.png --json");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["width"], 12);
  EXPECT_TRUE(read("a.png").starts_with("\x89PNG"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "work" / "a.exr"));
}

TEST_F(RenderCommand, FitsWhatASceneShows) {
  const std::string fit = "brdf fit --scene '" SKLAR_EXAMPLE_SCENES "/frontal_sphere.json' --size 24 --spp 1 ";
  const Result result = run(fit + "--evaluations 60 --max-error 34dB -o part.sklar --json");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto document = nlohmann::json::parse(result.out);
  EXPECT_LT(document["scene"]["bytes"].get<int>(), document["general"]["bytes"].get<int>());
  EXPECT_GE(document["scene"]["psnr_gamma_db"].get<double>(), 34);
  EXPECT_TRUE(read("part_scene.png").starts_with("\x89PNG"));
  write("pairs.csv", "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z\n0.8,0,0.6,-0.8,0,0.6\n0.8,0,0.6,0.8,0,0.6\n");
  const Result values = run("brdf eval part.sklar --directions pairs.csv");
  EXPECT_EQ(values.status, 0);
  EXPECT_NE(values.err.find("part.sklar was not fitted to 1 of 2 pairs"), std::string::npos) << values.err;
  const Result room = run("brdf render part.sklar --scene room --size 8 --spp 1 -o room.png");
  EXPECT_EQ(room.status, 0);
  EXPECT_NE(room.err.find("of the light that it reflects in this scene"), std::string::npos) << room.err;
  EXPECT_EQ(run(fit + "--max-error 40 -o bad.json").status, 1);
  EXPECT_EQ(run(fit + "--max-error -3dB -o bad.json").status, 1);
  EXPECT_EQ(run("brdf fit --max-error 40dB -o bad.json").status, 1);
  EXPECT_EQ(run("brdf fit --mode paper --scene room -o bad.json").status, 1);
  EXPECT_EQ(run("brdf fit synthetic-anisotropic --scene room -o bad.json").status, 1);
}

TEST_F(RenderCommand, ExposureIsOfThePngAlone) {
  write("m.obj", "v -9 -9 0\nv 9 -9 0\nv 0 9 0\nf 1 2 3\n");
  write("scene.json", mesh_scene(""));
  std::string bright = mesh_scene("");
  write("bright.json", bright.replace(1, 0, "\"exposure\": 3,"));
  ASSERT_EQ(run("brdf render --scene scene.json --size 4 --spp 1 -o a.exr").status, 0);
  ASSERT_EQ(run("brdf render --scene bright.json --size 4 --spp 1 -o b.exr").status, 0);
  EXPECT_EQ(read("a.exr"), read("b.exr"));
  EXPECT_NE(read("a.png"), read("b.png"));
}

TEST_F(RenderCommand, BadScenesAreOneLine) {
  const auto refused = [&](const std::string& scene, const std::string& text) {
    write("scene.json", scene);
    expect_refused("brdf render --scene scene.json --size 4 --spp 1 -o a.exr", text);
  };
  refused(mesh_scene(""), "m.obj: no such file");
  write("m.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n");
  refused(mesh_scene(""), "m.obj: line 2: a coordinate is not finite");
  write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  refused(mesh_scene(", \"emision\": 1"),
          "scene.json: object 1: unknown key 'emision'; the nearest known is 'emission'");
  refused("", "scene.json: is not valid JSON");
  refused(R"({"format": "sklar scene", "version": 1, "objects": []})", "scene.json: the scene has no light");
  expect_refused("brdf render --scene none.json -o a.exr", "none.json: no such file");
}

TEST_F(RenderCommand, BadOptionsAreRefused) {
  expect_refused("brdf render --spp 4 -o a.exr", "--spp: --scene sphere is computed without samples");
  expect_refused("brdf render synthetic synthetic -o a.exr", "--scene sphere takes one material");
  expect_refused("brdf render --size 8x9 -o a.exr", "--size 8x9: --scene sphere is square");
  expect_usage_error("brdf render --scene room --size 8y9 -o a.exr");
  expect_usage_error("brdf render --scene attic -o a.exr");
  expect_refused("brdf render --scene room --size 0x9 -o a.exr", "size must be at least 1 x 1 pixels, got 0 x 9");
  expect_refused("brdf render --scene room --size 99999 -o a.exr", "size must be at most 2^26 pixels");
  expect_refused("brdf render none.json --scene room -o a.exr", "none.json: no such file");
  expect_usage_error("brdf render --scene room --spp 0 -o a.exr");
}

TEST_F(RenderCommand, InterruptedItLeavesNothing) {
  const std::string command = "cd '" + (folder_ / "work").string() +
                              "' && timeout -s INT 0.5 '" SKLAR_COMMAND
                              "' brdf render --scene room --spp 100000 -o a.exr 2>/dev/null";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 124);
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "work"));
}

}  // namespace
}  // namespace sklar::cli
