#include "brdf/study/metrics.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/data/material.hpp"
#include "brdf/geometry/frame.hpp"
#include "brdf/study/sphere_positions.hpp"
#include "tests/support/function_brdf.hpp"

namespace sklar::brdf {
namespace {
using std::numbers::pi;

constexpr double kPosition = 1e-12;  ///< cells
constexpr double kRounding = 1e-11;  ///< relative, of sums of millions of terms in another order

CellValues planes(double red, double green, double blue) {
  return {std::vector<double>(Grid::cells, red), std::vector<double>(Grid::cells, green),
          std::vector<double>(Grid::cells, blue)};
}

/// A table whose every cell, geometry or not, holds the same colour.
MeasuredTable uniform_table(const CellValues& values) {
  MeasuredTable table;
  table.name = "uniform";
  table.values = values;
  table.valid.assign(Grid::cells, 1);
  return table;
}

void keep_only(MeasuredTable& table, std::initializer_list<int> cells) {
  table.valid.assign(Grid::cells, 0);
  for (const int cell : cells) table.valid[static_cast<std::size_t>(cell)] = 1;
}

struct Cosines {
  double in, out;
};

/// Both cosines at a cell centre, by the spherical law of cosines.
Cosines cosines(int i, int j, int k) {
  const double h = std::pow((i + 0.5) / 90, 2) * pi / 2;
  const double d = (j + 0.5) * pi / 180;
  const double phi = (k + 0.5) * pi / 180;
  const double flat = std::sin(h) * std::sin(d) * std::cos(phi);
  return {std::cos(h) * std::cos(d) - flat, std::cos(h) * std::cos(d) + flat};
}

void expect_near(const Rgb& value, const Rgb& expected, const char* what) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c] / expected[c], 1, kRounding) << what << " channel " << c;
}

TEST(CellErrors, OneCellByHand) {
  MeasuredTable table = uniform_table(planes(2, 0.5, 30));
  keep_only(table, {Grid::index(20, 30, 40)});
  const CellErrors errors = cell_errors(table, planes(1, 0.75, 10));
  const auto [in, out] = cosines(20, 30, 40);
  const Rgb f(2, 0.5, 30);
  const Rgb g(1, 0.75, 10);
  EXPECT_EQ(errors.cells, 1u);
  expect_near(errors.log1p_mae, ((1 + f * in).log() - (1 + g * in).log()).abs(), "log1p_mae");
  expect_near(errors.logrel_mae, ((f * in * out + 1e-3) / (g * in * out + 1e-3)).log().abs(), "logrel_mae");
  expect_near(errors.cuberoot_rms, ((f * in).pow(1.0 / 3) - (g * in).pow(1.0 / 3)).abs(), "cuberoot_rms");
  expect_near(errors.rel_l2, (f - g).abs() / f, "rel_l2");
}

TEST(CellErrors, CellsCountOnceAndPast80DegreesNot) {
  MeasuredTable table = uniform_table(planes(1, 1, 1));
  const int first = Grid::index(0, 0, 0);
  const int second = Grid::index(50, 40, 100);
  const int grazing = Grid::index(0, 81, 5);
  CellValues predicted = planes(1, 1, 1);
  for (auto& plane : predicted) plane[static_cast<std::size_t>(second)] = 3;
  for (auto& plane : predicted) plane[static_cast<std::size_t>(grazing)] = 1000;
  keep_only(table, {first, second, grazing});
  const CellErrors errors = cell_errors(table, predicted);
  const double a = cosines(0, 0, 0).in;
  const double b = cosines(50, 40, 100).in;
  EXPECT_EQ(errors.cells, 2u);
  expect_near(errors.log1p_mae, Rgb::Constant(std::log((1 + 3 * b) / (1 + b)) / 2), "log1p_mae");
  expect_near(errors.rel_l2, Rgb::Constant(2 * b / std::sqrt(a * a + b * b)), "rel_l2");
}

TEST(CellErrors, NegativeValuesAreZeroInLogarithmsOnly) {
  MeasuredTable table = uniform_table(planes(2, 0.5, 30));
  keep_only(table, {Grid::index(20, 30, 40)});
  const CellErrors negative = cell_errors(table, planes(-5, -1e6, -1));
  const CellErrors zero = cell_errors(table, planes(0, 0, 0));
  EXPECT_TRUE((negative.log1p_mae == zero.log1p_mae).all() && (negative.logrel_mae == zero.logrel_mae).all());
  EXPECT_TRUE((negative.cuberoot_rms > zero.cuberoot_rms).all() && (negative.rel_l2 > zero.rel_l2).all());
}

