/// Each model against its formula as printed, and against a number or a limit that its source gives.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "brdf/analytic/ashikhmin_shirley.hpp"
#include "tests/support/textbook.hpp"

namespace sklar::brdf {
namespace {

using namespace test;
constexpr double kPi = std::numbers::pi;

TEST(AshikhminShirley, AgreesWithTheTextbook) {
  for (const Vec2& n : {Vec2(10, 10), Vec2(3, 300), Vec2(1000, 0.5)}) {
    const double n_u = n.x();
    const double n_v = n.y();
    const AshikhminShirley model({0.2, 0.4, 0.6}, {0.1, 0.5, 1.0}, n_u, n_v);
    EXPECT_EQ(model.traits().isotropic, n_u == n_v);
    for_pairs([&](const Vec3& wo, const Vec3& wi) {
      const Angles a(wo, wi);
      const double cos_i = std::cos(a.theta_i);
      const double cos_o = std::cos(a.theta_o);
      const double exponent = n_u * std::pow(std::cos(a.phi_h), 2) + n_v * std::pow(std::sin(a.phi_h), 2);
      const double fresnel = 0.5 + 0.5 * std::pow(1 - std::cos(a.theta_d), 5);
      const double glossy = std::sqrt((n_u + 1) * (n_v + 1)) / (8 * kPi) * std::pow(std::cos(a.theta_h), exponent) *
                            fresnel / (std::cos(a.theta_d) * std::max(cos_i, cos_o));
      const double below =
          28 * 0.4 / (23 * kPi) * 0.5 * (1 - std::pow(1 - cos_i / 2, 5)) * (1 - std::pow(1 - cos_o / 2, 5));
      // acos and cos near the horizon have the rounding error of 1, the exponent that of an angle.
      const double tolerance = 1e-13 * (1 + n_u + n_v) / std::min({cos_i, cos_o, std::cos(a.theta_h)});
      EXPECT_NEAR(model.eval(wo, wi)[1] / (glossy + below), 1, tolerance);
    });
  }
}

TEST(AshikhminShirley, DiffuseConstantIs28Over23Pi) {
  // (1 - specular) diffuse (1 - (1 - cos_o/2)^5) is what the diffuse term reflects, by that constant: 31/32 along z.
  const AshikhminShirley with(Rgb::Constant(0.8), Rgb::Constant(0.3), 5, 20);
  const AshikhminShirley without(Rgb::Zero(), Rgb::Constant(0.3), 5, 20);
  for (const double theta : {0.0, 45.0, 80.0}) {
    const double shade = 1 - std::pow(1 - std::cos(theta * kPi / 180) / 2, 5);
    EXPECT_NEAR(albedo(with, degrees(theta)) - albedo(without, degrees(theta)), 0.8 * 0.7 * shade, 2 * kQuadrature);
  }
}

TEST(AshikhminShirley, ShareOfDrawsAboveTheHorizon) {
  // Along z those of theta_h < 45 degrees reflect upward: 1 - 2^(-(n + 1) / 2).
  for (const double n : {0.0, 3.0, 50.0}) {
    const AshikhminShirley model(Rgb::Zero(), Rgb::Ones(), n, n);
    EXPECT_NEAR(share_above(model, Vec3::UnitZ()), 1 - std::pow(2, -(n + 1) / 2), kQuadrature) << n;
  }
}

TEST(AshikhminShirley, ReflectsAtMostWhatArrives) {
  for (const double specular : {0.0, 0.05, 0.5, 1.0}) {
    const AshikhminShirley model(Rgb::Ones(), Rgb::Constant(specular), 5, 50);
    for (const double theta : {0.0, 45.0, 85.0}) {
      EXPECT_LE(albedo(model, degrees(theta)), 1 + kQuadrature) << specular << " " << theta;
    }
  }
}

TEST(AshikhminShirley, EndsAtItsLargestValue) {
  const AshikhminShirley model(Rgb::Zero(), {0, 0.5, 1}, 10, 10);
  EXPECT_TRUE((model.eval(kGrazing, kOpposite) == Rgb::Constant(power_lobe::kLargest)).all()) << "F = 1 there";
  EXPECT_EQ(model.pdf(kGrazing, kOpposite), power_lobe::kLargest);
}

}  // namespace
}  // namespace sklar::brdf
