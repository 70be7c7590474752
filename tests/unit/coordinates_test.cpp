#include "brdf/geometry/coordinates.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "brdf/geometry/frame.hpp"
#include "copula/random.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-15;  // a few units in the last place of an angle of order 1

const double kThetaH[] = {0.0, 1e-12, 1e-8, 1e-4, 0.1, 0.7, 1.2, 1.5, kPi / 2 - 1e-6};
const double kThetaD[] = {1e-6, 1e-3, 0.1, 0.7, 1.2, 1.5, kPi / 2 - 1e-6};
const double kPhiD[] = {0.0, 1e-9, 0.3, kPi / 2, 2.0, 3.0, kPi - 1e-6};

TEST(Coordinates, RoundTripFromAngles) {
  for (const double theta_h : kThetaH) {
    for (const double theta_d : kThetaD) {
      for (const double phi_d : kPhiD) {
        const DirectionPair pair = directions({theta_h, theta_d, phi_d});
        const HalfDifference back = half_difference(pair.wo, pair.wi);
        const std::string at = "theta_h " + std::to_string(theta_h) + " theta_d " + std::to_string(theta_d) +
                               " phi_d " + std::to_string(phi_d);
        EXPECT_NEAR(back.theta_h, theta_h, kRounding / std::cos(theta_d)) << at;
        EXPECT_NEAR(back.theta_d, theta_d, kRounding) << at;
        // h is known to rounding / cos(theta_d), and where h = z its azimuth is not known at all.
        if (theta_h == 0 || theta_d > 1.5 || theta_h < 1e-4) continue;
        EXPECT_NEAR(std::sin(back.phi_d - phi_d), 0, 4 * kRounding / (std::sin(theta_d) * std::sin(theta_h))) << at;
      }
    }
  }
}

TEST(Coordinates, RoundTripFromDirections) {
  Rng rng(7);
  for (int n = 0; n < 100000; ++n) {
    const Vec3 wi = spherical_direction(std::acos(uniform(rng)), 2 * kPi * uniform(rng));
    const Vec3 wo = spherical_direction(std::acos(uniform(rng)), 2 * kPi * uniform(rng));
    const HalfDifference c = half_difference(wo, wi);
    ASSERT_TRUE(c.theta_h >= 0 && c.theta_h <= kPi / 2 && c.theta_d >= 0 && c.theta_d <= kPi / 2);
    ASSERT_TRUE(c.phi_d >= 0 && c.phi_d < kPi);
    const DirectionPair pair = directions(c);
    const double low = std::min(wi.z(), wo.z());
    const double high = std::max(wi.z(), wo.z());
    ASSERT_NEAR(std::min(pair.wi.z(), pair.wo.z()), low, 20 * kRounding);
    ASSERT_NEAR(std::max(pair.wi.z(), pair.wo.z()), high, 20 * kRounding);
    ASSERT_NEAR(pair.wi.dot(pair.wo), wi.dot(wo), 20 * kRounding);
  }
}

TEST(Coordinates, SymmetricToTheLastBit) {
  Rng rng(8);
  for (int n = 0; n < 100000; ++n) {
    const double squeeze = n % 3 == 0 ? 1e-7 : 1.0;  // near the normal as well
    const Vec3 wi = spherical_direction(squeeze * std::acos(uniform(rng)), 2 * kPi * uniform(rng));
    const Vec3 wo = n % 5 == 0 ? Vec3(-wi.x(), -wi.y(), wi.z())
                               : spherical_direction(squeeze * std::acos(uniform(rng)), 2 * kPi * uniform(rng));
    const HalfDifference a = half_difference(wo, wi);
    const HalfDifference b = half_difference(wi, wo);
    ASSERT_EQ(a.theta_h, b.theta_h);
    ASSERT_EQ(a.theta_d, b.theta_d);
    ASSERT_EQ(a.phi_d, b.phi_d);
  }
}