TEST(CellErrors, ZeroForTheTableItself) {
  const MeasuredTable table = uniform_table(planes(2, 0, 30));
  const CellErrors errors = cell_errors(table, table.values);
  EXPECT_EQ(errors.log1p_mae.maxCoeff(), 0);
  EXPECT_EQ(errors.logrel_mae.maxCoeff(), 0);
  EXPECT_EQ(errors.cuberoot_rms.maxCoeff(), 0);
  EXPECT_TRUE((errors.rel_l2 == 0).all()) << "a black channel too";
}

TEST(CellErrors, RefusesWhatHasNoAnswer) {
  MeasuredTable table = uniform_table(planes(1, 1, 1));
  CellValues short_plane = table.values;
  short_plane[1].pop_back();
  EXPECT_THROW((void)cell_errors(table, short_plane), std::invalid_argument);
  keep_only(table, {Grid::index(0, 81, 5)});
  EXPECT_THROW((void)cell_errors(table, table.values), std::invalid_argument);
}

TEST(Predict, EvaluatesAtValidCellsOnly) {
  MeasuredTable table = uniform_table(planes(1, 1, 1));
  const int cell = Grid::index(20, 30, 40);
  keep_only(table, {cell});
  const test::FunctionBrdf cosine_of_wi([](const Vec3& wo, const Vec3& wi) -> Rgb { return {wi.z(), wo.z(), 7}; });
  const CellValues values = predict(cosine_of_wi, table);
  const auto [in, out] = cosines(20, 30, 40);
  EXPECT_NEAR(values[0][static_cast<std::size_t>(cell)], in, 1e-15);
  EXPECT_NEAR(values[1][static_cast<std::size_t>(cell)], out, 1e-15);
  EXPECT_EQ(std::count(values[2].begin(), values[2].end(), 7), 1);
  EXPECT_EQ(std::count(values[2].begin(), values[2].end(), 0), Grid::cells - 1);
}

/// Irradiance of the pinned lights at a normal, lights above cos_i = 0.01.
double irradiance(const Vec3& normal) {
  double sum = 0;
  for (int k = 0; k < 6000; ++k) {
    const double z = 1 - 2 * (k + 0.5) / 6000;
    const double azimuth = pi * (1 + std::sqrt(5.0)) * (k + 0.5);
    const Vec3 light(std::sqrt(1 - z * z) * std::cos(azimuth), std::sqrt(1 - z * z) * std::sin(azimuth), z);
    const double cosine = normal.dot(light);
    if (cosine <= 0.01) continue;
    const auto lobe = [&](const Vec3& axis, int power) {
      return std::pow(std::max(0.0, light.dot(axis.normalized())), power);
    };
    sum += cosine * (0.3 + 0.3 * light.y() + 30 * lobe({0.5, 0.6, 0.6}, 40) + 40 * lobe({-0.7, 0.3, 0.5}, 80) +
                     20 * lobe({0.1, -0.2, -1}, 60));
  }
  return sum * 4 * pi / 6000;
}

TEST(SphereMetric, UniformTablesAreLambertSpheres) {
  const CellValues dark = planes(0.1, 0.2, 0.3);
  const CellValues bright = planes(0.2, 0.4, 0.6);
  const std::array<const CellValues*, 2> both{&dark, &bright};
  const std::vector<SpherePixels> pixels = sphere_pixels(both);
  ASSERT_EQ(pixels[0].rows(), 7208);
  Eigen::Index n = 0;
  for (int i = 0; i < 96; ++i) {
    for (int j = 0; j < 96; ++j) {
      const double px = (j + 0.5) / 48 - 1;
      const double py = 1 - (i + 0.5) / 48;
      const double square = px * px + py * py;
      if (square >= 0.995) continue;
      if (n % 97 == 0) {
        const double expected = irradiance({px, py, std::sqrt(1 - square)});
        EXPECT_NEAR(pixels[0](n, 1) / (0.2 * expected), 1, kRounding) << i << ' ' << j;
        EXPECT_NEAR(pixels[1](n, 2) / (0.6 * expected), 1, kRounding) << i << ' ' << j;
      }
      ++n;
    }
  }
}

