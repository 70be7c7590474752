#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/data/merl.hpp"
#include "brdf/geometry/frame.hpp"
#include "copula/inference/csv.hpp"
#include "tests/cli/run_command.hpp"
#include "tests/support/anisotropic_bsdf.hpp"

namespace sklar::cli {
namespace {

class BrdfCommand : public CommandTest {
 protected:
  /// The built-in material as a MERL file's bytes.
  [[nodiscard]] std::string merl() const {
    brdf::write_merl(folder_ / "builtin.binary", brdf::builtin_material());
    return read("../builtin.binary");
  }
};

constexpr std::size_t kMerlHeader = 3 * sizeof(std::int32_t);

TEST_F(BrdfCommand, EverySubcommandHasHelpAndTheCommonOptions) {
  for (const std::string command : {"albedo", "compare", "convert", "eval", "fit", "render", "sample"}) {
    const Result result = run("brdf " + command + " --help");
    EXPECT_EQ(result.status, 0) << command;
    for (const std::string option : {"--help", "--json", "--seed", "--threads"}) {
      EXPECT_NE(result.out.find(option), std::string::npos) << command << " " << option;
    }
  }
  for (const std::string arguments :
       {"brdf", "brdf eval", "brdf convert", "brdf render", "brdf render --scene x -o a.exr"}) {
    expect_usage_error(arguments);
  }
}

TEST_F(BrdfCommand, AlbedoAtEachDegree) {
  const Result result = run("brdf albedo -o albedo.csv");
  ASSERT_EQ(result.status, 0) << result.err;
  const Table table = parse_csv(read("albedo.csv"), "albedo.csv");
  EXPECT_EQ(table.names, (std::vector<std::string>{"theta_o", "r", "g", "b"}));
  ASSERT_EQ(table.values.rows(), 90);
  EXPECT_DOUBLE_EQ(table.values(89, 0), 89);
  EXPECT_GT(table.values.rightCols<3>().minCoeff(), 0);
  EXPECT_LT(table.values.rightCols<3>().maxCoeff(), 1);
}

TEST_F(BrdfCommand, EvalAnswersInOrder) {
  write("in.csv", "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z\n0,0,1,0.6,0,0.8\n0.6,0,0.8000001,0,0,1\n0.6,0,-0.8,0,0,1\n");
  const Result result = run("brdf eval --directions in.csv");
  ASSERT_EQ(result.status, 0) << result.err;
  const Table table = parse_csv(result.out, "stdout");
  EXPECT_EQ(table.names, (std::vector<std::string>{"r", "g", "b", "pdf"}));
  ASSERT_EQ(table.values.rows(), 3);
  EXPECT_NEAR(table.values(0, 1), table.values(1, 1), 1e-6 * table.values(1, 1)) << "reciprocal";
  EXPECT_GT(table.values.col(3).head(2).minCoeff(), 0);
  EXPECT_TRUE((table.values.row(2) == 0).all()) << "below the horizon";
  const auto document = nlohmann::json::parse(run("brdf eval --directions in.csv --json").out);
  EXPECT_EQ(document["rows"][0][1].get<double>(), table.values(0, 1));
}

TEST_F(BrdfCommand, SampleAndEvalTellTheSame) {
  constexpr double kRounding = 1e-12;  ///< relative, of directions read back and made unit again
  const Result result = run("brdf sample --wo 60,30 -n 40 --seed 7");
  ASSERT_EQ(result.status, 0) << result.err;
  const Table draws = parse_csv(result.out, "stdout");
  EXPECT_EQ(draws.names, (std::vector<std::string>{"wi_x", "wi_y", "wi_z", "pdf", "weight_r", "weight_g", "weight_b"}));
  ASSERT_EQ(draws.values.rows(), 40);
  Points pairs(40, 6);
  pairs.leftCols<3>() = draws.values.leftCols<3>();
  const double sine = std::sqrt(3.0) / 2;
  pairs.rightCols<3>().rowwise() = Eigen::Array<double, 1, 3>(sine * sine, sine / 2, 0.5);
  write("in.csv", to_csv(std::vector<std::string>{"wi_x", "wi_y", "wi_z", "wo_x", "wo_y", "wo_z"}, pairs));
  const Table values = parse_csv(run("brdf eval --directions in.csv").out, "stdout");
  ASSERT_EQ(values.values.rows(), 40);
  for (Index i = 0; i < 40; ++i) {
    const double pdf = draws.values(i, 3);
    EXPECT_NEAR(values.values(i, 3) / pdf, 1, 1e-6) << i;
    EXPECT_NEAR(values.values(i, 1) * pairs(i, 2) / pdf / draws.values(i, 5), 1, 1e-6 + kRounding) << i;
  }
  EXPECT_EQ(run("brdf sample --wo 60,30 -n 40 --seed 7").out, result.out);
  EXPECT_NE(run("brdf sample --wo 60,30 -n 40 --seed 8").out, result.out);
  for (const std::string wo : {"90,0", "-1,0", "60", "60,0,0", "x,0", "nan,0", "60,inf"}) {
    EXPECT_EQ(run("brdf sample -n 2 --wo=" + wo).status, 1) << wo;
  }
  expect_usage_error("brdf sample --wo 60,0");
  expect_usage_error("brdf sample --wo 60,0 -n 0");
}

TEST_F(BrdfCommand, AlbedoInAWhiteFurnace) {
  const Result result = run("brdf albedo --furnace 2000");
  ASSERT_EQ(result.status, 0) << result.err;
  const Table table = parse_csv(result.out, "stdout");
  EXPECT_EQ(table.names, (std::vector<std::string>{"theta_o", "r", "g", "b", "furnace_r", "furnace_g", "furnace_b",
                                                   "sigma_r", "sigma_g", "sigma_b"}));
  // 270 values; the quadrature of a table is good to 2e-3 up to 85 degrees.
  for (Index i = 0; i <= 85; ++i) {
    for (Index c = 1; c <= 3; ++c) {
      EXPECT_NEAR(table.values(i, c + 3), table.values(i, c), 5 * table.values(i, c + 6) + 2e-3 * table.values(i, c));
    }
  }
}

TEST_F(BrdfCommand, AnisotropicMaterialsAreEvaluated) {
  const brdf::BrdfPtr metal = brdf::brushed_metal();
  write("brushed.bsdf", test::tensor_file(test::AnisotropicBsdf(*metal, 0.12, 0.40, {.folds = 4}).fields()));
  write("in.csv", "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z\n0.6,0,0.8,-0.48,0.36,0.8\n0,0.6,0.8,0.36,-0.48,0.8\n");
  // Scatter of 2 % and interpolation; interpolation of 33 x 8 directions of a narrow lobe.
  for (const auto& [material, tolerance] : {std::pair("synthetic-anisotropic", 0.03), {"brushed.bsdf", 0.1}}) {
    const Result result = run(std::string("brdf eval ") + material + " --directions in.csv");
    ASSERT_EQ(result.status, 0) << result.err;
    const Table table = parse_csv(result.out, material);
    const double first = metal->eval(brdf::Vec3(-0.48, 0.36, 0.8), brdf::Vec3(0.6, 0, 0.8))[1];
    const double second = metal->eval(brdf::Vec3(0.36, -0.48, 0.8), brdf::Vec3(0, 0.6, 0.8))[1];
    EXPECT_NEAR(table.values(0, 1) / first, 1, tolerance) << material;
    EXPECT_NEAR(table.values(1, 1) / second, 1, tolerance) << material;
    EXPECT_GT(std::abs(first / second - 1), 0.5);
  }
  EXPECT_NE(run("brdf eval --help").out.find("synthetic-anisotropic"), std::string::npos);
}

TEST_F(BrdfCommand, AnisotropicMaterialsAreRefusedWhereIsotropicOnesAreNeeded) {
  const brdf::Ggx gloss({0.2, 0.5, 0.8}, 0.3, 0.6);
  write("gloss.bsdf", test::tensor_file(test::AnisotropicBsdf(gloss, 0.3, 0.6, {.folds = 4}).fields()));
  for (const auto& [material, deviation] : {std::pair("synthetic-anisotropic", "0.66"), {"gloss.bsdf", "0.40"}}) {
    const std::string reason = std::string(material) + ": is anisotropic (isotropy deviation " + deviation +
                               "); this needs an isotropic material";
    for (const std::string command : {"albedo MATERIAL", "fit MATERIAL --mode paper -o model.json",
                                      "convert MATERIAL a.binary", "compare MATERIAL --out out"}) {
      std::string arguments = "brdf " + command;
      expect_refused(arguments.replace(arguments.find("MATERIAL"), 8, material), reason);
    }
  }
}

TEST_F(BrdfCommand, AnisotropicMaterialsAreFittedAndDrawn) {
  const brdf::BrdfPtr metal = brdf::brushed_metal();
  write("brushed.bsdf", test::tensor_file(test::AnisotropicBsdf(*metal, 0.12, 0.40, {.folds = 4}).fields()));
  const Result fit = run("brdf fit brushed.bsdf --max-bytes 600 --evaluations 60 -o model.json --json");
  ASSERT_EQ(fit.status, 0) << fit.err;
  const auto document = nlohmann::json::parse(fit.out);
  EXPECT_EQ(document["mode"], "anisotropic");
  EXPECT_LE(document["bytes"].get<int>(), 600);
  EXPECT_LT(document["log1p_mae"].get<double>(), 0.01);
  EXPECT_NEAR(document["isotropy_deviation"].get<double>(), 0.66, 0.02);
  write("in.csv", "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z\n0.6,0,0.8,-0.48,0.36,0.8\n");
  const Result eval = run("brdf eval model.json --directions in.csv");
  ASSERT_EQ(eval.status, 0) << eval.err;
  const double expected = metal->eval(brdf::Vec3(-0.48, 0.36, 0.8), brdf::Vec3(0.6, 0, 0.8))[1];
  EXPECT_NEAR(parse_csv(eval.out, "stdout").values(0, 1) / expected, 1, 0.1);
  ASSERT_EQ(run("brdf render model.json --size 12 -o a.exr").status, 0);
  ASSERT_EQ(run("brdf render model.json --size 12 --swap --threads 1 -o b.exr").status, 0);
  EXPECT_TRUE(read("a.exr") == read("b.exr"));
  expect_refused("brdf fit synthetic-anisotropic --family frank -o model.json",
                 "--family frank: the lobes of an anisotropic model have no copula");
}

TEST_F(BrdfCommand, IsotropicMaterialsInAnisotropicFilesAreFittedAsIsotropic) {
  const brdf::Ggx gloss({0.2, 0.5, 0.8}, 0.3);
  write("gloss.bsdf", test::tensor_file(test::AnisotropicBsdf(gloss, 0.3, 0.3, {.folds = 4}).fields()));
  const Result fit = run("brdf fit gloss.bsdf --max-bytes 600 --evaluations 20 -o model.json");
  ASSERT_EQ(fit.status, 0) << fit.err;
  EXPECT_EQ(fit.out.rfind("isotropy deviation 0.0", 0), 0U) << fit.out;
  EXPECT_NE(fit.out.find(": fitted as isotropic\n"), std::string::npos) << fit.out;
  EXPECT_NE(read("model.json").find("\"mode\":\"refined\""), std::string::npos);
}

TEST_F(BrdfCommand, EvalRefusesBadDirections) {
  write("in.csv", "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z\n0,0,1,0,0,1\n0,0,1,0.6,0,0.81\n");
  expect_refused("brdf eval --directions in.csv -o out.csv", "in.csv: line 3: wo must have length 1, got 1.00");
  write("in.csv", "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z\nnan,0,1,0,0,1\n");
  expect_refused("brdf eval --directions in.csv -o out.csv", "line 2: wi must have length 1, got nan");
  write("in.csv", "wi_x,wi_y,wi_z\n0,0,1\n");
  expect_refused("brdf eval --directions in.csv -o out.csv",
                 "line 1: the header must be wi_x,wi_y,wi_z,wo_x,wo_y,wo_z");
  expect_refused("brdf eval --directions missing.csv", "missing.csv: no such file");
}

TEST_F(BrdfCommand, RenderIsTheSameWithSwappedDirections) {
  ASSERT_EQ(run("brdf render --size 24 -o a.exr").status, 0);
  ASSERT_EQ(run("brdf render --size 24 --swap --threads 1 -o b.exr").status, 0);
  EXPECT_TRUE(read("a.exr") == read("b.exr"));
  ASSERT_EQ(run("brdf render --size 24 -o a.png").status, 0);
  EXPECT_TRUE(read("a.png").starts_with("\x89PNG"));
}

TEST_F(BrdfCommand, RenderRefusesWhatCannotBeWritten) {
  expect_refused("brdf render --size 8 -o a.jpg", "a.jpg: a picture ends in .exr or .png");
  expect_refused("brdf render --size 8 -o missing/a.exr", "missing/a.exr: cannot be written");
  expect_refused("brdf render --size 0 -o a.exr", "size");
}

TEST_F(BrdfCommand, FitWritesAModelThatTheOthersRead) {
  const Result fit = run("brdf fit --family independence --evaluations 60 -o model.json --json");
  ASSERT_EQ(fit.status, 0) << fit.err;
  EXPECT_LT(nlohmann::json::parse(fit.out)["log1p_mae"].get<double>(), 0.02);
  write("in.csv", "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z\n0.6,0,0.8,0,0,1\n");
  const Table model = parse_csv(run("brdf eval model.json --directions in.csv").out, "model");
  const Table material = parse_csv(run("brdf eval --directions in.csv").out, "material");
  EXPECT_NEAR(model.values(0, 1) / material.values(0, 1), 1, 0.1);
}

TEST_F(BrdfCommand, FitChoosesTheModelByTheBudget) {
  const Result fit = run("brdf fit --family frank --max-bytes 600 --evaluations 40 -o model.json");
  ASSERT_EQ(fit.status, 0) << fit.err;
  EXPECT_NE(fit.out.find("| chosen |"), std::string::npos) << fit.out;
  const auto model = nlohmann::json::parse(read("model.json"));
  EXPECT_EQ(model["mode"], "refined");
  EXPECT_EQ(model["families"][0], "frank");
  EXPECT_EQ(run("brdf albedo model.json").status, 0);
  ASSERT_EQ(run("brdf convert model.json model.sklar").status, 0);
  EXPECT_LT(read("model.sklar").size(), 700U);
  ASSERT_EQ(run("brdf convert model.sklar again.json").status, 0);
  EXPECT_EQ(read("again.json"), read("model.json"));
  EXPECT_EQ(run("brdf albedo model.sklar").out, run("brdf albedo model.json").out);
  expect_refused("brdf convert model.json model.exr",
                 "model.exr: has extension '.exr', expected one of .json, .sklar, .binary, .bsdf");
}

TEST_F(BrdfCommand, CompareTakesTheRefinedMode) {
  const Result result =
      run("brdf compare --mode refined --max-bytes 600 --evaluations 40 --families independence,frank --out out");
  ASSERT_EQ(result.status, 0) << result.err;
  const auto document = nlohmann::json::parse(read("out/results.json"));
  EXPECT_EQ(document["rows"][1]["mode"], "refined");
  EXPECT_LT(document["rows"][1]["log1p_mae"].get<double>(), 0.02);
}

TEST_F(BrdfCommand, CompareTakesModelsOfEveryKind) {
  const std::string command = "brdf compare --models lambert --budgets 1024 --out out";
  const Result result = run(command);
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("| analytic | lambert |"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("out/models_synthetic.png"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("out/report.html\n"), std::string::npos) << result.out;
  EXPECT_NE(read("out/report.html").find("\"model\":\"lambert\""), std::string::npos);
  const auto document = nlohmann::json::parse(read("out/models.json"));
  ASSERT_EQ(document["rows"].size(), 1U);
  EXPECT_GT(document["rows"][0]["log1p_mae"], 0);
  EXPECT_EQ(run(command + " --json").out, read("out/models.json"));  // from the rows that are kept
  expect_refused("brdf compare --models shiny --out out", "unknown model 'shiny'; known models: all, refined");
  expect_refused("brdf compare --models lambert --budgets 0 --out out", "a budget is 0 bytes; allowed are");
}

TEST_F(BrdfCommand, FitRefusesWhatItCannotDo) {
  expect_refused("brdf fit --family gaussian -o model.json", "unknown family 'gaussian'; known families: ");
  expect_refused("brdf fit --mode paper --family independence --slices 7 -o model.json", "slices");
  expect_refused("brdf fit --slices 6 -o model.json", "--slices belongs to --mode paper");
  expect_refused("brdf fit --max-bytes 100 -o model.json", "no model has at most 100 bytes; the smallest has ");
  expect_refused("brdf fit --family independence -o missing/model.json", "missing/model.json: cannot be written");
  expect_refused("brdf fit --family independence -o . ", ".: cannot be written");
  expect_refused("brdf fit --mode paper -o model.sklar", "model.sklar: a model of mode 'paper' is .json");
  expect_refused("brdf fit missing.binary -o model.json", "missing.binary: no such file");
  write("model.json", "{\"format\": ");
  expect_refused("brdf albedo model.json", "model.json: ");
}

TEST_F(BrdfCommand, ComparePrintsTheTableAndThePaths) {
  const Result result = run("brdf compare --families independence --out out");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(result.out.starts_with("| material")) << result.out;
  const auto document = nlohmann::json::parse(read("out/results.json"));
  EXPECT_EQ(document["rows"][0]["family"], "independence");
  for (const std::string name : {"synthetic_spheres.png", "synthetic_margins.png", "synthetic_joint.png",
                                 "synthetic_albedo.png", "results.csv", "report.html"}) {
    EXPECT_NE(result.out.find("out/" + name + "\n"), std::string::npos) << result.out;
    EXPECT_NE(read("out/" + name), "") << name;
  }
}

TEST_F(BrdfCommand, CompareRefusesWhatItCannotDo) {
  write("file", "");
  write("bad.binary", "");
  expect_refused("brdf compare --out file", "file: ");
  expect_refused("brdf compare bad.binary --out out", "bad.binary: ");
  expect_refused("brdf compare --families frank,gaussian --out out", "unknown family 'gaussian'");
}

TEST_F(BrdfCommand, RefusesBadMaterials) {
  const auto refused = [&](const std::string& name, std::string_view bytes, const std::string& text) {
    write(name, bytes);
    expect_refused("brdf convert " + name + " out.binary", name + ": ");
    expect_refused("brdf albedo " + name + " -o out.csv", text);
  };
  std::string bytes = merl();
  refused("empty.binary", "", "empty.binary: ");
  refused("short.binary", std::string_view(bytes).substr(0, bytes.size() - 1), "34992012");
  refused("long.binary", bytes + "x", "34992012");
  std::string other = bytes;
  other[0] = 91;
  refused("shape.binary", other, "shape.binary: ");
  other = bytes;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(other.data() + kMerlHeader, &nan, sizeof nan);
  refused("nan.binary", other, "nan");
  other = bytes;
  const double masked = -1;
  for (std::size_t i = kMerlHeader; i < other.size(); i += sizeof masked)
    std::memcpy(other.data() + i, &masked, sizeof masked);
  refused("masked.binary", other, "mask");
  refused("empty.bsdf", "", "empty.bsdf: ");
  refused("short.bsdf", "tensor_file", "short.bsdf: ");
  refused("material.xyz", "x", "material.xyz: ");
  expect_refused("brdf albedo missing.binary", "missing.binary: no such file");
  expect_refused("brdf albedo .", ".");
}

}  // namespace
}  // namespace sklar::cli
