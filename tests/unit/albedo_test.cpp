#include "brdf/study/albedo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/data/material.hpp"
#include "brdf/data/table_brdf.hpp"
#include "brdf/study/energy.hpp"
#include "tests/support/function_brdf.hpp"

namespace sklar::brdf {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(Albedo, LambertIsItsReflectance) {
  constexpr double kRounding = 1e-12;  ///< relative, of a sum of 24576 terms
  const AlbedoCurve curve = directional_albedo(Lambert({0.2, 0.5, 1}));
  ASSERT_EQ(curve.albedo.rows(), 90);
  EXPECT_LT((curve.albedo.col(0) / 0.2 - 1).abs().maxCoeff(), kRounding);
  EXPECT_LT((curve.albedo.col(2) - 1).abs().maxCoeff(), kRounding);
}

// The reference has 12 times the nodes, none of them shared.
TEST(Albedo, GgxAgreesWithAFineReference) {
  constexpr double kStated = 1e-7;         ///< relative, up to 85 degrees
  constexpr double kStatedGrazing = 3e-6;  ///< at 88 degrees
  const Eigen::ArrayXd angles = Eigen::ArrayXd{{0, 30, 60, 80, 85, 88}} * kDegree;
  for (const double alpha : {0.005, 0.02, 0.1, 0.5, 1.0}) {
    const auto brdf = Ggx(Rgb::Ones(), alpha);
    const RgbRows fine = directional_albedo(brdf, angles, {.polar = 151, .azimuth = 2001}).albedo;
    const Eigen::ArrayXd error = (directional_albedo(brdf, angles).albedo.col(0) / fine.col(0) - 1).abs();
    EXPECT_LT(error.head(5).maxCoeff(), kStated) << alpha;
    EXPECT_LT(error(5), kStatedGrazing) << alpha;
  }
}

// Brute force in the angles of wi, a rule with nothing in common with the half vector's.
TEST(Albedo, GgxAgreesWithBruteForce) {
  constexpr double kMidpoint = 2e-5;  ///< relative error of the 1000 x 1000 midpoint rule
  const auto brdf = Ggx(Rgb::Ones(), 0.3);
  const double theta_o = 50 * kDegree;
  const Vec3 wo(std::sin(theta_o), 0, std::cos(theta_o));
  constexpr int kSteps = 1000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double theta = (i + 0.5) / kSteps * std::numbers::pi / 2;
    for (int k = 0; k < kSteps; ++k) {
      const double phi = (k + 0.5) / kSteps * std::numbers::pi;
      const Vec3 wi(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      sum += brdf.eval(wo, wi)[0] * std::cos(theta) * std::sin(theta);
    }
  }
  sum *= 2 * (std::numbers::pi / kSteps) * (std::numbers::pi / 2 / kSteps);
  const double albedo = directional_albedo(brdf, Eigen::ArrayXd::Constant(1, theta_o)).albedo(0, 0);
  EXPECT_NEAR(albedo / sum, 1, kMidpoint);
}

TEST(Albedo, MeasuredTablesAgreeWithAFineReference) {
  constexpr double kStated = 2e-3;  ///< relative, up to 85 degrees
  const char* data = std::getenv("SKLAR_TEST_DATA");
  if (data == nullptr) GTEST_SKIP() << "SKLAR_TEST_DATA is not set: no measured materials to read";
  const Eigen::ArrayXd angles = Eigen::ArrayXd{{0, 10, 30, 45, 60, 75, 85}} * kDegree;
  for (const char* name : {"chm_mint_rgb.bsdf", "paper_white_rgb.bsdf"}) {
    const auto path = std::filesystem::path(data) / "materials" / "rgl" / name;
    const TableBrdf brdf(std::make_shared<MeasuredTable>(load_material(path)));
    const RgbRows fine = directional_albedo(brdf, angles, {.polar = 401, .azimuth = 801}).albedo;
    EXPECT_LT((directional_albedo(brdf, angles).albedo / fine - 1).abs().maxCoeff(), kStated) << name;
  }
}

TEST(Albedo, RefusesAnisotropyAndTheHorizon) {
  const test::FunctionBrdf brushed([](const Vec3&, const Vec3&) -> Rgb { return Rgb::Zero(); },
                                   {.reciprocal = true, .isotropic = false});
  EXPECT_THROW((void)directional_albedo(brushed), std::invalid_argument);
  EXPECT_THROW((void)directional_albedo(Lambert(Rgb::Ones()), Eigen::ArrayXd::Constant(1, 90 * kDegree)),
               std::domain_error);
}

TEST(Albedo, AnyReflectanceIsLoweredToALimit) {
  constexpr double kNodes = 1e-3;  // relative, of albedos between the degrees
  const auto bright = std::make_shared<const test::FunctionBrdf>([](const Vec3& wo, const Vec3& wi) -> Rgb {
    return Rgb(0.5, 0.9, 0.9 + 0.1 / (wo.z() + wi.z() + 0.1)) / std::numbers::pi;
  });
  EXPECT_EQ(limit_albedo(BrdfPtr(bright), 2).brdf, bright);
  const Limited<Brdf> limited = limit_albedo(BrdfPtr(bright));
  EXPECT_GT(limited.albedo_before, 1.04);
  EXPECT_NEAR(limited.albedo_after, 1, 1e-6);
  EXPECT_LT(limited.lowest_factor, 1);
  EXPECT_LE(directional_albedo(*limited.brdf).albedo.maxCoeff(), 1 + kNodes);
  const Vec3 up(0.48, 0.36, 0.8), low(-0.8, 0.5916079783099616, 0.1);
  EXPECT_TRUE((limited.brdf->eval(up, low) == limited.brdf->eval(low, up)).all());
  EXPECT_TRUE((limited.brdf->eval(up, low).head<2>() == bright->eval(up, low).head<2>()).all());
  EXPECT_LT(limited.brdf->eval(up, low)[2], bright->eval(up, low)[2]);
  EXPECT_EQ(limited.brdf->eval(up, up)[2], bright->eval(up, up)[2]);
  EXPECT_THROW((void)limit_albedo(BrdfPtr(bright), 0), std::invalid_argument);

  const Limited<Brdf> even = limit_albedo(std::make_shared<const Lambert>(Rgb::Constant(1.0)), 0.7);
  EXPECT_LT((directional_albedo(*even.brdf).albedo / 0.7 - 1).abs().maxCoeff(), kNodes);

  const auto brushed = std::make_shared<const test::FunctionBrdf>(
      [](const Vec3& wo, const Vec3&) -> Rgb { return Rgb::Constant((1 + wo.x() * wo.x()) / std::numbers::pi); },
      Traits{.reciprocal = false, .isotropic = false});
  const Limited<Brdf> dimmed = limit_albedo(BrdfPtr(brushed));
  EXPECT_GT(dimmed.albedo_before, 1.9);
  EXPECT_NEAR(dimmed.albedo_after, 1, 1e-6);
}

}  // namespace
}  // namespace sklar::brdf
