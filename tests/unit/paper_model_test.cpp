#include <gtest/gtest.h>

#include <cmath>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/model/paper_fit.hpp"
#include "brdf/study/metrics.hpp"
#include "copula/error.hpp"
#include "families/registry.hpp"

namespace sklar::brdf {
namespace {

constexpr double kStoredAsFloat = 3e-7;  // masses and scale are floats: five factors of 2^-24 each

// Directions in the upper hemisphere, grazing ones and the normal among them.
Directions random_directions(Eigen::Index count, std::uint64_t seed) {
  Rng rng(seed);
  Directions w(count, 3);
  for (Eigen::Index row = 0; row < count; ++row) {
    const double z = row % 7 == 0 ? 1e-3 * uniform(rng) : row % 11 == 0 ? 1 : uniform(rng);
    const double phi = 6.283185307179586 * uniform(rng), radius = std::sqrt(1 - z * z);
    w.row(row) << radius * std::cos(phi), radius * std::sin(phi), z;
  }
  return w;
}

// A table that is a product of margins within each slice of the default model: independence fits it exactly.
MeasuredTable separable_table() {
  MeasuredTable table;
  table.name = "separable";
  table.valid.assign(Grid::cells, 1);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    std::vector<double>& values = table.values[channel];
    values.resize(Grid::cells);
    for (int i = 0; i < Grid::theta_h; ++i) {
      for (int j = 0; j < Grid::theta_d; ++j) {
        for (int k = 0; k < Grid::phi_d; ++k) {
          values[static_cast<std::size_t>(Grid::index(i, j, k))] =
              (1.0 + static_cast<double>(channel)) / (1 + i) * (1 + j % 15) * (2 + std::cos(0.03 * k));
        }
      }
    }
  }
  return table;
}

// The built-in material with its red and blue taken away, which makes fits three times faster.
MeasuredTable green_builtin() {
  MeasuredTable table = builtin_material();
  std::fill(table.values[0].begin(), table.values[0].end(), 0.0);
  std::fill(table.values[2].begin(), table.values[2].end(), 0.0);
  return table;
}

PaperFit fit_builtin(const FamilyInfo& family, const PaperFitOptions& options = {}) {
  static const MeasuredTable table = builtin_material();
  return fit_paper(table, family, options);
}

TEST(PaperModel, ReproducesATableOfIndependentMargins) {
  const MeasuredTable table = separable_table();
  const PaperFit fit = fit_paper(table, families::find("independence"));
  const CellValues model = predict(*fit.brdf, table);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    double worst = 0;
    for (std::size_t cell = 0; cell < model[channel].size(); ++cell) {
      const double f = table.values[channel][cell], g = model[channel][cell];
      if (g > 0) worst = std::max(worst, std::abs(g / f - 1));
    }
    EXPECT_LT(worst, kStoredAsFloat) << "channel " << channel;
    EXPECT_GT(worst, 0) << "nothing was compared";
  }
}

TEST(PaperModel, EveryFamilyKeepsTheMassOfASlice) {
  const MeasuredTable table = green_builtin();
  for (const FamilyInfo& family : families::all()) {
    const PaperFit fit = fit_paper(table, family, {.method = FitMethod::tau_inversion});
    double table_mass = 0, model_mass = 0;
    for (int i = 0; i < Grid::theta_h; ++i) {
      for (int j = 30; j < 45; ++j) {
        for (int k = 0; k < Grid::phi_d; ++k) {
          table_mass += table.values[1][static_cast<std::size_t>(Grid::index(i, j, k))];
          model_mass += fit.brdf->at({Grid::theta_h_centre(i), Grid::theta_d_centre(j), Grid::phi_d_centre(k)})[1];
        }
      }
    }
    EXPECT_NEAR(model_mass / table_mass, 1, kStoredAsFloat) << family.name;
  }
}

TEST(PaperModel, IsReciprocalFiniteAndTheSameInABatch) {
  const PaperFit fit = fit_builtin(families::all().back(), {.slices = 6, .method = FitMethod::tau_inversion});
  const Directions wo = random_directions(3000, 1), wi = random_directions(3000, 2);
  const RgbRows batch = fit.brdf->eval(wo, wi), swapped = fit.brdf->eval(wi, wo);
  EXPECT_TRUE((batch == swapped).all());
  EXPECT_TRUE((batch >= 0).all() && batch.isFinite().all());
  for (Eigen::Index row = 0; row < wo.rows(); ++row) {
    const Rgb single = fit.brdf->eval(Vec3(wo.row(row).transpose()), Vec3(wi.row(row).transpose()));
    ASSERT_TRUE((single == batch.row(row).transpose()).all()) << row;
  }
  EXPECT_TRUE((fit.brdf->eval(Vec3(0, 0, 1), Vec3(0, 0, 1)) > 0).all());
  EXPECT_TRUE((fit.brdf->eval(Vec3(0, 0, 1), Vec3(1, 0, 0)) == 0).all());
}

