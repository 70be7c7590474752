#include "brdf/data/anisotropic_table.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/analytic/all.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/data/anisotropic_brdf.hpp"
#include "brdf/data/isotropy.hpp"
#include "brdf/data/tabulate.hpp"
#include "brdf/geometry/frame.hpp"
#include "copula/random.hpp"
#include "tests/support/function_brdf.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSingle = 1e-6;  // values are stored in single precision
constexpr AnisotropicGrid kSmall{.theta_h = 12, .phi_h = 24, .theta_d = 9, .phi_d = 8};

/// Up to `degrees` from the normal.
Vec3 random_direction(Rng& rng, double degrees) {
  const double low = std::cos(degrees * kPi / 180);
  return spherical_direction(std::acos(low + (1 - low) * uniform(rng)), 2 * kPi * uniform(rng));
}

/// GGX with its axes turned by an angle about z.
test::FunctionBrdf turned_ggx(double alpha_x, double alpha_y, double angle) {
  const Ggx model({0.2, 0.5, 0.8}, alpha_x, alpha_y);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(-angle, Vec3::UnitZ()).toRotationMatrix();
  return test::FunctionBrdf([=](const Vec3& wo, const Vec3& wi) { return model.eval(turn * wo, turn * wi); },
                            {.isotropic = false});
}

AnisotropicTable table_of(const Brdf& model, const AnisotropicGrid& grid = kSmall) {
  return tabulate_anisotropic(model, "test", Provenance::synthetic, grid);
}

TEST(AnisotropicGrid, StoresEachCellOnce) {
  for (const auto& [turns, mirrored] : {std::pair(1, false), {2, false}, {1, true}, {2, true}, {24, false}}) {
    AnisotropicGrid grid = kSmall;
    grid.turns = turns;
    grid.mirrored = mirrored;
    EXPECT_NO_THROW(grid.require("test"));
    std::vector<int> visits(grid.stored_cells());
    for (int i = 0; i < grid.theta_h; ++i) {
      for (int m = 0; m < grid.phi_h; ++m) {
        for (int j = 0; j < grid.theta_d; ++j) {
          for (int k = 0; k < grid.phi_d; ++k) ++visits.at(grid.index(i, m, j, k));
        }
      }
    }
    for (const int count : visits) ASSERT_EQ(count, grid.phi_h / grid.stored_phi_h());
  }
  EXPECT_EQ(AnisotropicGrid().stored_cells(), 9331200U);
}

