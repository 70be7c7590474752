#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "brdf/analytic/ashikhmin_premoze_shirley.hpp"
#include "brdf/analytic/registry.hpp"
#include "tests/support/textbook.hpp"

namespace sklar::brdf {
namespace {

using namespace test;
constexpr double kPi = std::numbers::pi;

/// A density at 1 + `steps` nodes, finer toward the normal.
template <typename Function>
std::shared_ptr<const TabulatedDensity> tabulated(int steps, const Function& density) {
  std::vector<double> theta, values;
  for (int n = 0; n <= steps; ++n) {
    theta.push_back(kPi / 2 * std::pow(static_cast<double>(n) / steps, 3));
    values.push_back(density(theta.back()));
  }
  return std::make_shared<const TabulatedDensity>(theta, values);
}

/// D of GGX.
double ggx_facets(double alpha, double theta) {
  const double cosine = std::cos(theta);
  return alpha * alpha / (kPi * std::pow(cosine * cosine * (alpha * alpha - 1) + 1, 2));
}

/// Of a direction: cos + l of Heitz 2018, eq. 2, twice the projected area of GGX's facets.
double ggx_area(double alpha, double cosine) {
  return cosine + std::sqrt(cosine * cosine + alpha * alpha * (1 - cosine * cosine));
}

TEST(MicrofacetGenerator, UniformNormalsAreThoseOfASphere) {
  // Seen from k a hemisphere shows pi (1 + cos) / 2 of its 2 pi: g = (1 + cos) / 4, f_r = F / (pi (1 + cos_i) (1 +
  // cos_o)).
  const TabulatedDensity sphere({0, 0.4, kPi / 2}, {3, 3, 3});
  EXPECT_NEAR(sphere(0.3), 0.5 / kPi, kEps);
  EXPECT_NEAR(FacetArea(sphere).of_normal(), 0.5, kEps);
  const AshikhminPremozeShirleyLobe lobe({0.2, 0.5, 1}, tabulated(256, [](double) { return 1.0; }));
  for_pairs([&](const Vec3& wo, const Vec3& wi) {
    const double fresnel = 0.2 + 0.8 * std::pow(1 - std::cos(Angles(wo, wi).theta_d), 5);
    const double expected = fresnel / (kPi * (1 + wi.z()) * (1 + wo.z()));
    EXPECT_NEAR(lobe.eval(wo, wi)[0] / expected, 1, 1e-4);
  });
}

TEST(MicrofacetGenerator, GgxNormalsGiveSmithsMaskingWithoutCorrelation) {
  // F D G1(wi) G1(wo) / (4 cos_i cos_o), G1 = 2 cos / (cos + l): Walter et al. 2007, eqs. 20, 23 and 34.
  for (const double alpha : {0.05, 0.3, 1.0}) {
    const auto normals = tabulated(512, [&](double theta) { return ggx_facets(alpha, theta); });
    const AshikhminPremozeShirleyLobe lobe({0.04, 0.5, 1}, normals);
    const FacetArea area(*normals);
    for (const double cosine : {0.001, 0.01, 0.1, 0.5, 0.9, 1.0}) {
      const double expected = 0.5 * ggx_area(alpha, cosine) * area.of_normal();
      EXPECT_NEAR(area(cosine) / expected, 1, 1e-3) << alpha << " " << cosine;
    }
    for_pairs([&](const Vec3& wo, const Vec3& wi) {
      const double facets = ggx_facets(alpha, Angles(wo, wi).theta_h);
      const double expected = facets / (ggx_area(alpha, wi.z()) * ggx_area(alpha, wo.z()));
      EXPECT_NEAR(lobe.eval(wo, wi)[2] / expected, 1, 3e-3) << alpha;
    });
  }
}

TEST(MicrofacetGenerator, ReflectsAtMostWhatArrives) {
  for (const double velvet : {0.0, 0.5, 1.0}) {
    for (const double roughness : {0.1, 0.5}) {
      const AshikhminPremozeShirleyLobe white(Rgb::Ones(),
                                              std::make_shared<const VelvetDensity>(roughness, velvet, 0.3));
      for (const double theta : {0.0, 60.0, 89.0}) {
        EXPECT_LE(albedo(white, degrees(theta)), 1 + kQuadrature) << velvet << " " << roughness << " " << theta;
      }
    }
  }
}

TEST(MicrofacetGenerator, SmoothSurfaceReflectsTheFresnelTerm) {
  const AshikhminPremozeShirleyLobe lobe(Rgb::Constant(0.3), std::make_shared<const VelvetDensity>(0.02, 0, 1));
  for (const double theta : {0.0, 45.0, 60.0}) {
    const double schlick = 0.3 + 0.7 * std::pow(1 - std::cos(theta * kPi / 180), 5);
    EXPECT_NEAR(albedo(lobe, degrees(theta)) / schlick, 1, 0.01) << theta;
  }
}

TEST(MicrofacetGenerator, VelvetIsBrightestAtItsRim) {
  const BrdfPtr velvet = analytic::find("ashikhmin_premoze_shirley").make({0, 0, 0, 0.1, 0.1, 0.1, 0.3, 1, 0.1});
  const auto seen = [&](double theta) { return velvet->eval(degrees(theta), degrees(theta))[0]; };
  EXPECT_LT(seen(10), 0.01 * seen(80)) << "back toward the light";
  EXPECT_LT(seen(60), seen(85));
}

TEST(TabulatedDensity, DrawsFollowTheShareBelow) {
  const TabulatedDensity density({0, 0.5, 1, kPi / 2}, {0, 4, 0, 1});
  // Shares of the pieces: widths in 1 - cos times mean densities.
  const double a = (1 - std::cos(0.5)) * 2, b = (std::cos(0.5) - std::cos(1)) * 2, c = std::cos(1) * 0.5;
  const double mass = a + b + c;
  EXPECT_NEAR(density.draw(a / mass), 1 - std::cos(0.5), 1e-12);
  EXPECT_NEAR(density.draw((a + b) / mass), 1 - std::cos(1), 1e-6) << "where the density is 0 the share is flat";
  EXPECT_NEAR(density.draw(0.25 * a / mass), 0.5 * (1 - std::cos(0.5)), 1e-12) << "a quarter below half of a ramp";
  EXPECT_EQ(density.draw(1), 1);
  EXPECT_NEAR(density(1 - std::cos(0.5)), 4 / (2 * kPi * mass), 1e-12);
}

TEST(TabulatedDensity, IsDrawnByTheLobe) {
  const auto density = std::make_shared<const TabulatedDensity>(std::vector<double>{0, 0.5, 1, kPi / 2},
                                                                std::vector<double>{1, 4, 0, 1});
  const AshikhminPremozeShirleyLobe lobe(Rgb::Ones(), density);
  check_sampler(lobe, degrees(40), seed_of_this_test(), {.draws = 200000, .mass_tolerance = 1e-6});
}

TEST(VelvetDensity, AgreesWithItsFormula) {
  const VelvetDensity density(0.4, 0.3, 0.2);
  for (const double theta : {0.0, 0.3, 1.0, 1.5}) {
    const double c = std::cos(theta);
    const double flat = std::exp(-std::pow(std::tan(theta) / 0.4, 2)) / (kPi * 0.16 * c * c * c);
    const double upright = std::exp(-c / 0.2) / (2 * kPi * 0.2 * (1 - std::exp(-5)));
    EXPECT_NEAR(density(1 - c) / (0.7 * flat + 0.3 * upright), 1, 1e-12) << theta;
  }
  EXPECT_NEAR(hemisphere([&](const Vec3& h) { return density(1 - h.z()); }), 1, kQuadrature);
  EXPECT_EQ(density(1), 0.3 / (2 * kPi * (0.2 * -std::expm1(-5))));
}

TEST(TabulatedDensity, RefusesWhatIsNoDensity) {
  EXPECT_THROW(TabulatedDensity({0, kPi / 2}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(TabulatedDensity({0, 1}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(TabulatedDensity({0.1, kPi / 2}, {1, 1}), std::invalid_argument);
  EXPECT_THROW(TabulatedDensity({0, 1, 1, kPi / 2}, {1, 1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(TabulatedDensity({0, kPi / 2}, {1, -1}), std::domain_error);
  EXPECT_THROW(TabulatedDensity({0, kPi / 2}, {1, std::nan("")}), std::domain_error);
  EXPECT_THROW(TabulatedDensity({0, kPi / 2}, {0, 0}), std::domain_error);
  EXPECT_THROW(AshikhminPremozeShirleyLobe(Rgb::Ones(), nullptr), std::invalid_argument);
}

}  // namespace
}  // namespace sklar::brdf
