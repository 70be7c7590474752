#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "brdf/analytic/all.hpp"
#include "brdf/analytic/registry.hpp"
#include "brdf/geometry/frame.hpp"
#include "tests/support/sampler_check.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-14;
constexpr double kAlphas[] = {0.02, 0.1, 0.4, 1.0};
constexpr double kThetaO[] = {0.0, 5.0, 45.0, 75.0, 89.0};  // degrees

Vec3 degrees(double theta, double phi = 30) {
  return spherical_direction(theta * kPi / 180, phi * kPi / 180);
}

Vec3 random_direction(Rng& rng) {
  const double theta = std::acos(uniform(rng));
  return spherical_direction(theta, 2 * kPi * uniform(rng));
}

/// f_r as printed in the sources of ggx.hpp, with angles and no rearrangement.
double textbook_ggx(double f0, double alpha, const Vec3& wo, const Vec3& wi) {
  const Vec3 h = (wi + wo).normalized();
  const double square = alpha * alpha;
  const double density = square / (kPi * std::pow(h.z() * h.z() * (square - 1) + 1, 2));
  const auto lambda = [&](const Vec3& w) {
    const double tangent = std::tan(std::acos(w.z()));
    return 0.5 * (std::sqrt(1 + square * tangent * tangent) - 1);
  };
  const double fresnel = f0 + (1 - f0) * std::pow(1 - wi.dot(h), 5);
  return fresnel * density / (1 + lambda(wi) + lambda(wo)) / (4 * wi.z() * wo.z());
}

/// Directional albedo by adaptive quadrature over wi, to 1e-6.
double albedo(const Brdf& model, const Vec3& wo) {
  double sum = 0;
  constexpr int kCells = 16;
  for (int cell = 0; cell < kCells * kCells; ++cell) {
    const int row = cell / kCells;
    const int column = cell % kCells;
    const double theta = kPi / 2 / kCells * row;
    const double phi = 2 * kPi / kCells * column;
    sum += test::integrate(
        [&](double t, double p) {
          return model.eval(wo, spherical_direction(t, p)).maxCoeff() * std::cos(t) * std::sin(t);
        },
        theta, theta + kPi / 2 / kCells, phi, phi + 2 * kPi / kCells, 1e-6 / kCells / kCells);
  }
  return sum;
}

TEST(Lambert, WhiteFurnace) {
  const Lambert white(Rgb::Ones());
  EXPECT_EQ(white.traits().albedo_bound, 1);
  Rng rng(1);
  for (const double theta : kThetaO) {
    for (int n = 0; n < 1000; ++n) {
      const double first = uniform(rng);
      const Sample draw = white.sample(degrees(theta), {first, uniform(rng)});
      for (const double weight : draw.weight) ASSERT_NEAR(weight, 1, 4e-16);
    }
  }
}

TEST(Ggx, AgreesWithTheTextbook) {
  Rng rng(2);
  for (const double alpha : kAlphas) {
    const Ggx model({0.04, 0.5, 1.0}, alpha);
    for (int n = 0; n < 5000; ++n) {
      const Vec3 wi = random_direction(rng);
      const Vec3 wo = random_direction(rng);
      const Rgb value = model.eval(wo, wi);
      // cos^2(theta_h) (alpha^2 - 1) + 1 cancels to alpha^2, tan(acos) near the horizon to cos.
      const double tolerance = 1e-13 / std::min({alpha * alpha, wi.z(), wo.z()});
      EXPECT_NEAR(value[0] / textbook_ggx(0.04, alpha, wo, wi), 1, tolerance);
      EXPECT_NEAR(value[1] / textbook_ggx(0.5, alpha, wo, wi), 1, tolerance);
      EXPECT_NEAR(value[2] / textbook_ggx(1.0, alpha, wo, wi), 1, tolerance);
    }
  }
}

