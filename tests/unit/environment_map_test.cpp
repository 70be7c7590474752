#include "brdf/render/environment_map.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "brdf/luminance.hpp"
#include "copula/random.hpp"
#include "tests/support/chi_square.hpp"

namespace sklar::brdf {
namespace {
using std::numbers::pi;

constexpr int kRows = 6, kColumns = 9;

/// Radiance over three decades, a black row and black pixels, the last of all among them.
Image patchwork() {
  Image map(kColumns, kRows);
  Rng rng(test::seed_of_this_test());
  for (float& value : map.rgb) value = static_cast<float>(std::pow(10, 3 * uniform(rng) - 2));
  for (int c = 0; c < 3; ++c) {
    for (int column = 0; column < kColumns; ++column) map.at(2, column, c) = 0;
    map.at(0, 0, c) = map.at(4, 3, c) = map.at(kRows - 1, kColumns - 1, c) = 0;
  }
  return map;
}

double solid_angle(int row) {
  return 2 * pi / kColumns * (std::cos(pi * row / kRows) - std::cos(pi * (row + 1) / kRows));
}

Vec3 centre(int row, int column) {
  const double theta = pi * (row + 0.5) / kRows, phi = 2 * pi * ((column + 0.5) / kColumns - 0.5);
  return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

TEST(EnvironmentMap, DensityIntegratesToOne) {
  const EnvironmentMap map(patchwork());
  double sum = 0, light = 0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      sum += map.pdf(centre(row, column)) * solid_angle(row);
      light += luminance(map.radiance(centre(row, column))) * solid_angle(row);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-13);
  EXPECT_NEAR(map.power() / light, 1, 1e-13);
  EXPECT_NEAR(EnvironmentMap::constant(Rgb::Constant(2)).power(), 8 * pi, 1e-6);
  EXPECT_NEAR(EnvironmentMap::constant(Rgb::Constant(2)).pdf({0.6, 0, 0.8}), 1 / (4 * pi), 1e-15);
}

TEST(EnvironmentMap, DrawsFollowTheDensity) {
  const EnvironmentMap map(patchwork());
  constexpr int kDraws = 1'000'000;
  constexpr int kParts = 2;  // of a pixel, either way, so that draws within one are tested too
  constexpr std::size_t kCells = std::size_t{kRows} * kColumns * kParts * kParts;
  std::vector<double> observed(kCells), expected(kCells);
  Rng rng(test::seed_of_this_test());
  const auto cell = [&](const Vec3& w) {
    const double across = (0.5 + std::atan2(w.x(), -w.z()) / (2 * pi)) * kColumns;
    const double theta = std::acos(w.y()) / pi * kRows;
    const int row = static_cast<int>(theta), column = static_cast<int>(across);
    const double middle = 0.5 * (std::cos(pi * row / kRows) + std::cos(pi * (row + 1) / kRows));
    const int part = (w.y() < middle ? 2 : 0) + (across - column < 0.5 ? 0 : 1);
    return static_cast<std::size_t>((row * kColumns + column) * kParts * kParts + part);
  };
  for (int i = 0; i < kDraws; ++i) {
    const double x = uniform(rng);
    const EnvironmentMap::Draw draw = map.draw({x, uniform(rng)});
    ASSERT_GT(draw.pdf, 0);
    ASSERT_NEAR(draw.direction.norm(), 1, 1e-15);
    ++observed[cell(draw.direction)];
  }
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double share = map.pdf(centre(row, column)) * solid_angle(row) / (kParts * kParts);
      for (int part = 0; part < kParts * kParts; ++part) {
        expected[static_cast<std::size_t>((row * kColumns + column) * kParts * kParts + part)] = share * kDraws;
      }
    }
  }
  test::expect_chi_square(observed, expected, 1, "environment map");
}

TEST(EnvironmentMap, DrawsKnowTheirRadiance) {
  const EnvironmentMap map(patchwork());
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const double x = uniform(rng);
    const EnvironmentMap::Draw draw = map.draw({x, uniform(rng)});
    EXPECT_TRUE((map.radiance(draw.direction) == draw.radiance).all());
    EXPECT_EQ(map.pdf(draw.direction), draw.pdf);
  }
  for (const double edge : {0x1p-33, 1 - 0x1p-33}) {
    EXPECT_GT(map.draw({edge, edge}).pdf, 0);
    EXPECT_GT(map.draw({1 - edge, edge}).pdf, 0);
  }
}

TEST(EnvironmentMap, TopIsUpAndTheMiddleIsAhead) {
  const EnvironmentMap map =
      EnvironmentMap::tabulated([](const Vec3& w) -> Rgb { return Rgb(1 + w.x(), 1 + w.y(), 1 + w.z()); }, 64);
  Image picture(8, 4);
  picture.at(0, 0, 0) = 1;  // up
  picture.at(2, 4, 1) = 1;  // right of the middle
  const EnvironmentMap drawn(picture);
  EXPECT_EQ(drawn.radiance(Vec3(-0.01, 1, 0.02).normalized())[0], 1);
  EXPECT_EQ(drawn.radiance(Vec3(0.1, -0.1, -1).normalized())[1], 1);
  EXPECT_EQ(drawn.radiance(Vec3(-0.1, -0.1, -1).normalized())[1], 0);
  for (const Vec3& w : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1), Vec3(0.6, -0.8, 0), Vec3(0, 0.6, 0.8)}) {
    EXPECT_LT((map.radiance(w) - (1 + w.array())).abs().maxCoeff(), 0.05) << w.transpose();
  }
}

TEST(EnvironmentMap, BadMapsAreRefused) {
  Image map = patchwork();
  map.at(3, 4, 1) = -1;
  EXPECT_THROW(EnvironmentMap{map}, std::invalid_argument);
  map.at(3, 4, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(EnvironmentMap{map}, std::invalid_argument);
  EXPECT_THROW(EnvironmentMap{Image()}, std::invalid_argument);
  EXPECT_THROW((void)EnvironmentMap::constant({1, -1, 1}), std::invalid_argument);
  const EnvironmentMap black(Image(2, 1));
  EXPECT_EQ(black.power(), 0);
  EXPECT_EQ(black.pdf({0, 1, 0}), 0);
}

}  // namespace
}  // namespace sklar::brdf
