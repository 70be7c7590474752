/// Each model against its formula as printed, and against a number or a limit that its source gives.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "brdf/analytic/blinn_phong.hpp"
#include "brdf/analytic/lafortune.hpp"
#include "brdf/analytic/neumann.hpp"
#include "brdf/analytic/oren_nayar.hpp"
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

TEST(Lafortune, AgreesWithItsSourceInAngles) {
  const AnalyticValues values = {0.1, 0,   0.3, 0.2, 0.3, 0.4, -1,  -0.8, 0.9, 30, 0.1, 0.1,
                                 0.2, 0.9, 0.7, 0.6, 5,   0.3, 0.2, 0.1,  -1,  -1, 0.5, 1.5};
  const BrdfPtr model = analytic::find("lafortune").make(values);
  EXPECT_FALSE(model->traits().isotropic);
  for_pairs([&](const Vec3& wo, const Vec3& wi) {
    const Angles a(wo, wi);
    double expected = 0.1 / kPi;
    for (const std::size_t at : {3U, 10U, 17U}) {
      const double sines = std::sin(a.theta_i) * std::sin(a.theta_o);
      const double sum = values[at + 3] * sines * std::cos(a.phi_i) * std::cos(a.phi_o) +
                         values[at + 4] * sines * std::sin(a.phi_i) * std::sin(a.phi_o) +
                         values[at + 5] * std::cos(a.theta_i) * std::cos(a.theta_o);
      const double n = values[at + 6];
      expected += values[at] * (n + 2) / (2 * kPi) * std::pow(std::max(sum, 0.0), n);
    }
    EXPECT_NEAR(model->eval(wo, wi)[0] / expected, 1, 1e-12);
  });
}

TEST(Lafortune, MirrorDirectionIsThePhongLobe) {
  const LafortuneLobe lobe({0.1, 0.5, 1.0}, {-1, -1, 1}, 40);
  const PhongLobe phong({0.1, 0.5, 1.0}, 40);
  EXPECT_TRUE(lobe.traits().isotropic);
  for_pairs([&](const Vec3& wo, const Vec3& wi) {
    const double expected = phong.eval(wo, wi)[0];
    if (expected < kVisible) return;
    const double cosine = std::cos(Angles(wo, wi).alpha);
    EXPECT_NEAR(lobe.eval(wo, wi)[0] / expected, 1, 40 * kEps / cosine);
    EXPECT_NEAR(lobe.pdf(wo, wi) / phong.pdf(wo, wi), 1, 40 * kEps / cosine);
  });
}

TEST(Lafortune, LobesLieAlongTheirAxis) {
  const Vec3 wo = degrees(50, 20);
  const LafortuneLobe back(Rgb::Ones(), {1, 1, 1}, 100);
  EXPECT_NEAR(back.eval(wo, wo)[0], 102 / (2 * kPi), 1e-12) << "its peak is where light came from";
  // Cz < -Cx: tan of the peak is tan(theta_o) Cx / Cz.
  const LafortuneLobe flat(Rgb::Ones(), {-1, -1, 0.7}, 100);
  const double peak = std::atan(std::tan(50 * kPi / 180) / 0.7) * 180 / kPi;
  const double most = flat.eval(wo, degrees(peak, 200))[0];
  EXPECT_LT(flat.eval(wo, degrees(peak - 1, 200))[0], most);
  EXPECT_LT(flat.eval(wo, degrees(peak + 1, 200))[0], most);
}

TEST(Lafortune, AlbedoAtNormalIncidenceIsSpecularTimesAPowerOfCz) {
  EXPECT_NEAR(albedo(LafortuneLobe(Rgb::Ones(), {-0.9, -0.2, 0.9}, 12), Vec3::UnitZ()), std::pow(0.9, 12), kQuadrature);
}

TEST(Lafortune, LobesOfNoSpecularAreLeftOut) {
  const AnalyticInfo& info = analytic::find("lafortune");
  EXPECT_LT(info.make(info.examples[0])->bytes(), info.make(info.examples[2])->bytes());
  EXPECT_LT(info.make(info.examples[2])->bytes(), info.make(info.examples[1])->bytes());
}

TEST(OrenNayar, AgreesWithEquation30) {
  for (const double sigma : {0.1, 0.5, 1.2}) {
    const OrenNayar model({0.1, 0.5, 1.0}, sigma);
    for_pairs([&](const Vec3& wo, const Vec3& wi) {
      const Angles angles(wo, wi);
      const double square = sigma * sigma;
      const double alpha = std::max(angles.theta_i, angles.theta_o);
      const double beta = std::min(angles.theta_i, angles.theta_o);
      const double expected = 0.5 / kPi *
                              (1 - 0.5 * square / (square + 0.33) +
                               0.45 * square / (square + 0.09) * std::max(0.0, std::cos(angles.phi_i - angles.phi_o)) *
                                   std::sin(alpha) * std::tan(beta));
      EXPECT_NEAR(model.eval(wo, wi)[1] / expected, 1, 100 * kEps / std::cos(beta));
    });
  }
}

