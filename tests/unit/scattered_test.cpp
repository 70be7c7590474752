#include "brdf/data/scattered.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/analytic/ggx.hpp"
#include "brdf/data/material.hpp"
#include "brdf/data/tabulate.hpp"
#include "brdf/geometry/frame.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/random.hpp"
#include "tests/support/function_brdf.hpp"
#include "tests/support/message.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;

const Ggx kGloss({0.9, 0.6, 0.3}, 0.3);
const test::FunctionBrdf kCoated([](const Vec3& wo, const Vec3& wi) -> Rgb {
  return 0.2 / kPi + 0.6 * kGloss.eval(wo, wi);
});

/// Pairs of directions up to 85 degrees, half of them along the lobe.
std::vector<ScatteredSample> measurements(int count) {
  Rng rng(9);
  std::vector<ScatteredSample> samples;
  while (samples.size() < static_cast<std::size_t>(count)) {
    const Vec3 wo = spherical_direction(1.48 * uniform(rng), 2 * kPi * uniform(rng));
    const double first = uniform(rng), second = uniform(rng);
    const bool along = samples.size() % 2 == 0;
    const Vec3 wi = along ? kGloss.sample(wo, {first, second}).wi : spherical_direction(1.48 * first, 2 * kPi * second);
    if (wi.z() > 0.05) samples.push_back({wo, wi, kCoated.eval(wo, wi)});
  }
  return samples;
}

/// Median over the valid cells with both angles at most 80 degrees of the relative error.
double error(const MeasuredTable& table) {
  const MeasuredTable expected = tabulate(kCoated, "expected", Provenance::unknown);
  std::vector<double> errors;
  for (std::size_t cell = 0; cell < Grid::cells; ++cell) {
    if (table.valid[cell]) errors.push_back(std::abs(table.values[1][cell] / expected.values[1][cell] - 1));
  }
  return median(errors);
}

TEST(Scattered, MoreSamplesComeNearerToTheReflectance) {
  const MeasuredTable few = tabulate_scattered(measurements(1000), "few", Provenance::measured);
  const MeasuredTable many = tabulate_scattered(measurements(20000), "many", Provenance::measured);
  EXPECT_NO_THROW(require_table("test", many));
  EXPECT_EQ(many.provenance, Provenance::measured);
  EXPECT_EQ(many.report.negative_share, 0);
  EXPECT_LT(error(few), 0.06);
  EXPECT_LT(error(many), 0.02);
  EXPECT_GT(many.valid_cells(), few.valid_cells());
  EXPECT_GT(static_cast<double>(many.valid_cells()), 0.7 * Grid::cells);
}

TEST(Scattered, CellsFarFromEverySampleAreMasked) {
  std::vector<ScatteredSample> samples = measurements(5000);
  std::erase_if(samples, [](const ScatteredSample& sample) { return sample.wi.dot(sample.wo) < 0; });  // theta_d <= 45
  const MeasuredTable table = tabulate_scattered(samples, "half", Provenance::unknown);
  EXPECT_TRUE(table.valid[static_cast<std::size_t>(Grid::index(10, 30, 60))]);
  EXPECT_TRUE(table.valid[static_cast<std::size_t>(Grid::index(10, 48, 60))]);
  EXPECT_FALSE(table.valid[static_cast<std::size_t>(Grid::index(10, 60, 60))]);
}

TEST(Scattered, ASampleAtACentreIsKeptAndNegativeOnesCountAsZero) {
  std::vector<ScatteredSample> samples = measurements(500);
  for (ScatteredSample& sample : samples) sample.value = {-1, 1, 2};
  const MeasuredTable table = tabulate_scattered(samples, "constant", Provenance::unknown);
  EXPECT_NEAR(table.report.negative_share, 1.0 / 3, 1e-12);
  for (std::size_t cell = 0; cell < Grid::cells; ++cell) {
    if (!table.valid[cell]) continue;
    ASSERT_EQ(table.values[0][cell], 0);
    ASSERT_NEAR(table.values[2][cell], 2, 1e-12);
  }
  EXPECT_THROW((void)tabulate_scattered(std::span(samples).first(8), "few", Provenance::unknown),
               std::invalid_argument);
}