TEST(Coordinates, KnownPairs) {
  const Vec3 up = Vec3::UnitZ();
  const HalfDifference same = half_difference(up, up);
  EXPECT_EQ(same.theta_h, 0);
  EXPECT_EQ(same.theta_d, 0);
  EXPECT_EQ(same.phi_d, 0);

  const Vec3 slanted = spherical_direction(0.8, 0.4);
  const HalfDifference retro = half_difference(slanted, slanted);
  EXPECT_NEAR(retro.theta_h, 0.8, kRounding);
  EXPECT_EQ(retro.theta_d, 0);

  const HalfDifference mirror = half_difference(slanted, Vec3(-slanted.x(), -slanted.y(), slanted.z()));
  EXPECT_EQ(mirror.theta_h, 0);
  EXPECT_NEAR(mirror.theta_d, 0.8, kRounding);

  // In the plane of incidence phi_d is 0 (or pi, folded); with wi turned out of it by symmetry, pi/2.
  EXPECT_EQ(half_difference(spherical_direction(0.3, 0), spherical_direction(1.1, 0)).phi_d, 0);
  const HalfDifference across = half_difference(spherical_direction(0.6, 0.5), spherical_direction(0.6, -0.5));
  EXPECT_NEAR(across.phi_d, kPi / 2, kRounding);

  // A half vector 1e-9 off the normal keeps its digits; an acos of a dot product gives 0.
  const HalfDifference tiny = half_difference(spherical_direction(3e-9, 0), spherical_direction(1e-9, kPi));
  EXPECT_NEAR(tiny.theta_h / 1e-9, 1, 1e-12);
  EXPECT_NEAR(tiny.theta_d / 2e-9, 1, 1e-12);
}

TEST(Coordinates, FourOfThem) {
  Rng rng(9);
  for (int n = 0; n < 20000; ++n) {
    const HalfDifference4 c{1.5 * uniform(rng), 2 * kPi * uniform(rng), 1.5 * uniform(rng), kPi * uniform(rng)};
    const DirectionPair pair = directions4(c);
    const HalfDifference4 back = half_difference4(pair.wo, pair.wi);
    const double tolerance = 10 * kRounding / (std::cos(c.theta_d) * std::sin(c.theta_h) * std::sin(c.theta_d));
    ASSERT_NEAR(back.theta_h, c.theta_h, tolerance);
    ASSERT_NEAR(std::sin((back.phi_h - c.phi_h) / 2), 0, tolerance);
    ASSERT_NEAR(back.theta_d, c.theta_d, tolerance);
    ASSERT_NEAR(std::sin(back.phi_d - c.phi_d), 0, tolerance);
    ASSERT_TRUE(back.phi_h >= 0 && back.phi_h < 2 * kPi);
    const HalfDifference4 swapped = half_difference4(pair.wi, pair.wo);
    ASSERT_EQ(swapped.phi_h, back.phi_h);
    ASSERT_EQ(swapped.phi_d, back.phi_d);
  }
  EXPECT_EQ(half_difference4(Vec3::UnitZ(), Vec3::UnitZ()).phi_h, 0);
  EXPECT_NEAR(half_difference4(Vec3(0, -0.6, 0.8), Vec3(0, -0.6, 0.8)).phi_h, 1.5 * kPi, 4 * kRounding);
}

TEST(Frame, OrthonormalAndInverse) {
  for (const Vec3& normal : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0.6, -0.48, -0.64)}) {
    const Frame frame(normal);
    EXPECT_NEAR((frame.to_world(Vec3::UnitZ()) - normal).norm(), 0, kRounding);
    const Vec3 w(0.36, 0.48, -0.8);
    EXPECT_NEAR((frame.to_world(frame.to_local(w)) - w).norm(), 0, kRounding);
    const Vec3 x = frame.to_world(Vec3::UnitX());
    EXPECT_NEAR((x.cross(frame.to_world(Vec3::UnitY())) - normal).norm(), 0, kRounding);
  }
}

}  // namespace
}  // namespace sklar::brdf
