/// Each model against its formula as printed, and against a number or a limit that its source gives.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "brdf/analytic/abc.hpp"
#include "brdf/analytic/ashikhmin_shirley.hpp"
#include "brdf/analytic/cook_torrance.hpp"
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

/// As printed in Cook and Torrance 1982. @param n index of refraction.
double printed_fresnel(double n, double c) {
  const double g = std::sqrt(n * n + c * c - 1);
  const double ratio = (c * (g + c) - 1) / (c * (g - c) + 1);
  return 0.5 * std::pow((g - c) / (g + c), 2) * (1 + ratio * ratio);
}

TEST(CookTorrance, AgreesWithTheTextbook) {
  for (const double m : {0.05, 0.3, 1.0}) {
    const CookTorranceLobe lobe({0.04, 0.5, 0.9}, m);
    for_pairs([&](const Vec3& wo, const Vec3& wi) {
      const Angles a(wo, wi);
      const double cos_h = std::cos(a.theta_h);
      const double facets = std::exp(-std::pow(std::tan(a.theta_h) / m, 2)) / (kPi * m * m * std::pow(cos_h, 4));
      if (facets < kVisible) return;
      const double cos_i = std::cos(a.theta_i);
      const double cos_o = std::cos(a.theta_o);
      const double cos_d = std::cos(a.theta_d);
      const double geometry = std::min({1.0, 2 * cos_h * cos_o / cos_d, 2 * cos_h * cos_i / cos_d});
      const double n = (1 + std::sqrt(0.5)) / (1 - std::sqrt(0.5));
      const double expected = printed_fresnel(n, cos_d) * facets * geometry / (4 * cos_i * cos_o);
      EXPECT_NEAR(lobe.eval(wo, wi)[1] / expected, 1, 1e-11 / std::min({cos_i, cos_o, cos_h}));
    });
  }
}

TEST(CookTorrance, FresnelTermOfGlass) {
  // n = 1.5: 4 % along the normal; half of ((n^2 - 1) / (n^2 + 1))^2 where tan(theta) = n, all of it across (Brewster).
  const Rgb root = Rgb(0, 0.2, 1);
  const Rgb normal = dielectric_fresnel(root, 1);
  EXPECT_EQ(normal[0], 0);
  EXPECT_NEAR(normal[1], 0.04, kEps);
  EXPECT_EQ(normal[2], 1);
  EXPECT_NEAR(dielectric_fresnel(root, std::cos(std::atan(1.5)))[1], 0.5 * std::pow(1.25 / 3.25, 2), kEps);
  const Rgb grazing = dielectric_fresnel(root, 1e-300);
  EXPECT_EQ(grazing[0], 0);
  EXPECT_NEAR(grazing[1], 1, kEps);
  EXPECT_NEAR(grazing[2], 1, kEps);
}

TEST(CookTorrance, ShareOfDrawsAboveTheHorizon) {
  // Along z those of tan(theta_h) < 1 reflect upward: 1 - exp(-1 / m^2).
  for (const double m : {0.1, 0.5, 1.0}) {
    const double share = share_above(CookTorranceLobe(Rgb::Ones(), m), Vec3::UnitZ());
    EXPECT_NEAR(share, 1 - std::exp(-1 / (m * m)), kQuadrature) << m;
  }
}

TEST(CookTorrance, SmoothSurfaceReflectsTheFresnelTerm) {
  const CookTorranceLobe lobe(Rgb::Constant(0.04), 0.02);
  for (const double theta : {0.0, 45.0, 60.0}) {
    const double expected = printed_fresnel(1.5, std::cos(theta * kPi / 180));
    EXPECT_NEAR(albedo(lobe, degrees(theta)) / expected, 1, 0.01) << theta;
  }
}

TEST(CookTorrance, EndsAtItsLargestValue) {
  const CookTorranceLobe lobe(Rgb::Ones(), 0.3);
  EXPECT_EQ(lobe.eval(kGrazing, kOpposite)[0], CookTorranceLobe::kLargest);
  EXPECT_EQ(lobe.pdf(kGrazing, kOpposite), CookTorranceLobe::kLargest);
}