TEST(AnisotropicGrid, RefusesWhatItCannotHold) {
  const auto refused = [](AnisotropicGrid grid, const std::string& text) {
    try {
      grid.require("test");
      ADD_FAILURE() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  refused({.theta_d = 0}, "test: the grid has a count of 0, expected 1 or more");
  refused({.turns = 5}, "has 144 cells of phi_h, which 5 turns do not divide");
  refused({.phi_h = 6, .turns = 2, .mirrored = true},
          "has 6 cells of phi_h, which 2 turns and the mirror do not divide");
  refused({.theta_h = 1 << 20, .phi_h = 1 << 20}, "has more than 67108864 cells");
}

TEST(AnisotropicGrid, LightOfAConstantIsItsReflectance) {
  // Half of the pairs, phi_d in [0, pi): the integral of cos_i cos_o over both hemispheres is pi^2.
  constexpr AnisotropicGrid kFine{.theta_h = 200, .phi_h = 2, .theta_d = 200, .phi_d = 200};
  double sum = 0;
  for (int i = 0; i < kFine.theta_h; ++i) {
    for (int j = 0; j < kFine.theta_d; ++j) {
      for (int k = 0; k < kFine.phi_d; ++k) sum += kFine.phi_h * kFine.light(i, j, k);
    }
  }
  EXPECT_NEAR(2 * sum / (kPi * kPi), 1, 1e-4);
}

TEST(AnisotropicTableBrdf, ReadsTheModelBack) {
  // The figures of anisotropic_brdf.hpp: angles up to 80 degrees, half of the pairs along the lobe.
  const BrdfPtr model = brushed_metal();
  const AnisotropicGrid grid{.turns = 2, .mirrored = true};
  const AnisotropicTableBrdf read(std::make_shared<const AnisotropicTable>(table_of(*model, grid)));
  EXPECT_FALSE(read.traits().isotropic);
  EXPECT_EQ(read.bytes(), grid.stored_cells() * 13);
  Rng rng(1);
  std::vector<double> errors;
  while (errors.size() < 20000) {
    const Vec3 wo = random_direction(rng, 80);
    const double first = uniform(rng);
    const Vec3 wi = errors.size() % 2 == 0 ? model->sample(wo, {first, uniform(rng)}).wi : random_direction(rng, 80);
    if (wi.z() < std::cos(80 * kPi / 180)) continue;
    errors.push_back((read.eval(wo, wi) / model->eval(wo, wi) - 1).abs().mean());
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_NEAR(errors[errors.size() / 2], 0.0027, 0.0003);
  EXPECT_NEAR(errors[errors.size() * 99 / 100], 0.014, 0.002);
}

TEST(AnisotropicTableBrdf, ReproducesCellCentresWhateverIsStored) {
  const Ggx model({0.2, 0.5, 0.8}, 0.2, 0.5);
  for (const auto& [turns, mirrored] : {std::pair(1, false), {2, false}, {1, true}, {2, true}}) {
    AnisotropicGrid grid = kSmall;
    grid.turns = turns;
    grid.mirrored = mirrored;
    const AnisotropicTableBrdf read(std::make_shared<const AnisotropicTable>(table_of(model, grid)));
    for (int m = 0; m < grid.phi_h; ++m) {
      for (int k = 0; k < grid.phi_d; ++k) {
        const DirectionPair pair = directions4(grid.centre(4, m, 3, k));
        ASSERT_LT((read.eval(pair.wo, pair.wi) / model.eval(pair.wo, pair.wi) - 1).abs().maxCoeff(), kSingle)
            << turns << mirrored << " " << m << " " << k;
      }
    }
  }
}

TEST(AnisotropicTableBrdf, ReciprocalToTheLastBitAndDarkBelowTheHorizon) {
  const AnisotropicTableBrdf read(std::make_shared<const AnisotropicTable>(table_of(turned_ggx(0.2, 0.5, 0.4))));
  Rng rng(2);
  for (int n = 0; n < 20000; ++n) {
    const Vec3 wi = random_direction(rng, 180);
    const Vec3 wo = random_direction(rng, 90);
    const Rgb there = read.eval(wo, wi);
    ASSERT_TRUE((there == read.eval(wi, wo)).all());
    ASSERT_TRUE((there >= 0).all() && there.isFinite().all());
    if (!(wi.z() > 0)) {
      ASSERT_TRUE((there == 0).all());
    }
  }
}

TEST(AnisotropicTableBrdf, MaskedCellsTakeNoPart) {
  AnisotropicTable table = table_of(test::FunctionBrdf([](const Vec3&, const Vec3&) { return Rgb(1, 2, 3); }));
  Rng rng(3);
  for (std::size_t cell = 0; cell < table.valid.size(); ++cell) {
    if (uniform(rng) < 0.5) continue;
    table.valid[cell] = 0;
    for (auto& plane : table.values) plane[cell] = 0;
  }
  const AnisotropicTableBrdf read(std::make_shared<const AnisotropicTable>(std::move(table)));
  int seen = 0;
  for (int n = 0; n < 5000; ++n) {
    const auto [value, coverage] = read.at(half_difference4(random_direction(rng, 70), random_direction(rng, 70)));
    ASSERT_TRUE(coverage >= 0 && coverage < 1 + 1e-12);
    if (coverage == 0) {
      ASSERT_TRUE((value == 0).all());
      continue;
    }
    ++seen;
    ASSERT_LT((value - Rgb(1, 2, 3)).abs().maxCoeff(), kSingle);
  }
  EXPECT_GT(seen, 4000);
}

TEST(AnisotropicTable, IncompleteOnesAreRefused) {
  EXPECT_THROW(AnisotropicTableBrdf(nullptr), std::invalid_argument);
  EXPECT_THROW(require_table("test", AnisotropicTable{}), std::invalid_argument);
  AnisotropicTable table = table_of(Lambert(Rgb::Ones()));
  EXPECT_NO_THROW(require_table("test", table));
  table.values[1][7] = -1;
  EXPECT_THROW(require_table("test", table), std::invalid_argument);
  table.values[1][7] = 0;
  std::fill(table.valid.begin(), table.valid.end(), std::uint8_t{0});
  EXPECT_THROW(require_table("test", table), std::invalid_argument);
  const test::FunctionBrdf one_way([](const Vec3&, const Vec3&) { return Rgb(1, 1, 1); }, {.reciprocal = false});
  EXPECT_THROW((void)table_of(one_way), std::invalid_argument);
}

TEST(Isotropy, DeviationIsTheShareOfLightThatMoves) {
  // f_r = 1 + a cos(2 phi_h) deviates by the mean of |a cos| over the azimuths.
  double mean = 0;
  for (int m = 0; m < kProbeGrid.phi_h; ++m) {
    mean += std::abs(std::cos(2 * kProbeGrid.centre(0, m, 0, 0).phi_h)) / kProbeGrid.phi_h;
  }
  EXPECT_NEAR(mean, 2 / kPi, 0.01);
  for (const double a : {0.05, 0.5, 1.0}) {
    const test::FunctionBrdf wave(
        [a](const Vec3& wo, const Vec3& wi) {
          return Rgb::Constant(1 + a * std::cos(2 * half_difference4(wo, wi).phi_h));
        },
        {.isotropic = false});
    EXPECT_NEAR(isotropy_deviation(wave) / (a * mean), 1, 1e-5);
  }
  EXPECT_EQ(isotropy_deviation(Lambert(Rgb::Ones())), 0);
  EXPECT_EQ(isotropy_deviation(Lambert(Rgb::Zero())), 0);
  EXPECT_LT(isotropy_deviation(Ggx(Rgb::Ones(), 0.05)), kSingle);
  EXPECT_GT(isotropy_deviation(Ggx(Rgb::Ones(), 0.2, 0.22)), kSymmetricDeviation);
  EXPECT_LT(isotropy_deviation(Ggx(Rgb::Ones(), 0.2, 0.21)), kSymmetricDeviation);
}

TEST(Isotropy, MeanIsTheIsotropicTable) {
  const Ggx model({0.2, 0.5, 0.8}, 0.3, 0.3);
  const MeasuredTable expected = tabulate(model, "test", Provenance::synthetic);
  const MeasuredTable direct = isotropic_mean(model, "test", Provenance::measured);
  const MeasuredTable stored = isotropic_mean(table_of(model, {}));
  EXPECT_EQ(direct.provenance, Provenance::measured);
  EXPECT_TRUE(direct.valid == expected.valid);
  EXPECT_LE(stored.valid_cells(), expected.valid_cells());
  EXPECT_GT(stored.valid_cells(), expected.valid_cells() * 99 / 100);
  double largest = 0;
  std::vector<double> errors;
  for (std::size_t cell = 0; cell < Grid::cells; ++cell) {
    if (!expected.valid[cell]) continue;
    largest = std::max(largest, std::abs(direct.values[1][cell] / expected.values[1][cell] - 1));
    if (stored.valid[cell]) errors.push_back(std::abs(stored.values[1][cell] / expected.values[1][cell] - 1));
  }
  EXPECT_LT(largest, 1e-9);
  EXPECT_LT(median(errors), 0.005);  // linear interpolation on the grid of four
  EXPECT_THROW((void)isotropic_mean(model, "test", Provenance::unknown, 0), std::invalid_argument);
}

TEST(Isotropy, MeanKeepsTheMask) {
  AnisotropicTable table = table_of(Lambert(Rgb::Ones()));
  for (int m = 0; m < kSmall.phi_h; ++m) {  // nothing at small theta_h
    for (int j = 0; j < kSmall.theta_d; ++j) {
      for (int k = 0; k < kSmall.phi_d; ++k) {
        table.valid[kSmall.index(0, m, j, k)] = 0;
        for (auto& plane : table.values) plane[kSmall.index(0, m, j, k)] = 0;
      }
    }
  }
  const MeasuredTable mean = isotropic_mean(table);
  EXPECT_EQ(mean.valid[Grid::index(0, 20, 20)], 0);
  ASSERT_EQ(mean.valid[Grid::index(40, 20, 20)], 1);
  EXPECT_NEAR(mean.values[0][Grid::index(40, 20, 20)], 1 / kPi, kSingle);
}

TEST(Symmetry, IsFoundAndFolded) {
  const AnisotropicTable both = fold_symmetric(table_of(turned_ggx(0.2, 0.5, 0)));
  EXPECT_EQ(both.grid.turns, 2);
  EXPECT_TRUE(both.grid.mirrored);
  EXPECT_LT(both.report.half_turn_deviation, kSingle);
  EXPECT_LT(both.report.mirror_deviation, kSingle);
  EXPECT_GT(both.report.isotropy_deviation, 0.2);
  EXPECT_NEAR(isotropy_deviation(both), both.report.isotropy_deviation, kSingle);
  const AnisotropicTable direct = table_of(Ggx({0.2, 0.5, 0.8}, 0.2, 0.5), both.grid);
  for (std::size_t cell = 0; cell < direct.valid.size(); ++cell) {
    ASSERT_NEAR(both.values[1][cell], direct.values[1][cell], 1e-5F * direct.values[1][cell]) << cell;
  }

  const AnisotropicTable isotropic = fold_symmetric(table_of(turned_ggx(0.3, 0.3, 0)));
  EXPECT_EQ(isotropic.grid.stored_phi_h(), 1);
  EXPECT_TRUE(AnisotropicTableBrdf(std::make_shared<const AnisotropicTable>(isotropic)).traits().isotropic);

  // Axes that are not x and y leave the half turn and break the mirror.
  const AnisotropicTable turned = fold_symmetric(table_of(turned_ggx(0.2, 0.5, 0.5)));
  EXPECT_EQ(turned.grid.turns, 2);
  EXPECT_FALSE(turned.grid.mirrored);
  EXPECT_GT(turned.report.mirror_deviation, 0.1);

  // Grooves that lean to one side leave the mirror and break the half turn.
  const test::FunctionBrdf leaning(
      [](const Vec3& wo, const Vec3& wi) { return Rgb::Constant(1 + 0.5 * (wo + wi).normalized().x()); },
      {.isotropic = false});
  const AnisotropicTable half = fold_symmetric(table_of(leaning));
  EXPECT_EQ(half.grid.turns, 1);
  EXPECT_TRUE(half.grid.mirrored);
  EXPECT_GT(half.report.half_turn_deviation, 0.1);
}

TEST(Symmetry, FoldingAveragesValidCells) {
  AnisotropicTable table = table_of(Lambert(Rgb::Ones()));
  const std::size_t here = kSmall.index(3, 2, 3, 1);
  const std::size_t there = kSmall.index(3, 14, 3, 1);
  table.values[0][here] = 1;
  table.values[0][there] = 3;
  AnisotropicTable mean = folded(table, 2, false);
  EXPECT_EQ(mean.values[0][mean.grid.index(3, 2, 3, 1)], 2);
  table.valid[here] = 0;
  table.values[0][here] = 0;
  mean = folded(table, 2, false);
  EXPECT_EQ(mean.values[0][mean.grid.index(3, 14, 3, 1)], 3);
  EXPECT_EQ(mean.valid[mean.grid.index(3, 14, 3, 1)], 1);
  EXPECT_THROW((void)folded(mean, 1, false), std::invalid_argument);
  EXPECT_THROW((void)folded(mean, 5, false), std::invalid_argument);
  EXPECT_NO_THROW((void)folded(folded(mean, 2, true), kSmall.phi_h, false));
}

}  // namespace
}  // namespace sklar::brdf