TEST(Ggx, KeepsItsPeakAtSmallAlpha) {
  // At h = z: D = 1 / (pi alpha^2).
  for (const double alpha : {1e-6, 1e-4, 1e-2}) {
    const Ggx mirror(Rgb::Ones(), alpha);
    const double peak = mirror.eval(Vec3::UnitZ(), Vec3::UnitZ())[0];
    EXPECT_NEAR(peak * 4 * kPi * alpha * alpha, 1, kRounding);
    // At tan(theta_h) = alpha the density of normals has fallen to a quarter of D(0) / cos^4(theta_h).
    const double theta_h = std::atan(alpha);
    const double side = mirror.eval(spherical_direction(theta_h, 0), spherical_direction(theta_h, 0))[0];
    const double cosine = std::cos(theta_h);
    const double shadow = 2 * cosine * std::sqrt(alpha * alpha + (1 - alpha * alpha) * cosine * cosine);
    EXPECT_NEAR(side * 2 * shadow * kPi * alpha * alpha * std::pow(cosine, 4) * 4, 1, 1e-9);
  }
}

TEST(Ggx, AlbedoIsAtMostOne) {
  for (const double alpha : {0.1, 0.4, 1.0}) {
    const Ggx white(Rgb::Ones(), alpha);
    for (const double theta : kThetaO) {
      const double found = albedo(white, degrees(theta));
      EXPECT_LE(found, 1 + 1e-6) << alpha << " " << theta;
      EXPECT_GT(found, 0.3) << alpha << " " << theta;
      if (alpha == 0.1 && theta == 0) {
        EXPECT_GT(found, 0.98);
      }
    }
  }
}

TEST(Ggx, ShareOfDrawsAboveTheHorizon) {
  // Seen along z, visible normals have P(theta_h < t) = tan^2 / (tan^2 + alpha^2), and those past 45 degrees reflect
  // downwards.
  for (const double alpha : kAlphas) {
    const double total = test::check_sampler(Ggx({0.04, 0.5, 1.0}, alpha), Vec3::UnitZ(), test::seed_of_this_test(),
                                             {.tests = static_cast<int>(std::size(kAlphas))});
    EXPECT_NEAR(total, 1 / (1 + alpha * alpha), 1e-6);
  }
}

TEST(Ggx, DrawsFromBelowTheHorizonWeighNothing) {
  const Ggx model(Rgb::Ones(), 0.3);
  for (const Vec3& wo : {Vec3(0, 0, -1), Vec3(0.6, 0, -0.8), Vec3(1, 0, 0)}) {
    const Sample draw = model.sample(wo, {0.3, 0.7});
    EXPECT_EQ(draw.pdf, 0);
    EXPECT_TRUE((draw.weight == 0).all());
    EXPECT_FALSE(draw.wi.hasNaN());
  }
}

/// f_r as printed in Heitz 2014 and 2018, with angles and no rearrangement.
double textbook_anisotropic(double alpha_x, double alpha_y, const Vec3& wo, const Vec3& wi) {
  const Vec3 h = (wi + wo).normalized();
  const double form = std::pow(h.x() / alpha_x, 2) + std::pow(h.y() / alpha_y, 2) + h.z() * h.z();
  const double density = 1 / (kPi * alpha_x * alpha_y * form * form);
  const auto lambda = [&](const Vec3& w) {
    const double slope = std::pow(alpha_x * w.x(), 2) + std::pow(alpha_y * w.y(), 2);
    return 0.5 * (std::sqrt(1 + slope / (w.z() * w.z())) - 1);
  };
  return density / (1 + lambda(wi) + lambda(wo)) / (4 * wi.z() * wo.z());
}