TEST(SphereMetric, PositionsAreThoseOfTheCoordinates) {
  std::vector<double> x, y, z;
  for (const double polar : {0.0, 1e-9, 0.01, 0.7, 1.5, pi / 2 - 1e-6}) {
    for (int k = 0; k < 8; ++k) {
      const Vec3 w = spherical_direction(polar, (k - 3.7) * pi / 4);
      x.push_back(w.x());
      y.push_back(w.y());
      z.push_back(w.z());
    }
  }
  std::vector<double> theta_h(x.size()), phi_d(x.size());
  sphere_positions(x.data(), y.data(), z.data(), x.size(), theta_h.data(), phi_d.data());
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double radius = std::hypot(x[n], y[n]);
    const double azimuth = radius > 0 ? std::atan2(y[n], x[n]) : 0;
    EXPECT_NEAR(theta_h[n], 90 * std::sqrt(std::atan2(radius, z[n]) / (pi / 2)) - 0.5, kPosition) << n;
    EXPECT_NEAR(phi_d[n], (azimuth < 0 ? azimuth + pi : azimuth) * 180 / pi - 0.5, kPosition) << n;
  }
}

TEST(SphereMetric, PsnrByHand) {
  SpherePixels reference(1001, 3);
  for (int n = 0; n < 1001; ++n) reference.row(n) = static_cast<double>(n) / 1000;
  SpherePixels model = reference;
  model.col(0) += 0.01;             // clipped to the peak .995 for the last: the error is 0 there
  model.bottomRows(5).col(2) = 50;  // only past the peak
  const Rgb psnr = sphere_psnr_linear_db(reference, model);
  double error = 0;
  for (int n = 0; n < 1001; ++n) {
    const double a = std::min(n / 1000.0, 0.995);
    const double b = std::min(n / 1000.0 + 0.01, 0.995);
    error += (a - b) * (a - b) / 1001;
  }
  EXPECT_NEAR(psnr[0], -10 * std::log10(error / (0.995 * 0.995)), 1e-9);
  EXPECT_EQ(psnr[1], std::numeric_limits<double>::infinity());
  EXPECT_EQ(psnr[2], std::numeric_limits<double>::infinity());
  EXPECT_THROW((void)sphere_psnr_linear_db(reference, model.topRows(5)), std::invalid_argument);
}

TEST(SphereMetric, ModelIsReadThroughTheGridWithTheMask) {
  MeasuredTable table = uniform_table(planes(0.1, 0.2, 0.3));
  for (int i = 60; i < 90; ++i) {
    for (int cell = Grid::index(i, 0, 0); cell < Grid::index(i, 0, 0) + 90 * 180; ++cell) {
      table.valid[static_cast<std::size_t>(cell)] = 0;
      for (auto& plane : table.values) plane[static_cast<std::size_t>(cell)] = 0;
    }
  }
  const test::FunctionBrdf same([](const Vec3&, const Vec3&) -> Rgb { return {0.1, 0.2, 0.3}; });
  // Cells below the horizon are valid in this table and 0 in the prediction; they are read only beside the horizon.
  EXPECT_GT(sphere_psnr_linear_db(table, same).minCoeff(), 40);
}

// The figures of a separate implementation of the measures, on a measured material and a Lambert model.
TEST(Metrics, MeasuredMaterial) {
  const char* data = std::getenv("SKLAR_TEST_DATA");
  if (data == nullptr) GTEST_SKIP() << "SKLAR_TEST_DATA is not set: no measured materials to read";
  const MeasuredTable table =
      load_material(std::filesystem::path(data) / "materials" / "rgl" / "vch_silk_blue_rgb.bsdf");
  const Lambert model({0.1, 0.2, 0.3});
  const CellErrors errors = cell_errors(table, predict(model, table));
  EXPECT_EQ(errors.cells, 909696u);
  EXPECT_NEAR(errors.log1p_mae.mean() / 0.3032445830689823, 1, kRounding);
  EXPECT_NEAR(errors.logrel_mae.mean() / 2.1904245295925038, 1, kRounding);
  EXPECT_NEAR(errors.cuberoot_rms.mean() / 0.49153325834011374, 1, kRounding);
  EXPECT_NEAR(errors.rel_l2.mean() / 0.988347098033338, 1, kRounding);
  expect_near(sphere_psnr_linear_db(table, model), Rgb(19.243837576679628, 15.579461805635948, 17.296161556001234),
              "sphere_psnr_linear_db");
}

TEST(CellErrors, DoNotDependOnThreads) {
  MeasuredTable table = uniform_table(planes(0.1, 0.2, 0.3));
  const auto model = Ggx(Rgb::Ones(), 0.3);
  const CellValues predicted = predict(model, table);
  const CellErrors errors = cell_errors(table, predicted);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(predict(model, table), predicted);
  EXPECT_TRUE((cell_errors(table, predicted).rel_l2 == errors.rel_l2).all());
  EXPECT_TRUE((cell_errors(table, predicted).log1p_mae == errors.log1p_mae).all());
}

}  // namespace
}  // namespace sklar::brdf