class ScatteredFiles : public test::TemporaryFolder {
 protected:
  [[nodiscard]] std::filesystem::path write(const std::string& name, const std::string& text) const {
    write_file(folder_ / name, text);
    return folder_ / name;
  }
  void expect_refused(const std::string& name, const std::string& text, const std::string& reason) const {
    const std::filesystem::path path = write(name, text);
    EXPECT_EQ(test::message_of<FileError>([&] { (void)read_material(path); }), path.string() + ": " + reason);
  }
};

TEST_F(ScatteredFiles, TextOfPbrtIsRead) {
  const auto path = write("x.brdf", "# measured\n3 400 550 700  # nm\n0.5 0 0.25 3 1 1 1\n0 0 0 0\n .5 .5 .5\n");
  const std::vector<ScatteredSample> samples = read_pbrt_brdf(path);
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_LT((samples[0].wi - spherical_direction(0.5, 0)).norm(), 1e-15);
  EXPECT_LT((samples[0].wo - spherical_direction(0.25, 3)).norm(), 1e-15);
  EXPECT_LT((samples[0].value - 1).abs().maxCoeff(), 1e-12);
  EXPECT_LT((samples[1].value - 0.5).abs().maxCoeff(), 1e-12);
}

TEST_F(ScatteredFiles, TextOfPbrtIsRefusedByLine) {
  expect_refused("x.brdf", "analytic\n", "line 1: the number of wavelengths must be a number, got 'analytic'");
  expect_refused("x.brdf", "1 500", "line 1: the number of wavelengths must be 2 to 10000, got 1");
  expect_refused("x.brdf", "2 500\n400\n", "line 2: wavelengths must ascend");
  expect_refused("x.brdf", "2 400 500\n0 0 0 0 1 1\n0 0 2 0 1 1\n", "line 3: theta_o must be in [0, pi/2), got 2");
  expect_refused("x.brdf", "2 400 500\n0 0 0 0 1\n", "line 2: f_r is missing at the end of the file");
  expect_refused("x.brdf", "2 400 500\n0 0 0 0 1 1e\n", "line 2: f_r must be a number, got '1e'");
}

TEST_F(ScatteredFiles, CsvIsReadAsAMaterial) {
  std::string text = "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z,r,g,b\n";
  for (const ScatteredSample& sample : measurements(3000)) {
    for (const Vec3& w : {sample.wi, sample.wo}) {
      for (int k = 0; k < 3; ++k) text += sklar::to_text(w[k]) + ",";
    }
    text += sklar::to_text(sample.value[0]) + "," + sklar::to_text(sample.value[1]) + "," +
            sklar::to_text(sample.value[2]) + "\n";
  }
  const MeasuredTable table = load_material(write("coated.csv", text), Provenance::measured);
  EXPECT_EQ(table.name, "coated");
  EXPECT_EQ(table.provenance, Provenance::measured);
  EXPECT_LT(error(table), 0.04);
}

TEST_F(ScatteredFiles, CsvIsRefusedByLine) {
  const std::string header = "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z,r,g,b\n";
  expect_refused("x.csv", "a,b\n1,2\n", "line 1: the header must be wi_x,wi_y,wi_z,wo_x,wo_y,wo_z,r,g,b");
  expect_refused("x.csv", header + "0,0,1,0,0,1,1,1,1\n0,0,1,0,0,2,1,1,1\n", "line 3: wo must have length 1, got 2");
  expect_refused("x.csv", header + "0,0,-1,0,0,1,1,1,1\n", "line 2: wi_z must be positive, got -1");
  expect_refused("x.csv", header + "0,0,1,0,0,1,1,inf,1\n", "line 2: r, g and b must be finite");
}

}  // namespace
}  // namespace sklar::brdf
