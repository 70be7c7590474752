#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <complex>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/sum.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/data/material.hpp"
#include "brdf/data/table_brdf.hpp"
#include "brdf/geometry/half_disk.hpp"
#include "brdf/model/paper_fit.hpp"
#include "brdf/model/refined_fit.hpp"
#include "brdf/render/hemisphere.hpp"
#include "brdf/sampling/disk_warp.hpp"
#include "brdf/sampling/sampled_brdf.hpp"
#include "brdf/study/efficiency.hpp"
#include "families/registry.hpp"
#include "tests/support/function_brdf.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/sampler_check.hpp"

namespace sklar::brdf {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::size_t kMostBytes = 16384;

const MeasuredTable& builtin() {
  static const MeasuredTable kTable = builtin_material();
  return kTable;
}

struct Kind {
  std::string name;
  std::function<BrdfPtr()> make;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kList = {
      {"paper",
       [] {
         return BrdfPtr(
             fit_paper(builtin(), families::find("gumbel"), {.slices = 2, .method = FitMethod::maximum_likelihood})
                 .brdf);
       }},
      {"refined",
       [] {
         const RefinedStructure structure{.components = 2, .half = 10, .difference = 6};
         return BrdfPtr(fit_refined(builtin(), {.structure = structure, .evaluations = 12}).brdf);
       }},
      {"table", [] { return std::make_shared<const TableBrdf>(std::make_shared<const MeasuredTable>(builtin())); }},
      {"lambert", [] { return std::make_shared<const Lambert>(Rgb(0.2, 0.5, 0.8)); }},
      {"rough", [] { return std::make_shared<const Ggx>(Rgb(0.9, 0.6, 0.3), 0.5); }},
      {"glossy",
       [] {
         return with_diffuse({0.1, 0.1, 0.3}, std::make_shared<const Ggx>(Rgb(0.04, 0.04, 0.04), 0.1), {0.1, 0.1, 0.1});
       }},
      {"black", [] { return std::make_shared<const Lambert>(Rgb(0, 0, 0)); }},
      {"brushed", [] { return brushed_metal(); }},
  };
  return kList;
}

/// One sampler a kind, made once.
const SampledBrdf& sampled(std::size_t kind) {
  static std::vector<std::unique_ptr<SampledBrdf>> made(kinds().size());
  if (!made[kind]) made[kind] = std::make_unique<SampledBrdf>(kinds()[kind].make());
  return *made[kind];
}

class SampledKind : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(All, SampledKind, testing::Range(std::size_t{0}, kinds().size()),
                         [](const auto& test) { return kinds()[test.param].name; });

// Chi-square against pdf, no draw where it is 0, weights, and albedo by both kinds of draws.
TEST_P(SampledKind, DrawsFollowTheDensity) {
  const auto tests = static_cast<int>(kinds().size() * test::sampled_directions().size());
  for (const Vec3& wo : test::sampled_directions()) {
    test::check_sampler(sampled(GetParam()), wo, test::seed_of_this_test(),
                        {.draws = test::sampler_draws() / 5,
                         .theta_cells = 16,
                         .phi_cells = 32,
                         .tests = tests,
                         .mass_tolerance = 5e-6});
  }
}

// No draw is lost below the horizon: the density integrates to 1, to the error of the quadrature at its knots.
TEST_P(SampledKind, TheDensityIntegratesToOne) {
  constexpr double kKnots = 4e-3;
  const SampledBrdf& brdf = sampled(GetParam());
  for (const double theta_o : {0.0, 5.0, 30.0, 60.0, 75.0, 85.0}) {
    const HemisphereNodes nodes = hemisphere_nodes(theta_o * kDegree, {.polar = 200, .azimuth = 200});
    const Vec3 wo = spherical_direction(theta_o * kDegree, 0);
    double sum = 0;
    for (Eigen::Index i = 0; i < nodes.wi.rows(); ++i) {
      const Vec3 wi = nodes.wi.row(i).transpose();
      sum += brdf.pdf(wo, wi) * nodes.weight(i) / wi.z();
    }
    EXPECT_NEAR(sum, 1, kKnots) << theta_o;
  }
}

TEST_P(SampledKind, IsFiniteAndCoversTheHemisphereEverywhere) {
  const SampledBrdf& brdf = sampled(GetParam());
  Rng rng(test::seed_of_this_test());
  const double turned = 33 * kDegree;
  for (const double theta_o : {0.0, 1e-9, 1e-4, 45.0, 89.0, 89.99, 90 - 1e-7, 90 - 1e-11}) {
    const Vec3 wo = spherical_direction(theta_o * kDegree, turned);
    for (int n = 0; n < 4000; ++n) {
      const Vec2 uniforms = n == 0   ? Vec2(1e-16, 1e-16)
                            : n == 1 ? Vec2(1 - 0x1p-53, 1 - 0x1p-53)
                            : n == 2 ? Vec2(1 - 0x1p-53, 0.5)
                                     : Vec2(uniform(rng), uniform(rng));
      const Sample draw = brdf.sample(wo, uniforms);
      ASSERT_TRUE(draw.wi.allFinite()) << theta_o << " | " << uniforms.transpose();
      ASSERT_NEAR(draw.wi.norm(), 1, 1e-9) << theta_o << " | " << uniforms.transpose();
      ASSERT_TRUE(std::isfinite(draw.pdf) && draw.pdf >= 0) << theta_o << " | " << uniforms.transpose();
      ASSERT_TRUE(draw.weight.isFinite().all() && (draw.weight >= 0).all()) << theta_o;
      ASSERT_EQ(draw.pdf, brdf.pdf(wo, draw.wi));
      const Vec3 wi = test::uniform_hemisphere(rng);
      ASSERT_GE(brdf.pdf(wo, wi), ConditionalSampler::kCosineShare * wi.z() * std::numbers::inv_pi) << theta_o;
      ASSERT_EQ(brdf.pdf(wo, Vec3(wi.x(), wi.y(), -wi.z())), 0);
    }
  }
  const Vec3 below = spherical_direction(120 * kDegree, 0);
  const Sample draw = brdf.sample(below, {0.3, 0.6});
  EXPECT_EQ(draw.pdf, 0);
  EXPECT_TRUE(draw.wi.allFinite() && (draw.weight == 0).all());
}

// The density does not jump between nodes of theta_o, knots, or where the plane of incidence loses its meaning.
TEST_P(SampledKind, TheDensityIsContinuous) {
  constexpr double kStep = 1e-7, kChange = 1e-3;  // relative change for a step of that angle, both directions
  const SampledBrdf& brdf = sampled(GetParam());
  Rng rng(test::seed_of_this_test());
  double worst = 0;
  for (int n = 0; n < 20000; ++n) {
    const double theta_o = 85 * kDegree * (n % 5 == 0 ? 1e-6 : 1) * uniform(rng);
    const Vec3 wo = spherical_direction(theta_o, 1), near = spherical_direction(theta_o + kStep, 1);
    const Vec3 wi = test::uniform_hemisphere(rng);
    if (wi.z() < 0.02) continue;
    const Eigen::AngleAxisd turn(kStep, Vec3(uniform(rng), uniform(rng), uniform(rng)).normalized());
    worst = std::max(worst, std::abs(brdf.pdf(near, turn * wi) / brdf.pdf(wo, wi) - 1));
  }
  EXPECT_LT(worst, kChange);
}

TEST_P(SampledKind, IsDeterministicAndSmall) {
  const SampledBrdf& brdf = sampled(GetParam());
  EXPECT_LE(brdf.sampler().bytes(), kMostBytes);
  EXPECT_EQ(brdf.bytes(), brdf.brdf()->bytes() + brdf.sampler().bytes());
  const SampledBrdf again(brdf.brdf());
  Rng rng(test::seed_of_this_test());
  for (int n = 0; n < 1000; ++n) {
    const Vec3 wo = test::uniform_hemisphere(rng);
    const Vec2 uniforms(uniform(rng), uniform(rng));
    const Sample a = brdf.sample(wo, uniforms), b = again.sample(wo, uniforms);
    ASSERT_TRUE(a.wi == b.wi && a.pdf == b.pdf && (a.weight == b.weight).all());
  }
}

// Draws and densities of each instruction set agree with those of the widest, and a draw has the density of its
// direction.
TEST_P(SampledKind, DrawsAlikeInEveryInstructionSet) {
  constexpr double kDirection = 1e-3, kDensity = 2e-5;  ///< apart; relative. A cell of the tables can be the next one
  const ConditionalSampler& sampler = sampled(GetParam()).sampler();
  constexpr int kDraws = 2000;
  Rng rng(test::seed_of_this_test());
  std::vector<Vec3> wo, wi;
  std::vector<Vec2> uniforms;
  std::vector<double> pdf;
  for (int n = 0; n < kDraws; ++n) {
    wo.push_back(test::uniform_hemisphere(rng));
    uniforms.emplace_back(uniform(rng), uniform(rng));
    wi.push_back(sampler.sample_direction(wo.back(), uniforms.back()));
    pdf.push_back(sampler.pdf(wo.back(), wi.back()));
  }
  test::for_each_target([&] {
    for (std::size_t n = 0; n < wo.size(); ++n) {
      const Draw draw = sampler.draw(wo[n], uniforms[n]);
      ASSERT_EQ(draw.wi, sampler.sample_direction(wo[n], uniforms[n]));
      ASSERT_EQ(draw.pdf, sampler.pdf(wo[n], draw.wi));
      ASSERT_LT((draw.wi - wi[n]).norm(), kDirection) << wo[n].transpose() << " | " << uniforms[n].transpose();
      ASSERT_NEAR(sampler.pdf(wo[n], wi[n]) / pdf[n], 1, kDensity) << wo[n].transpose() << " | " << wi[n].transpose();
    }
  });
}

TEST_P(SampledKind, ManyDrawsAreThoseOfOneAtATime) {
  constexpr Eigen::Index kDraws = 1003;
  const SampledBrdf& brdf = sampled(GetParam());
  Rng rng(test::seed_of_this_test());
  Directions wo(kDraws, 3);
  Eigen::ArrayX2d uniforms(kDraws, 2);
  for (Eigen::Index n = 0; n < kDraws; ++n) {
    wo.row(n) = test::uniform_hemisphere(rng).array().transpose();
    uniforms.row(n) << uniform(rng) * (n % 50 == 0 ? ConditionalSampler::kCosineShare : 1), uniform(rng);
  }
  wo.row(7) << 0, 0, 1;
  wo.row(19) << 0.6, 0, -0.8;
  wo.row(23) << 1, 0, 0;
  test::for_each_target([&] {
    const Samples many = brdf.sample(wo, uniforms);
    for (Eigen::Index n = 0; n < kDraws; ++n) {
      const Sample one = brdf.sample(Vec3(wo.row(n).transpose()), Vec2(uniforms.row(n).transpose()));
      ASSERT_EQ(one.wi, Vec3(many.wi.row(n).transpose())) << n;
      ASSERT_EQ(one.pdf, many.pdf(n)) << n;
      ASSERT_TRUE((one.weight == many.weight.row(n).transpose()).all()) << n;
    }
  });
  EXPECT_EQ(brdf.sample(wo.topRows(0), uniforms.topRows(0)).pdf.size(), 0);
  EXPECT_THROW(static_cast<void>(brdf.sample(wo, uniforms.topRows(5))), std::invalid_argument);
}

TEST(ConditionalSampler, FollowsWhatItIsMadeOf) {
  for (const double alpha : {1e-4, 0.03, 0.4}) {
    const SampledBrdf brdf(std::make_shared<const Ggx>(Rgb(0.9, 0.9, 0.9), alpha));
    for (const double theta_o : {5, 45, 75})
      EXPECT_LT(weight_deviation(brdf, theta_o * kDegree), 0.2) << alpha << " " << theta_o;
  }
  const SampledBrdf white(std::make_shared<const Lambert>(Rgb(1, 1, 1)));
  for (const double theta_o : {5, 45, 75, 85}) EXPECT_LT(weight_deviation(white, theta_o * kDegree), 0.04) << theta_o;
}

TEST(ConditionalSampler, FollowsMeasuredMaterials) {
  constexpr double kMost = 0.25;
  const char* data = std::getenv("SKLAR_TEST_DATA");
  if (data == nullptr) GTEST_SKIP() << "SKLAR_TEST_DATA is not set: no measured materials to read";
  for (const auto& file : std::filesystem::directory_iterator(std::filesystem::path(data) / "materials" / "rgl")) {
    const SampledBrdf brdf(read_material_brdf(file.path()));
    for (const double degrees : {5, 20, 45, 60, 75, 80}) {
      const double ours = weight_deviation(brdf, degrees * kDegree);
      const double cosine = weight_deviation(*brdf.brdf(), degrees * kDegree);  // the default sampler's
      EXPECT_LE(ours, kMost) << file.path() << " at " << degrees;
      EXPECT_LE(ours, cosine) << file.path() << " at " << degrees;
    }
  }
}

// A Fibonacci lattice in place of random uniforms has less than half the error of as many random draws.
TEST(ConditionalSampler, TakesUniformsThatAreNotRandom) {
  constexpr int kPoints = 4181, kStep = 2584;
  const SampledBrdf& brdf = sampled(4);
  const Vec3 wo = spherical_direction(40 * kDegree, 0);
  Rgb lattice = Rgb::Zero();
  for (int i = 0; i < kPoints; ++i) {
    const double second = (i * kStep % kPoints + 0.5) / kPoints;
    lattice += brdf.sample(wo, {(i + 0.5) / kPoints, second}).weight / kPoints;
  }
  const HemisphereNodes nodes = hemisphere_nodes(40 * kDegree, {.polar = 160, .azimuth = 160});
  Rgb albedo = Rgb::Zero();
  for (Eigen::Index i = 0; i < nodes.wi.rows(); ++i) {
    albedo += brdf.eval(wo, Vec3(nodes.wi.row(i).transpose())) * nodes.weight(i);
  }
  const double random = weight_deviation(brdf, 40 * kDegree) / std::sqrt(kPoints);
  EXPECT_LT(std::abs(lattice[1] / albedo[1] - 1), random / 2);
}

TEST(ConditionalSampler, RefusesNothing) {
  EXPECT_THROW(SampledBrdf(nullptr), std::invalid_argument);
}

// The map of the half vector to the disk, its inverse in the kernel's terms, and the solid angle by finite differences.
TEST(HalfDisk, IsTheMoebiusMapOfTheHalfVector) {
  constexpr double kRounding = 1e-9, kStep = 1e-6, kDifference = 1e-5;  ///< relative; radians; of the differences
  Rng rng(test::seed_of_this_test());
  for (int n = 0; n < 2000; ++n) {
    const double theta_o = uniform(rng) * 85 * kDegree;
    const Vec3 wo = spherical_direction(theta_o, 0), wi = test::uniform_hemisphere(rng);
    if (wi.z() < 0.01) continue;
    const Outgoing given(wo);
    const WiCoordinates at(given, wo, wi);
    const Vec3 half = (wi + wo).normalized();
    const std::complex<double> z(half.x() / half.z(), half.y() / half.z());
    const std::complex<double> m = z / (std::cos(theta_o) + std::sin(theta_o) * z);
    EXPECT_NEAR(at.disk2 / std::norm(m), 1, kRounding);
    EXPECT_NEAR(at.disk_azimuth, FoldedAzimuth::of(m.real(), m.imag(), std::abs(m)).s, kRounding);
    EXPECT_LT(at.disk2, 1);
    const double d = std::norm(1.0 - std::sin(theta_o) * m), c = std::cos(theta_o);
    EXPECT_NEAR(c * (1 - at.disk2) / (d + c * c * at.disk2) / wi.z(), 1, kRounding / wi.z());
    // Steps of wi in two directions, away from the kinks of the azimuths.
    if (std::abs(wi.y()) < 0.01 || std::abs(m.real()) < 0.01 || std::abs(wi.x()) < 0.01 || at.disk2 > 0.999) continue;
    const Vec3 first = wi.cross(Vec3::UnitZ()).normalized(), second = wi.cross(first);
    const auto moved = [&](const Vec3& by) { return WiCoordinates(given, wo, (wi + kStep * by).normalized()); };
    const WiCoordinates a = moved(first), b = moved(second), a2 = moved(-first), b2 = moved(-second);
    const auto determinant = [&](double WiCoordinates::*u, double WiCoordinates::*v) {
      return std::abs((a.*u - a2.*u) * (b.*v - b2.*v) - (a.*v - a2.*v) * (b.*u - b2.*u)) / (4 * kStep * kStep);
    };
    EXPECT_NEAR(determinant(&WiCoordinates::disk2, &WiCoordinates::disk_azimuth) / (2 * at.disk_measure), 1,
                kDifference / (1 - at.disk2));
    EXPECT_NEAR(determinant(&WiCoordinates::radius2, &WiCoordinates::azimuth) / (2 * at.measure), 1,
                kDifference / wi.z());
  }
}

TEST(HalfDisk, HorizonIsTheUnitCircle) {
  for (const double theta_o : {0.0, 30.0, 80.0, 89.9}) {
    const Vec3 wo = spherical_direction(theta_o * kDegree, 0);
    for (const double phi : {10.0, 100.0, 175.0, 300.0}) {
      const Vec3 wi = spherical_direction((90 - 1e-9) * kDegree, phi * kDegree);
      EXPECT_NEAR(WiCoordinates(Outgoing(wo), wo, wi).disk2, 1, 1e-6) << theta_o << " " << phi;
    }
  }
}

TEST(DiskWarp, IsInvertedAndDifferentiated) {
  constexpr double kRounding = 1e-10, kStep = 1e-6, kDifference = 1e-7;
  for (const double spread : {1e-4, 0.1, 1.0}) {
    const DiskWarp warp(spread);
    EXPECT_EQ(warp.of(0).coordinate, 0);
    EXPECT_NEAR(warp.of(1).coordinate, 1, kRounding);
    EXPECT_NEAR(warp.disk2(1, 1), 1, kRounding);
    for (const double coordinate : {0.01, 0.2, 0.5, 0.9, 0.999}) {
      const double disk2 = warp.disk2(3 * coordinate, 3), step = kStep * disk2;
      const DiskWarp::Place at = warp.of(disk2);
      EXPECT_NEAR(at.coordinate, coordinate, kRounding) << spread;
      const double slope = (warp.of(disk2 + step).coordinate - warp.of(disk2 - step).coordinate) / (2 * step);
      EXPECT_NEAR(slope / at.slope, 1, kDifference) << spread << " " << coordinate;
    }
  }
}

TEST(SamplingEfficiency, ComparesSamplers) {
  const auto rows = sampling_efficiency("glossy", kinds()[5].make());
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[0].sampler, "conditional");
  EXPECT_EQ(rows[1].sampler, "cosine");
  EXPECT_EQ(rows[2].sampler, "ggx");
  for (std::size_t i = 0; i < kEfficiencyAngles.size(); ++i) {
    EXPECT_LT(rows[0].deviation[i], rows[1].deviation[i]);
    EXPECT_LT(rows[2].deviation[i], rows[1].deviation[i]);
    for (const SamplerEfficiency& row : rows) EXPECT_GT(row.deviation[i], 0) << row.sampler;
  }
  const std::string csv = efficiency_csv(rows);
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "material,sampler,theta_5,theta_20,theta_45,theta_60,theta_75,theta_80");
  EXPECT_NE(efficiency_markdown(rows).find("| glossy | paper-eq24 |"), std::string::npos);
  EXPECT_THROW((void)sampling_efficiency("brushed", brushed_metal()), std::invalid_argument);
}

}  // namespace
}  // namespace sklar::brdf