TEST(OrenNayar, SigmaZeroIsLambert) {
  const OrenNayar model({0.1, 0.5, 1.0}, 0);
  const Lambert lambert({0.1, 0.5, 1.0});
  for_pairs([&](const Vec3& wo, const Vec3& wi) { EXPECT_TRUE((model.eval(wo, wi) == lambert.eval(wo, wi)).all()); });
  EXPECT_EQ(model.traits().albedo_bound, lambert.traits().albedo_bound);
}

TEST(OrenNayar, AlbedoIsAPlusBTimesAFunctionOfTheta) {
  // The integral of eq. 30 times cos_i: A + 2 B / pi (sin t (t - sin t cos t) / 2 + tan t (1 - sin^3 t) / 3).
  constexpr double kSigma = 0.3;
  constexpr double kA = 1 - 0.5 * 0.09 / 0.42;
  constexpr double kB = 0.45 * 0.5;
  const OrenNayar model(Rgb::Ones(), kSigma);
  double last = 0;
  // Both kinks of the integrand, in theta and phi, lie on borders of cells of the quadrature.
  for (const double theta : {0.0, 22.5, 45.0, 67.5}) {
    const double t = theta * kPi / 180;
    const double sine = std::sin(t);
    const double shape = sine * (t - sine * std::cos(t)) / 2 + std::tan(t) * (1 - sine * sine * sine) / 3;
    const double found = albedo(model, degrees(theta, 0));
    EXPECT_NEAR(found, kA + 2 * kB / kPi * shape, 1e-4) << theta;
    EXPECT_GT(found, last);
    EXPECT_LE(found, model.traits().albedo_bound);
    last = found;
  }
  EXPECT_NEAR(model.traits().albedo_bound, kA + kB / 2, 10 * kEps);
  EXPECT_NEAR(OrenNayar(Rgb::Ones(), 0.2).traits().albedo_bound, 1.015, 5e-4) << "more than arrives";
}

TEST(OrenNayar, EndsAtItsLargestValue) {
  const double value = OrenNayar(Rgb::Ones(), 1).eval(kGrazing, kGrazing)[0];
  EXPECT_NEAR(value * kPi / (0.45 / 1.09 * OrenNayar::kLargest), 1, 10 * kEps);
}

TEST(Neumann, AgreesWithItsSourceInAngles) {
  for (const double n : {0.5, 5.0, 2000.0}) {
    const Neumann model({0.1, 0.5, 1.0}, n);
    for_pairs([&](const Vec3& wo, const Vec3& wi) {
      const Angles angles(wo, wi);
      const double cosine = std::cos(angles.alpha);
      const double largest = std::cos(std::min(angles.theta_i, angles.theta_o));
      const double expected = cosine > 0 ? (n + 1) / (2 * kPi) * std::pow(cosine, n) / largest : 0;
      if (expected < kVisible) return;
      EXPECT_NEAR(model.eval(wo, wi)[1] / (0.5 * expected), 1, 10 * kEps * ((n + 1) / cosine + 1 / largest));
    });
  }
}

TEST(Neumann, AlbedoAtNormalIncidence) {
  for (const double n : {1.0, 10.0, 300.0}) {
    EXPECT_NEAR(albedo(Neumann(Rgb::Ones(), n), Vec3::UnitZ()), (n + 1) / (n + 2), kQuadrature) << n;
  }
}

TEST(Neumann, SmoothMetalDoesNotDarkenWithTheAngle) {
  const Neumann metal(Rgb::Constant(0.9), 3e4);
  const PhongLobe phong(Rgb::Constant(0.9), 3e4);
  for (const double theta : {0.0, 45.0, 75.0}) {
    EXPECT_NEAR(albedo(metal, degrees(theta)) / 0.9, 1, 0.01) << theta;
    EXPECT_NEAR(albedo(phong, degrees(theta)) / 0.9, std::cos(theta * kPi / 180), 0.01) << theta;
  }
}

TEST(Neumann, EndsAtItsLargestValue) {
  EXPECT_EQ(Neumann(Rgb::Ones(), 10).eval(kGrazing, kOpposite)[0], power_lobe::kLargest);
}

}  // namespace
}  // namespace sklar::brdf
