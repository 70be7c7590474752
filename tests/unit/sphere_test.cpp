#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/render/turned_sphere.hpp"
#include "tests/support/function_brdf.hpp"

namespace sklar::brdf {
namespace {
using std::numbers::pi;

constexpr double kRounding = 1e-13;  ///< of a double sum of 2048 positive terms
constexpr double kFloatSum = 2e-5;   ///< relative, of a float sum of 2048 positive terms

Environment constant(double radiance) {
  return [=](const Vec3&) -> Rgb { return Rgb::Constant(radiance); };
}

SphereOptions small(Environment environment, const Rgb& irradiance) {
  SphereOptions options;
  options.size = 33;
  options.radius = 1;
  options.supersampling = 1;
  options.environment = std::move(environment);
  options.light_irradiance = irradiance;
  return options;
}

/// The normal seen by the centre of a pixel of a picture that the sphere fills.
Vec3 normal_at(int row, int column, int size) {
  const double x = (column + 0.5) / size * 2 - 1;
  const double y = 1 - (row + 0.5) / size * 2;
  return {x, y, std::sqrt(1 - x * x - y * y)};
}

TEST(Hemisphere, CosineIntegratesToPi) {
  for (const double degrees : {0.0, 1e-6, 30.0, 80.0, 89.9}) {
    const HemisphereNodes nodes = hemisphere_nodes(degrees * pi / 180);
    EXPECT_NEAR(nodes.weight.sum() / pi, 1, kRounding) << degrees;
    EXPECT_GT(nodes.wi.col(2).minCoeff(), 0) << degrees;
    EXPECT_LT((nodes.wi.square().rowwise().sum() - 1).abs().maxCoeff(), 1e-15) << degrees;
  }
}

TEST(Hemisphere, IntegratesPolynomials) {
  const HemisphereNodes nodes = hemisphere_nodes(0.7, {});
  EXPECT_NEAR((nodes.weight * nodes.wi.col(2)).sum(), 2 * pi / 3, 1e-12);
  EXPECT_NEAR((nodes.weight * nodes.wi.col(0)).sum(), 0, 1e-12);
  EXPECT_NEAR((nodes.weight * nodes.wi.col(0).square()).sum(), pi / 4, 1e-12);
  EXPECT_NEAR((nodes.weight * nodes.wi.col(1).square()).sum(), pi / 4, 1e-12);
}

TEST(Hemisphere, RefusesGrazingAndTooFewNodes) {
  EXPECT_THROW((void)hemisphere_nodes(pi / 2), std::domain_error);
  EXPECT_THROW((void)hemisphere_nodes(-0.1), std::domain_error);
  EXPECT_THROW((void)hemisphere_nodes(std::nan("")), std::domain_error);
  EXPECT_THROW((void)hemisphere_nodes(0.1, {1, 8}), std::invalid_argument);
}

TEST(Sphere, WhiteFurnaceShowsTheAlbedo) {
  const Image image = render_sphere(Lambert({0.2, 0.5, 1.0}), small(constant(1), Rgb::Zero()));
  for (const auto& [row, column] : {std::pair{16, 16}, {3, 16}, {20, 31}, {16, 0}}) {
    EXPECT_NEAR(image.at(row, column, 0), 0.2, 0.2 * kFloatSum);
    EXPECT_NEAR(image.at(row, column, 1), 0.5, 0.5 * kFloatSum);
    EXPECT_NEAR(image.at(row, column, 2), 1.0, 1.0 * kFloatSum);
  }
}

TEST(Sphere, DirectionalLightFollowsTheCosine) {
  SphereOptions options = small(constant(0), {3, 2, 1});
  options.light_direction = Vec3(-1, 2, 0.5);
  const Image image = render_sphere(Lambert(Rgb::Constant(0.8)), options);
  for (const auto& [row, column] : {std::pair{16, 16}, {3, 12}, {10, 2}, {30, 16}}) {
    const double cosine = normal_at(row, column, 33).dot(options.light_direction.normalized());
    EXPECT_NEAR(image.at(row, column, 0), 3 * 0.8 / pi * std::max(0.0, cosine), 1e-6) << row << ' ' << column;
    EXPECT_NEAR(image.at(row, column, 2), 1 * 0.8 / pi * std::max(0.0, cosine), 1e-6) << row << ' ' << column;
  }
}

// A lobe of 0.6 degrees sees the environment in the mirror direction; the rest of it is in the GGX tail and masking.
TEST(Sphere, SharpLobeMirrorsTheEnvironment) {
  constexpr double kTail = 0.01;
  const auto sky = [](const Vec3& w) -> Rgb { return Rgb(2 + w.x(), 2 + w.y(), 2 - w.z()); };
  SphereOptions options = small(sky, Rgb::Zero());
  options.size = 129;
  const Image image = render_sphere(Ggx(Rgb::Ones(), 0.01), options);
  for (const auto& [row, column] : {std::pair{64, 64}, {40, 64}, {64, 100}, {90, 30}}) {
    const Vec3 n = normal_at(row, column, 129);
    const Rgb expected = sky(2 * n.z() * n - Vec3::UnitZ());
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(row, column, c) / expected(c), 1, kTail) << row << ' ' << column;
  }
}

TEST(Sphere, BytesDoNotDependOnThreads) {
  SphereOptions options;
  options.size = 48;
  const auto brdf = Ggx(Rgb::Ones(), 0.2);
  const Image image = render_sphere(brdf, options);
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(render_sphere(brdf, options).rgb, image.rgb) << threads;
  }
}