TEST(Abc, AgreesWithItsSourceInAngles) {
  for (const double c : {0.5, 1.0, 3.0}) {
    const AbcLobe lobe({1, 20, 300}, 500, c, 1.5);
    for_pairs([&](const Vec3& wo, const Vec3& wi) {
      const Angles a(wo, wi);
      const Vec2 of_i = std::sin(a.theta_i) * Vec2(std::cos(a.phi_i), std::sin(a.phi_i));
      const Vec2 of_o = std::sin(a.theta_o) * Vec2(std::cos(a.phi_o), std::sin(a.phi_o));
      const double cos_d = std::sqrt(1 - (of_i - of_o).squaredNorm() / 4);
      const double expected = 20 / std::pow(1 + 500 * (of_i + of_o).squaredNorm(), c) * printed_fresnel(1.5, cos_d);
      EXPECT_NEAR(lobe.eval(wo, wi)[1] / expected, 1, 1e-12 / (cos_d * cos_d));
    });
  }
}

TEST(Abc, FallsToAPowerOfTwoAtItsWidth) {
  // |D|^2 = 1 / b, at the angle of which the Fresnel term of a large eta hardly differs from that of the peak.
  const AbcLobe lobe(Rgb::Constant(100), 1e4, 1.7, 100);
  const double peak = lobe.eval(Vec3::UnitZ(), Vec3::UnitZ())[0];
  EXPECT_NEAR(peak, 100 * std::pow(99.0 / 101, 2), 1e-12);
  EXPECT_NEAR(lobe.eval(Vec3::UnitZ(), spherical_direction(std::asin(0.01), 1))[0] / peak, std::pow(2, -1.7), 1e-6);
}

TEST(Abc, DrawsWeighAsTheFresnelTerm) {
  // f cos / pdf = pi a F I with I = log(1 + b q) / b for c = 1, q / (1 + b q) for c = 2, q for c = 0.
  constexpr double kB = 300;
  Rng rng(seed_of_this_test());
  for (const double c : {0.0, 1.0, 2.0}) {
    const AbcLobe lobe(Rgb::Constant(7), kB, c, 1.5);
    for (int n = 0; n < 1000; ++n) {
      const Vec3 wo = random_direction(rng);
      const double first = uniform(rng);
      const Sample draw = lobe.sample(wo, {first, uniform(rng)});
      if (!(draw.wi.z() > 0)) continue;
      const double q = std::pow(1 + std::sqrt(1 - wo.z() * wo.z()), 2);
      const double integral = c == 0 ? q : c == 1 ? std::log(1 + kB * q) / kB : q / (1 + kB * q);
      const double cos_d = std::sqrt(1 - (draw.wi - wo).head<2>().squaredNorm() / 4);
      const double expected = kPi * 7 * integral * printed_fresnel(1.5, cos_d);
      EXPECT_NEAR(draw.weight[0] / expected, 1, 1e-12 / (cos_d * cos_d)) << c;
    }
  }
}

TEST(Abc, EveryDrawAlongTheNormalIsAboveTheHorizon) {
  for (const double c : {0.5, 1.0, 3.0}) {
    EXPECT_NEAR(share_above(AbcLobe(Rgb::Ones(), 50, c, 1.5), Vec3::UnitZ()), 1, kQuadrature) << c;
  }
}

TEST(Abc, AlbedoIsBelowItsBound) {
  const AbcLobe lobe(Rgb::Constant(30), 200, 1.2, 100);
  const double bound = lobe.traits().albedo_bound;
  EXPECT_NEAR(albedo(lobe, Vec3::UnitZ()) / bound, std::pow(99.0 / 101, 2), 1e-3);
  for (const double theta : {45.0, 80.0}) EXPECT_LT(albedo(lobe, degrees(theta)), bound) << theta;
}

}  // namespace
}  // namespace sklar::brdf
