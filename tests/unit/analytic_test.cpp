#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/geometry/frame.hpp"
#include "tests/support/sampler_check.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-14;
constexpr double kAlphas[] = {0.02, 0.1, 0.4, 1.0};
constexpr double kThetaO[] = {0.0, 5.0, 45.0, 75.0, 89.0};  // degrees
constexpr int kSamplerTests = 4 * 5 + 5;

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
    const double theta = kPi / 2 / kCells * (cell / kCells);
    const double phi = 2 * kPi / kCells * (cell % kCells);
    sum += test::integrate(
        [&](double t, double p) {
          return model.eval(wo, spherical_direction(t, p)).maxCoeff() * std::cos(t) * std::sin(t);
        },
        theta, theta + kPi / 2 / kCells, phi, phi + 2 * kPi / kCells, 1e-6 / kCells / kCells);
  }
  return sum;
}

void expect_reciprocal(const Brdf& model) {
  Rng rng(test::seed_of_this_test());
  for (int n = 0; n < 20000; ++n) {
    const Vec3 wi = random_direction(rng);
    const Vec3 wo = random_direction(rng);
    const Rgb value = model.eval(wo, wi);
    ASSERT_TRUE((value == model.eval(wi, wo)).all());
    ASSERT_TRUE((value >= 0).all() && value.isFinite().all());
    ASSERT_TRUE((model.eval(wo, Vec3(wi.x(), wi.y(), -wi.z())) == 0).all());
    ASSERT_EQ(model.pdf(wo, Vec3(wi.x(), wi.y(), -wi.z())), 0);
  }
}

TEST(Lambert, ReciprocalAndDarkBelowTheHorizon) {
  expect_reciprocal(Lambert({0.1, 0.5, 1.0}));
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

TEST(Lambert, SamplerFollowsItsDensity) {
  const Lambert model({0.1, 0.5, 1.0});
  for (const double theta : kThetaO) {
    test::check_sampler(model, degrees(theta), test::seed_of_this_test(),
                        {.tests = kSamplerTests, .missing_tolerance = 1e-6});
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

TEST(Ggx, ReciprocalAndDarkBelowTheHorizon) {
  for (const double alpha : {1e-6, 0.02, 0.4, 1.0}) expect_reciprocal(Ggx({0.0, 0.5, 1.0}, alpha));
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

class GgxSampler : public testing::TestWithParam<double> {};

TEST_P(GgxSampler, FollowsItsDensity) {
  const Ggx model({0.04, 0.5, 1.0}, GetParam());
  for (const double theta : kThetaO) {
    const double total =
        test::check_sampler(model, degrees(theta), test::seed_of_this_test(), {.tests = kSamplerTests});
    // The rest is drawn below the horizon. Seen along z, visible normals have P(theta_h < t) = tan^2 / (tan^2 +
    // alpha^2), and those past 45 degrees reflect downwards.
    if (theta == 0) {
      EXPECT_NEAR(total, 1 / (1 + GetParam() * GetParam()), 1e-6);
    }
    EXPECT_GT(total, 0.49) << theta;
  }
}

INSTANTIATE_TEST_SUITE_P(Alpha, GgxSampler, testing::ValuesIn(kAlphas));

TEST(Ggx, DrawsFromBelowTheHorizonWeighNothing) {
  const Ggx model(Rgb::Ones(), 0.3);
  for (const Vec3& wo : {Vec3(0, 0, -1), Vec3(0.6, 0, -0.8), Vec3(1, 0, 0)}) {
    const Sample draw = model.sample(wo, {0.3, 0.7});
    EXPECT_EQ(draw.pdf, 0);
    EXPECT_TRUE((draw.weight == 0).all());
    EXPECT_FALSE(draw.wi.hasNaN());
  }
}

TEST(Analytic, BadParametersAreNamed) {
  EXPECT_THROW(Lambert({0.1, 1.1, 0.2}), std::domain_error);
  EXPECT_THROW(Lambert({0.1, std::nan(""), 0.2}), std::domain_error);
  EXPECT_THROW(Ggx({0.1, -0.1, 0.2}, 0.5), std::domain_error);
  EXPECT_THROW(Ggx(Rgb::Ones(), 0.0), std::domain_error);
  EXPECT_THROW(Ggx(Rgb::Ones(), 1.5), std::domain_error);
  try {
    Ggx(Rgb::Ones(), 1.5);
  } catch (const std::domain_error& error) {
    EXPECT_STREQ(error.what(), "Ggx: alpha must be in [1e-06,1], got 1.5");
  }
}

}  // namespace
}  // namespace sklar::brdf