TEST(Sphere, SwappingDirectionsShowsReciprocity) {
  SphereOptions options;
  options.size = 24;
  SphereOptions swapped = options;
  swapped.swap_directions = true;
  const auto reciprocal = Lambert({0.3, 0.4, 0.5});
  EXPECT_EQ(render_sphere(reciprocal, options).rgb, render_sphere(reciprocal, swapped).rgb);
  const test::FunctionBrdf skewed([](const Vec3& wo, const Vec3&) -> Rgb { return Rgb::Constant(wo.z()); });
  EXPECT_NE(render_sphere(skewed, options).rgb, render_sphere(skewed, swapped).rgb);
}

TEST(Sphere, BackgroundAndOutline) {
  SphereOptions options = small(constant(1), Rgb::Zero());
  options.radius = 0.5;
  options.supersampling = 4;
  const Image image = render_sphere(Lambert(Rgb::Constant(1)), options);
  EXPECT_EQ(image.at(0, 0, 0), static_cast<float>(options.background(0)));
  double coverage = 0;
  for (int row = 0; row < 33; ++row) {
    for (int column = 0; column < 33; ++column) {
      coverage += (image.at(row, column, 0) - options.background(0)) / (1 - options.background(0));
    }
  }
  EXPECT_NEAR(coverage / (33 * 33), pi / 16, 2e-3);  // the area of the disk, by 4 x 4 sub-pixels
}

TEST(Sphere, ProgressRisesToOneAndCanInterrupt) {
  SphereOptions options = small(constant(1), Rgb::Zero());
  double last = 0;
  options.progress = [&](double share) {
    EXPECT_GT(share, last);
    last = share;
  };
  const auto brdf = Lambert(Rgb::Constant(0.5));
  (void)render_sphere(brdf, options);
  EXPECT_EQ(last, 1);
  options.progress = [](double) { throw std::runtime_error("stop"); };
  EXPECT_THROW((void)render_sphere(brdf, options), std::runtime_error);
}

TEST(Sphere, RefusesWhatItCannotShow) {
  const auto brdf = Lambert(Rgb::Constant(0.5));
  SphereOptions options;
  options.size = 0;
  EXPECT_THROW((void)render_sphere(brdf, options), std::invalid_argument);
  options = {};
  options.light_direction.setZero();
  EXPECT_THROW((void)render_sphere(brdf, options), std::invalid_argument);
  const test::FunctionBrdf brushed([](const Vec3&, const Vec3&) -> Rgb { return Rgb::Zero(); },
                                   {.reciprocal = true, .isotropic = false});
  EXPECT_THROW((void)render_sphere(brushed), std::invalid_argument);
}

TEST(TurnedSphere, IsTheOrdinaryOneForIsotropicMaterials) {
  constexpr double kTolerance = 0.01;  // of the brightest pixel: other nodes, the sky once a pixel
  SphereOptions options;
  options.size = 40;
  const Ggx gloss({0.2, 0.5, 0.8}, 0.3);
  const Image plain = render_sphere(gloss, options), turned = render_turned_sphere(gloss, options);
  const float brightest = *std::max_element(plain.rgb.begin(), plain.rgb.end());
  for (std::size_t n = 0; n < plain.rgb.size(); ++n) {
    EXPECT_NEAR(static_cast<double>(turned.rgb[n] / brightest), static_cast<double>(plain.rgb[n] / brightest),
                kTolerance)
        << n;
  }
}

TEST(TurnedSphere, FollowsTheGrainAndNotTheThreads) {
  SphereOptions options;
  options.size = 24;
  options.nodes = {.polar = 32, .azimuth = 32};
  const Ggx along({0.5, 0.5, 0.5}, 0.1, 0.4), across({0.5, 0.5, 0.5}, 0.4, 0.1);
  const Image one = render_turned_sphere(along, options), other = render_turned_sphere(across, options);
  EXPECT_NE(one.rgb, other.rgb);
  const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(one.rgb, render_turned_sphere(along, options).rgb);
  options.size = 0;
  EXPECT_THROW((void)render_turned_sphere(along, options), std::invalid_argument);
}

}  // namespace
}  // namespace sklar::brdf