TEST(Ggx, AnisotropicAgreesWithTheTextbook) {
  Rng rng(2);
  for (const auto& [alpha_x, alpha_y] : {std::pair(0.02, 0.08), {0.5, 0.1}, {1.0, 0.3}}) {
    const Ggx model(Rgb::Ones(), alpha_x, alpha_y);
    EXPECT_FALSE(model.traits().isotropic);
    for (int n = 0; n < 5000; ++n) {
      const Vec3 wi = random_direction(rng);
      const Vec3 wo = random_direction(rng);
      const double tolerance = kRounding / std::min({alpha_x * alpha_x, wi.z(), wo.z()});
      EXPECT_NEAR(model.eval(wo, wi)[0] / textbook_anisotropic(alpha_x, alpha_y, wo, wi), 1, tolerance);
    }
  }
  EXPECT_TRUE(Ggx(Rgb::Ones(), 0.3, 0.3).traits().isotropic);
}

TEST(Ggx, EqualRoughnessesAreTheIsotropicModel) {
  const Ggx one({0.04, 0.5, 1.0}, 0.3);
  const Ggx two({0.04, 0.5, 1.0}, 0.3, 0.3);
  Rng rng(3);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 wi = random_direction(rng);
    const Vec3 wo = random_direction(rng);
    ASSERT_TRUE((one.eval(wo, wi) == two.eval(wo, wi)).all());
  }
  EXPECT_EQ(two.bytes(), one.bytes());
}

/// The lobe as printed in Ward 1992, eq. 5a, with angles; Duer's has the cosines without the root.
double textbook_ward(double alpha_x, double alpha_y, WardNormalisation normalisation, const Vec3& wo, const Vec3& wi) {
  const Vec3 h = (wi + wo).normalized();
  const double tangent = std::tan(std::acos(h.z()));
  const double phi = std::atan2(h.y(), h.x());
  const double exponent =
      tangent * tangent * (std::pow(std::cos(phi) / alpha_x, 2) + std::pow(std::sin(phi) / alpha_y, 2));
  const double cosines = wi.z() * wo.z();
  const double norm = normalisation == WardNormalisation::ward ? std::sqrt(cosines) : cosines;
  return std::exp(-exponent) / (4 * kPi * alpha_x * alpha_y * norm);
}

TEST(Ward, AgreesWithTheTextbook) {
  Rng rng(4);
  for (const WardNormalisation kind : {WardNormalisation::ward, WardNormalisation::duer}) {
    for (const auto& [alpha_x, alpha_y] : {std::pair(0.1, 0.2), {1.0, 0.3}}) {
      const WardLobe lobe(Rgb::Ones(), alpha_x, alpha_y, kind);
      for (int n = 0; n < 5000; ++n) {
        const Vec3 wi = random_direction(rng);
        const Vec3 wo = random_direction(rng);
        const double expected = textbook_ward(alpha_x, alpha_y, kind, wo, wi);
        if (expected < 1e-100) continue;  // the exponent's rounding error grows with it
        EXPECT_NEAR(lobe.eval(wo, wi)[0] / expected, 1, 1e-9 / std::min(wi.z(), wo.z()));
      }
    }
  }
}

TEST(Ward, SamplingWeighsAsWalterSays) {
  // Walter 2005: f cos / pdf = specular (h.wi) (h.n)^3 sqrt(cos_i / cos_o).
  const WardLobe lobe({0.2, 0.5, 1.0}, 0.1, 0.3, WardNormalisation::ward);
  Rng rng(5);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 wo = random_direction(rng);
    const double first = uniform(rng);
    const Sample draw = lobe.sample(wo, {first, uniform(rng)});
    if (!(draw.wi.z() > 0)) continue;
    const Vec3 h = (draw.wi + wo).normalized();
    const double expected = h.dot(draw.wi) * std::pow(h.z(), 3) * std::sqrt(draw.wi.z() / wo.z());
    EXPECT_NEAR(draw.weight[2] / expected, 1, 1e-9);
  }
}

