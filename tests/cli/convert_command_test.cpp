#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/data/merl.hpp"
#include "brdf/geometry/frame.hpp"
#include "copula/inference/csv.hpp"
#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

class ConvertCommand : public CommandTest {};

TEST_F(ConvertCommand, ConvertKeepsEveryBit) {
  brdf::write_merl(folder_ / "builtin.binary", brdf::builtin_material());
  const std::string bytes = read("../builtin.binary");
  write("in.binary", bytes);
  ASSERT_EQ(run("brdf convert in.binary out.binary").status, 0);
  EXPECT_TRUE(read("out.binary") == bytes);
  expect_refused("brdf convert in.binary out.xyz", "out.xyz: ");
  expect_refused("brdf convert in.binary missing/out.binary", "missing/out.binary: cannot be written");
  expect_refused("brdf convert in.binary out.json", "in.binary: is no model; `sklar brdf fit` makes one of it");
  expect_refused("brdf convert in.binary out.binary --form rgb", "--form does not go with .binary");
}

TEST_F(ConvertCommand, ConvertWritesFilesForRenderers) {
  constexpr double kReadBack = 0.02;  // relative, where two formats interpolate between nodes of their own
  write("in.csv", "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z\n0.6,0,0.8,0,0,1\n0,0.6,0.8,-0.48,0.36,0.8\n");
  const Table original = parse_csv(run("brdf eval --directions in.csv").out, "original");
  for (const std::string form : {"rgb", "spectra"}) {
    const Result result = run("brdf convert synthetic out.bsdf --json --form " + form);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_LE(nlohmann::json::parse(result.out)["albedo"].get<double>(), 1.0);
    const Table back = parse_csv(run("brdf eval out.bsdf --directions in.csv").out, form);
    for (Index row = 0; row < 2; ++row) {
      for (Index channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(back.values(row, channel) / original.values(row, channel), 1, kReadBack);
      }
    }
  }
  const Result dim = run("brdf convert synthetic dim.bsdf --max-albedo 0.1 --json");
  EXPECT_NEAR(nlohmann::json::parse(dim.out)["albedo"].get<double>(), 0.1, 1e-6);
  EXPECT_EQ(run("brdf convert out.bsdf out.binary").status, 0);
  expect_refused("brdf convert synthetic bad.bsdf --max-albedo 0", "limit_albedo: the limit is 0, it must be positive");
  expect_usage_error("brdf convert synthetic bad.bsdf --form xyz");
}

TEST_F(ConvertCommand, ScatteredMeasurementsAreAMaterial) {
  const brdf::Ggx gloss({0.2, 0.5, 0.8}, 0.4);
  std::string text = "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z,r,g,b\n";
  for (int i = 0; i < 12; ++i) {
    for (int o = 0; o < 12; ++o) {
      for (int k = 0; k < 12; ++k) {
        const brdf::Vec3 wi = brdf::spherical_direction(0.12 * i, 0),
                         wo = brdf::spherical_direction(0.12 * o, 0.26 * k);
        for (const double x : {wi.x(), wi.y(), wi.z(), wo.x(), wo.y(), wo.z()}) text += std::to_string(x) + ",";
        const brdf::Rgb f = gloss.eval(wo, wi);
        text += std::to_string(f[0]) + "," + std::to_string(f[1]) + "," + std::to_string(f[2]) + "\n";
      }
    }
  }
  write("gloss.csv", text);
  write("in.csv", "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z\n0.6,0,0.8,0,0,1\n");
  const Result result = run("brdf eval gloss.csv --directions in.csv");
  ASSERT_EQ(result.status, 0) << result.err;
  const double expected = gloss.eval(brdf::Vec3(0, 0, 1), brdf::Vec3(0.6, 0, 0.8))[1];
  EXPECT_NEAR(parse_csv(result.out, "gloss").values(0, 1) / expected, 1, 0.1);
  EXPECT_EQ(run("brdf convert gloss.csv gloss.binary").status, 0);
  write("bad.csv", "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z,r,g,b\n0,0,1,0,0,3,1,1,1\n");
  expect_refused("brdf eval bad.csv --directions in.csv", "bad.csv: line 2: wo must have length 1, got 3");
  write("shader.brdf", "analytic\n");
  expect_refused("brdf convert shader.brdf out.binary", "line 1: the number of wavelengths must be a number");
}

TEST_F(ConvertCommand, ConvertWritesAnAnisotropicModelAsSource) {
  ASSERT_EQ(run("brdf fit synthetic-anisotropic --max-bytes 400 --evaluations 10 -o model.sklar").status, 0);
  const Result result = run("brdf convert model.sklar model.glsl");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(read("model.glsl").find("vec3 sklar_eval(vec3 wo, vec3 wi)"), std::string::npos);
  EXPECT_NE(read("model.glsl").find("sklar_masking"), std::string::npos);
}

TEST_F(ConvertCommand, ConvertWritesAModelAsSource) {
  ASSERT_EQ(run("brdf fit --family independence --max-bytes 600 --evaluations 20 -o model.json").status, 0);
  const std::map<std::string, std::string> parts = {{"model.glsl", "sklar_Sample sklar_sample(vec3 wo, vec2 uniforms)"},
                                                    {"model.hpp", "namespace sklar_synthetic {"},
                                                    {"model.brdf", "::begin shader"}};
  for (const auto& [file, part] : parts) {
    const Result result = run("brdf convert model.json " + file);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_NE(read(file).find(part), std::string::npos) << file;
  }
  ASSERT_EQ(run("brdf fit --mode paper --slices 1 --method tau --family independence -o paper.json").status, 0);
  expect_refused("brdf convert paper.json paper.glsl", "paper.json: written as source are refined models");
  expect_refused("brdf convert material.binary material.glsl", "material.binary: written as source are models");
  auto bright = nlohmann::json::parse(read("model.json"));
  bright["lowest"][0] = bright["lowest"][0].get<double>() + 1;  // of the log of f_r
  write("bright.json", bright.dump());
  const Result limited = run("brdf convert bright.json bright.brdf");
  EXPECT_EQ(limited.status, 0);
  EXPECT_TRUE(limited.out.starts_with("largest directional albedo 1.")) << limited.out;
}

}  // namespace
}  // namespace sklar::cli
