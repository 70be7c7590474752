#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "brdf/data/cell_directions.hpp"
#include "brdf/data/table_brdf.hpp"
#include "brdf/geometry/frame.hpp"
#include "copula/random.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
// Coordinates of a centre come back to about 1e-12 cells at worst (theta_h near 90 degrees), and values lie in [0,2].
constexpr double kCentre = 1e-11;
constexpr double kDirection = 1e-15;  ///< of sums of two products

bool above_horizon(int i, int j, int k) {
  const DirectionPair pair = directions({Grid::theta_h_centre(i), Grid::theta_d_centre(j), Grid::phi_d_centre(k)});
  return pair.wi.z() > 0 && pair.wo.z() > 0;
}

template <class F>
MeasuredTable filled(F value) {
  MeasuredTable table;
  table.valid.assign(Grid::cells, 1);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    table.values[channel].resize(Grid::cells);
    for (int i = 0; i < Grid::theta_h; ++i) {
      for (int j = 0; j < Grid::theta_d; ++j) {
        for (int k = 0; k < Grid::phi_d; ++k) {
          table.values[channel][static_cast<std::size_t>(Grid::index(i, j, k))] = value(channel, i, j, k);
        }
      }
    }
  }
  return table;
}

MeasuredTable random_table() {
  Rng rng(1);
  return filled([&](std::size_t, int, int, int) { return 2 * uniform(rng); });
}

TableBrdf brdf(MeasuredTable table) {
  return TableBrdf(std::make_shared<const MeasuredTable>(std::move(table)));
}

TEST(Grid, CentresAndIndex) {
  EXPECT_DOUBLE_EQ(Grid::theta_h_centre(0), kPi / 2 / 32400);
  EXPECT_DOUBLE_EQ(Grid::theta_h_centre(89), kPi / 2 * std::pow(89.5 / 90, 2));
  EXPECT_DOUBLE_EQ(Grid::theta_d_centre(44), 44.5 * kPi / 180);
  EXPECT_DOUBLE_EQ(Grid::phi_d_centre(179), 179.5 * kPi / 180);
  EXPECT_EQ(Grid::index(0, 0, 1), 1);
  EXPECT_EQ(Grid::index(0, 1, 0), 180);
  EXPECT_EQ(Grid::index(89, 89, 179), Grid::cells - 1);
}

TEST(Grid, AQuarterOfTheCellsIsBelowTheHorizon) {
  int below = 0;
  for (int i = 0; i < Grid::theta_h; ++i) {
    for (int j = 0; j < Grid::theta_d; ++j) {
      for (int k = 0; k < Grid::phi_d; ++k) below += !above_horizon(i, j, k);
    }
  }
  EXPECT_NEAR(100.0 * below / Grid::cells, 24.8, 0.05);
}

TEST(CellDirections, AreThoseAtTheCentres) {
  for (int i = 0; i < Grid::theta_h; i += 4) {
    for (int j = 0; j < Grid::theta_d; ++j) {
      for (int k = 0; k < Grid::phi_d; ++k) {
        const DirectionPair expected =
            directions({Grid::theta_h_centre(i), Grid::theta_d_centre(j), Grid::phi_d_centre(k)});
        const DirectionPair pair = cell_directions(i, j, k);
        ASSERT_LE((pair.wi - expected.wi).norm() + (pair.wo - expected.wo).norm(), kDirection)
            << i << ' ' << j << ' ' << k;
      }
    }
  }
}

TEST(TableBrdf, ReproducesCellCentres) {
  const TableBrdf model = brdf(random_table());
  double worst = 0;
  for (int i = 0; i < Grid::theta_h; ++i) {
    for (int j = 0; j < Grid::theta_d; j += 7) {
      for (int k = 0; k < Grid::phi_d; ++k) {
        if (!above_horizon(i, j, k)) continue;
        const DirectionPair pair =
            directions({Grid::theta_h_centre(i), Grid::theta_d_centre(j), Grid::phi_d_centre(k)});
        const Rgb found = model.eval(pair.wo, pair.wi);
        for (int channel = 0; channel < 3; ++channel) {
          const double stored =
              model.table().values[static_cast<std::size_t>(channel)][static_cast<std::size_t>(Grid::index(i, j, k))];
          worst = std::max(worst, std::abs(found[channel] - stored));
        }
      }
    }
  }
  EXPECT_LE(worst, kCentre);
}

TEST(TableBrdf, IsLinearBetweenCentresPeriodicAndClamped) {
  const TableBrdf model = brdf(filled([](std::size_t channel, int i, int j, int k) {
    return channel == 0 ? 1.0 * i : channel == 1 ? 1.0 * j : 1.0 * k;
  }));
  const auto theta_h = [](double x) { return x * x / 8100 * kPi / 2; };
  const auto degrees = [](double angle) { return angle * kPi / 180; };
  const Rgb inside = model.at({theta_h(20.75), degrees(33.1), degrees(60.9)});
  EXPECT_NEAR(inside[0], 20.25, kCentre);
  EXPECT_NEAR(inside[1], 32.6, kCentre);
  EXPECT_NEAR(inside[2], 60.4, kCentre);
  const Rgb low = model.at({0, 0, degrees(0.2)});
  EXPECT_EQ(low[0], 0);
  EXPECT_EQ(low[1], 0);
  EXPECT_NEAR(low[2], 0.3 * 179, 1e-9);  // between cell 179 and cell 0
  const Rgb high = model.at({kPi / 2, kPi / 2, degrees(179.9)});
  EXPECT_EQ(high[0], 89);
  EXPECT_EQ(high[1], 89);
  EXPECT_NEAR(high[2], 0.6 * 179, 1e-9);
}

TEST(TableBrdf, ReciprocalToTheLastBitAndDarkBelowTheHorizon) {
  const TableBrdf model = brdf(random_table());
  Rng rng(2);
  for (int n = 0; n < 20000; ++n) {
    const Vec3 wi = spherical_direction(std::acos(2 * uniform(rng) - 1), 2 * kPi * uniform(rng));
    const Vec3 wo = spherical_direction(std::acos(uniform(rng)), 2 * kPi * uniform(rng));
    const Rgb there = model.eval(wo, wi);
    ASSERT_TRUE((there == model.eval(wi, wo)).all());
    ASSERT_EQ((there > 0).all(), wi.z() > 0);
  }
}

TEST(TableBrdf, RefusesIncompleteTables) {
  EXPECT_THROW(TableBrdf(nullptr), std::invalid_argument);
  EXPECT_THROW(brdf(MeasuredTable{}), std::invalid_argument);
}

TEST(MeasuredTable, MirrorAsymmetryIsTheMedianOverPairs) {
  EXPECT_EQ(mirror_asymmetry(filled([](std::size_t, int i, int j, int) { return 1.0 + i + j; })), 0);
  EXPECT_NEAR(mirror_asymmetry(filled([](std::size_t, int, int, int k) { return k < 90 ? 1.1 : 0.9; })), 0.2, 1e-12);
}

}  // namespace
}  // namespace sklar::brdf