TEST(Ward, AlbedoOfSmallRoughness) {
  // Of h near n, f cos dwi = 4 (h.wi) cos f dh turns into cos_o (Ward) or 1 (Duer) times the normal density's mass.
  constexpr double kAlpha = 0.02;
  for (const double theta : {0.0, 45.0, 60.0}) {
    const double cosine = std::cos(theta * kPi / 180);
    EXPECT_NEAR(albedo(WardLobe(Rgb::Ones(), kAlpha, kAlpha, WardNormalisation::ward), degrees(theta)), cosine, 3e-3);
    EXPECT_NEAR(albedo(WardLobe(Rgb::Ones(), kAlpha, kAlpha, WardNormalisation::duer), degrees(theta)), 1, 3e-3);
  }
  // Ward 1992: total reflectance of rolled brass (table 1) is diffuse + specular, "accurate as long as alpha <= 0.2".
  const BrdfPtr brass = analytic::find("ward").make({0.1, 0.1, 0.1, 0.33, 0.33, 0.33, 0.05, 0.16});
  EXPECT_NEAR(albedo(*brass, Vec3::UnitZ()), 0.43, 0.015);
}

TEST(Ward, DoesNotConserveEnergy) {
  const WardLobe ward(Rgb::Ones(), 0.3, 0.3, WardNormalisation::ward);
  const WardLobe duer(Rgb::Ones(), 0.3, 0.3, WardNormalisation::duer);
  EXPECT_NEAR(albedo(ward, degrees(75)), 0.28, 0.005);
  EXPECT_NEAR(albedo(duer, degrees(75)), 0.84, 0.005);
  EXPECT_NEAR(albedo(duer, degrees(88)), 2.38, 0.01);
  EXPECT_EQ(ward.traits().albedo_bound, 0);
  EXPECT_EQ(duer.traits().albedo_bound, 0);
}

TEST(Ward, EndsAtItsLargestValueWhereItHasNone) {
  const Vec3 wo(1, 0, 1e-200);
  const Vec3 wi(-1, 0, 1e-200);
  const WardLobe duer({0, 0.5, 1}, 0.1, 0.1, WardNormalisation::duer);
  EXPECT_TRUE((duer.eval(wo, wi) == Rgb(0, 0.5, 1) * WardLobe::kLargest).all());
  EXPECT_EQ(duer.pdf(wo, wi), WardLobe::kLargest);
}

TEST(Sum, AddsValuesAndMixesDensities) {
  const auto lambert = std::make_shared<const Lambert>(Rgb(0.1, 0.2, 0.3));
  const auto gloss = std::make_shared<const Ggx>(Rgb(0.5, 0.5, 0.5), 0.2, 0.4);
  const Sum sum(lambert, gloss, 0.25);
  const Vec3 wo = degrees(40);
  const Vec3 wi = degrees(30, 200);
  EXPECT_TRUE((sum.eval(wo, wi) == lambert->eval(wo, wi) + gloss->eval(wo, wi)).all());
  EXPECT_DOUBLE_EQ(sum.pdf(wo, wi), 0.25 * lambert->pdf(wo, wi) + 0.75 * gloss->pdf(wo, wi));
  EXPECT_FALSE(sum.traits().isotropic);
  EXPECT_DOUBLE_EQ(sum.traits().albedo_bound, 1.3);
  EXPECT_THROW(Sum(lambert, nullptr, 0.5), std::invalid_argument);
  EXPECT_THROW(Sum(lambert, gloss, 1.5), std::domain_error);
}

TEST(Analytic, BadArgumentsAreNamed) {
  EXPECT_THROW(Lambert({0.1, 1.1, 0.2}), std::domain_error);
  EXPECT_THROW(Lambert({0.1, std::nan(""), 0.2}), std::domain_error);
  EXPECT_THROW(Ggx({0.1, -0.1, 0.2}, 0.5), std::domain_error);
  EXPECT_THROW(Ggx(Rgb::Ones(), 0.0), std::domain_error);
  EXPECT_THROW(Ggx(Rgb::Ones(), 1.5), std::domain_error);
  try {
    Ggx(Rgb::Ones(), 1.5);
  } catch (const std::domain_error& error) {
    EXPECT_STREQ(error.what(), "Ggx: alpha must be in [1e-06, 1], got 1.5");
  }
}

}  // namespace
}  // namespace sklar::brdf
