/// Models that are a diffuse base and lobes with headers of their own.

#include <gtest/gtest.h>

#include <numbers>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/halfway_disk.hpp"
#include "brdf/analytic/neumann.hpp"
#include "brdf/analytic/registry.hpp"
#include "brdf/geometry/frame.hpp"
#include "brdf/render/hemisphere.hpp"
#include "tests/support/textbook.hpp"

namespace sklar::brdf {
namespace {

using namespace test;
constexpr double kPi = std::numbers::pi;

TEST(DiffuseModels, AddTheirLobesToTheBase) {
  const BrdfPtr ggx = analytic::find("ggx_diffuse").make({0.1, 0.2, 0.3, 0.04, 0.5, 1, 0.2});
  const BrdfPtr two = analytic::find("ggx_two_lobes").make({0.1, 0.2, 0.3, 0.04, 0.5, 1, 0.2, 0.3, 0, 0.1, 0.6});
  const BrdfPtr neumann = analytic::find("neumann_diffuse").make({0.1, 0.2, 0.3, 0.04, 0.5, 1, 30});
  const Rgb base = Rgb(0.1, 0.2, 0.3) / kPi;
  const Ggx lobe({0.04, 0.5, 1}, 0.2);
  const Ggx haze({0.3, 0, 0.1}, 0.6);
  const Neumann stretched({0.04, 0.5, 1}, 30);
  for_pairs([&](const Vec3& wo, const Vec3& wi) {
    const Rgb one = base + lobe.eval(wo, wi);
    const Rgb both = one + haze.eval(wo, wi);
    const Rgb metal = base + stretched.eval(wo, wi);
    EXPECT_LT((ggx->eval(wo, wi) / one - 1).abs().maxCoeff(), kEps);
    EXPECT_LT((two->eval(wo, wi) / both - 1).abs().maxCoeff(), kEps);
    EXPECT_LT((neumann->eval(wo, wi) / metal - 1).abs().maxCoeff(), kEps);
  });
}

TEST(DiffuseModels, PeaksAtNormalIncidence) {
  // D = 1 / (pi alpha^2), G2 = 1, F = f0 and both cosines 1.
  const BrdfPtr two = analytic::find("ggx_two_lobes").make({0.1, 0, 0.3, 0.04, 0.5, 0.2, 0.1, 0.3, 0.1, 0.6, 0.5});
  const Rgb expected =
      Rgb(0.1, 0, 0.3) / kPi + Rgb(0.04, 0.5, 0.2) / (4 * kPi * 0.01) + Rgb(0.3, 0.1, 0.6) / (4 * kPi * 0.25);
  EXPECT_LT((two->eval(Vec3::UnitZ(), Vec3::UnitZ()) / expected - 1).abs().maxCoeff(), 10 * kEps);
}

TEST(DiffuseModels, StrengthOfGgxIsTheMeanOfItsFresnelTerm) {
  // A mirror would reflect F(theta): the mean over the cosine is f0 + (1 - f0) / 21, as the integral of 2 c (1 - c)^5.
  const Ggx lobe({0, 0.3, 1}, 0.2);
  const double schlick = hemisphere([](const Vec3& w) { return w.z() / kPi * std::pow(1 - w.z(), 5); });
  EXPECT_NEAR(lobe.strength()[0], schlick, kQuadrature);
  EXPECT_NEAR(lobe.strength()[1], 0.3 + 0.7 * schlick, kQuadrature);
  EXPECT_EQ(lobe.strength()[2], 1);
}

// What Edwards et al. build it for: the albedo is that asked for, grazing included.
TEST(HalfwayDisk, SendsBackItsAlbedoAtEveryAngle) {
  for (const double exponent : {1.0, 8.0, 200.0}) {
    const HalfwayDiskLobe lobe({0.2, 0.5, 1}, exponent);
    for (const double theta_o : {0.0, 30.0, 60.0, 80.0, 88.0}) {
      const HemisphereNodes nodes = hemisphere_nodes(theta_o * kPi / 180, {.polar = 400, .azimuth = 400});
      const Vec3 wo = spherical_direction(theta_o * kPi / 180, 0);
      Rgb albedo = Rgb::Zero();
      for (Eigen::Index i = 0; i < nodes.wi.rows(); ++i) {
        albedo += lobe.eval(wo, Vec3(nodes.wi.row(i).transpose())) * nodes.weight(i);
      }
      EXPECT_LT((albedo / Rgb(0.2, 0.5, 1) - 1).abs().maxCoeff(), 1e-3) << exponent << " " << theta_o;
    }
  }
}

// At normal incidence m is tan(theta_h) exp(i phi_h): in the mirror direction f_r is specular (n + 1) / (4 pi).
TEST(HalfwayDisk, PeaksInTheMirrorDirection) {
  const HalfwayDiskLobe lobe(Rgb::Ones(), 50);
  EXPECT_NEAR(lobe.eval(Vec3::UnitZ(), Vec3::UnitZ())[0], 51 / (4 * kPi), 1e-12);
}

// It is not reciprocal, as published, and says so.
TEST(HalfwayDisk, ClaimsNoReciprocity) {
  const HalfwayDiskLobe lobe(Rgb::Ones(), 8);
  EXPECT_FALSE(lobe.traits().reciprocal);
  const Vec3 wo = spherical_direction(1.2, 0), wi = spherical_direction(0.4, 2.5);
  EXPECT_GT(std::abs(lobe.eval(wo, wi)[0] / lobe.eval(wi, wo)[0] - 1), 0.1);
}

}  // namespace
}  // namespace sklar::brdf
