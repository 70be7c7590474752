/// Each model against its formula as printed, and against a number or a limit that its source gives.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "brdf/analytic/blinn_phong.hpp"
#include "brdf/analytic/phong.hpp"
#include "brdf/analytic/registry.hpp"
#include "tests/support/textbook.hpp"

namespace sklar::brdf {
namespace {

using namespace test;
constexpr double kPi = std::numbers::pi;

TEST(Phong, AgreesWithLafortuneAndWillems) {
  for (const double n : {0.5, 5.0, 2000.0}) {
    const BrdfPtr model = analytic::find("phong").make({0, 0.2, 0.4, 0.1, 0.5, 1, n});
    for_pairs([&](const Vec3& wo, const Vec3& wi) {
      const double cosine = std::cos(Angles(wo, wi).alpha);
      const double lobe = cosine > 0 ? (n + 2) / (2 * kPi) * std::pow(cosine, n) : 0;
      const Rgb value = model->eval(wo, wi);
      EXPECT_NEAR(value[1], 0.2 / kPi + 0.5 * lobe, 10 * kEps * (n + 1) * (lobe + 1));
      if (0.1 * lobe < kVisible) return;
      EXPECT_NEAR(value[0] / (0.1 * lobe), 1, 10 * kEps * (n + 1) / cosine);
    });
  }
}

TEST(Phong, AlbedoAtNormalIncidenceIsSpecular) {
  for (const double n : {1.0, 10.0, 300.0}) {
    const PhongLobe lobe(Rgb::Constant(0.6), n);
    EXPECT_NEAR(albedo(lobe, Vec3::UnitZ()), 0.6, kQuadrature) << n;
    EXPECT_LT(albedo(lobe, degrees(60)), 0.6) << n;
    EXPECT_NEAR(share_above(lobe, Vec3::UnitZ()), 1, kQuadrature) << n;
  }
}

TEST(Phong, KeepsItsDigitsAtTheLargestExponent) {
  const PhongLobe lobe(Rgb::Ones(), 1e6);
  for (const double alpha : {0.0, 1e-6, 1e-3, 3e-3}) {
    const double expected = (1e6 + 2) / (2 * kPi) * std::exp(1e6 * std::log1p(-2 * std::pow(std::sin(alpha / 2), 2)));
    EXPECT_NEAR(lobe.eval(Vec3::UnitZ(), spherical_direction(alpha, 0.3))[0] / expected, 1, 1e-12) << alpha;
  }
}

TEST(BlinnPhong, AgreesWithTheTextbook) {
  for (const double n : {0.5, 5.0, 2000.0}) {
    const BlinnPhongLobe lobe({0.1, 0.5, 1.0}, n);
    for_pairs([&](const Vec3& wo, const Vec3& wi) {
      const double cosine = std::cos(Angles(wo, wi).theta_h);
      const double expected = (n + 2) * (n + 4) / (8 * kPi * (std::pow(2, -n / 2) + n)) * std::pow(cosine, n);
      if (expected < kVisible) return;
      EXPECT_NEAR(lobe.eval(wo, wi)[1] / (0.5 * expected), 1, 10 * kEps * (n + 1) / cosine);
    });
  }
}

TEST(BlinnPhong, AlbedoAtNormalIncidenceIsSpecular) {
  for (const double n : {0.0, 1.0, 10.0, 300.0}) {
    EXPECT_NEAR(albedo(BlinnPhongLobe(Rgb::Constant(0.6), n), Vec3::UnitZ()), 0.6, kQuadrature) << n;
  }
}

TEST(BlinnPhong, AlbedoFallsAsStated) {
  const BlinnPhongLobe lobe(Rgb::Ones(), 5);
  EXPECT_NEAR(albedo(lobe, degrees(30)), 0.85, 0.005);
  EXPECT_NEAR(albedo(lobe, degrees(60)), 0.51, 0.005);
  EXPECT_NEAR(albedo(lobe, degrees(89.99)), 0.19, 0.005);
  EXPECT_NEAR(albedo(BlinnPhongLobe(Rgb::Ones(), 5000), degrees(60)), 0.25, 0.005) << "cos^2 of a narrow lobe";
}

TEST(BlinnPhong, ExponentZeroIsLambert) {
  const BlinnPhongLobe lobe({0.1, 0.5, 1.0}, 0);
  for_pairs([&](const Vec3& wo, const Vec3& wi) { EXPECT_NEAR(lobe.eval(wo, wi)[2] * kPi, 1, kEps); });
}

TEST(BlinnPhong, DensityEndsAtItsLargest) {
  EXPECT_EQ(BlinnPhongLobe(Rgb::Ones(), 10).pdf(kGrazing, kOpposite), power_lobe::kLargest);
}

}  // namespace
}  // namespace sklar::brdf