TEST(PaperModel, ADependenceParameterHelpsOnTheBuiltInMaterial) {
  const MeasuredTable table = green_builtin();
  const auto error = [&](const FamilyInfo& family) {
    const PaperFit fit = fit_paper(table, family, {.slices = 3});
    for (const auto& channel : fit.fits) {
      for (const FitResult& slice : channel) EXPECT_NE(slice.status, FitStatus::failed) << slice.message;
    }
    return cell_errors(table, predict(*fit.brdf, table)).rel_l2[1];
  };
  const double independent = error(families::find("independence"));
  EXPECT_LT(error(families::find("frank")), independent);
}

TEST(PaperModel, SolidAngleMeasureSumsToTheHemisphere) {
  // int 4 cos(theta_d) d(omega_h) d(omega_d) over both hemispheres = 4 (2 pi) pi = 8 pi^2, phi_d over [0, pi) here.
  double sum = 0;
  for (int i = 0; i < Grid::theta_h; ++i) {
    for (int j = 0; j < Grid::theta_d; ++j) sum += Grid::phi_d * cell_measure(i, j);
  }
  EXPECT_NEAR(sum / (4 * std::pow(3.141592653589793, 2)), 1, 1e-4);  // midpoint rule in theta_d
  const PaperFit fit = fit_builtin(families::find("independence"), {.measure = CellMeasure::per_solid_angle});
  EXPECT_EQ(fit.brdf->measure(), CellMeasure::per_solid_angle);
}

TEST(PaperModel, ABlackChannelStaysBlack) {
  const PaperFit fit = fit_paper(green_builtin(), families::find("independence"));
  const Rgb value = fit.brdf->eval(Vec3(0, 0.6, 0.8), Vec3(0.6, 0, 0.8));
  EXPECT_GT(value[1], 0);
  EXPECT_EQ(value[2], 0);
  EXPECT_EQ(fit.fits[2][0].message, "black");
}

TEST(PaperModel, SurvivesItsFileBitForBit) {
  const PaperFit fit = fit_builtin(families::find("clayton"), {.slices = 2, .method = FitMethod::tau_inversion});
  const StoredBrdf stored{.material = "synthetic",
                          .provenance = Provenance::synthetic,
                          .model = fit.brdf,
                          .method = FitMethod::tau_inversion};
  const StoredBrdf read = parse_brdf(to_json(stored), "model.json");
  EXPECT_EQ(to_json(read), to_json(stored));
  const Directions wo = random_directions(200, 3), wi = random_directions(200, 4);
  EXPECT_TRUE((read.brdf()->eval(wo, wi) == fit.brdf->eval(wo, wi)).all());
}

TEST(PaperModel, RefusesBadFilesWithOneLine) {
  const auto failure = [](const std::string& text) -> std::string {
    try {
      (void)parse_brdf(text, "model.json");
    } catch (const FileError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(failure("{"), "model.json: is not valid JSON: byte 2");
  EXPECT_EQ(failure("{}"), "model.json: expected \"format\": \"sklar brdf\"");
  EXPECT_EQ(failure(R"({"format": "sklar brdf", "version": 99})"),
            "model.json: has version 99; this program reads versions 1 to 4");
  const PaperFit fit = fit_builtin(families::find("independence"), {.slices = 1});
  std::string text = to_json({.material = "m", .model = fit.brdf});
  text.replace(text.find("\"independence\""), 14, "\"gauss\"");
  EXPECT_NE(failure(text).find("unknown family 'gauss'; known families: "), std::string::npos) << failure(text);
}

TEST(PaperModel, RefusesBadArguments) {
  const MeasuredTable table = builtin_material();
  const FamilyInfo& family = families::all().front();
  EXPECT_THROW((void)fit_paper(table, family, {.slices = 7}), std::invalid_argument);
  EXPECT_THROW((void)fit_paper(table, family, {.slices = 0}), std::invalid_argument);
  EXPECT_THROW((void)fit_paper(MeasuredTable{}, family), std::invalid_argument);
}

}  // namespace
}  // namespace sklar::brdf
