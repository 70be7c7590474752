/// Rotated families as values: names, dimensions and dependence.

#include "copula/rotated_family.hpp"

#include <gtest/gtest.h>

#include "copula/inference/dependence.hpp"
#include "copula/rotated.hpp"
#include "tests/support/chi_square.hpp"
#include "tests/support/family_cases.hpp"

namespace sklar {
namespace {

FamilyInfo rotated(const std::string& family, const std::string& rotation) {
  return rotated_family(families::find(family), Rotation(rotation));
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Rotation, ReflectsWhatItsNameSays) {
  using Coordinates = std::vector<bool>;
  EXPECT_EQ(Rotation("180").in(3), (Coordinates{true, true, true}));
  EXPECT_EQ(Rotation("90").in(2), (Coordinates{true, false}));
  EXPECT_EQ(Rotation("270").in(2), (Coordinates{false, true}));
  EXPECT_EQ(Rotation("u2").in(3), (Coordinates{false, true, false}));
  EXPECT_EQ(Rotation("u4+u1").in(5), (Coordinates{true, false, false, true, false}));
  EXPECT_EQ(Rotation("u4+u1").name(), "u1+u4");
  EXPECT_EQ(Rotation().in(2), (Coordinates{false, false}));
  for (const std::string name : {"", "45", "0", "360", "u", "u0", "1", "u1+", "+u1", "u1+u1", "u1,u2", "u-1", "u1.5",
                                 "u99999999999", "180 ", "U1", "clayton"}) {
    const std::string message = error_of([&] { (void)Rotation(name); });
    EXPECT_NE(message.find("'@" + name + "'; allowed: @180, "), std::string::npos) << message;
  }
}

TEST(RotatedFamily, IsTheRotatedCopula) {
  Rng rng(test::seed_of_this_test());
  for (const test::FamilyCase& next : test::family_cases_near(0.4, {2, 3, 5})) {
    SCOPED_TRACE(next.name());
    const Points u = uniforms(rng, 20, next.dim);
    for (const std::string name : {"90", "180", "270", "u1+u3"}) {
      const Rotation rotation(name);
      if (!rotation.dimensions().contains(next.dim)) continue;
      const FamilyInfo family = rotated_family(*next.family, rotation);
      EXPECT_EQ(family.name, next.family->name + "@" + name);
      const Column log_pdf = family.make(next.dim, next.theta)->log_pdf(u);
      EXPECT_TRUE((log_pdf == Rotated(next.copula(), rotation.in(next.dim)).log_pdf(u)).all());
    }
  }
}

TEST(RotatedFamily, HasTheTauOfItsSamples) {
  constexpr Index kDraws = 10000;
  Rng rng(test::seed_of_this_test());
  for (const test::FamilyCase& next : test::family_cases_near(0.4, {2})) {
    for (const std::string name : {"90", "180", "270"}) {
      const FamilyInfo family = rotated(next.family->name, name);
      SCOPED_TRACE(family.name);
      const double tau = family.tau(next.theta);
      EXPECT_EQ(tau, name == "180" ? next.tau() : 0 - next.tau());
      const Points u = family.make(2, next.theta)->sample(kDraws, rng);
      const double error = std::sqrt(2 * (1 - tau * tau) / static_cast<double>(kDraws));
      EXPECT_NEAR(kendall_tau(u.col(0), u.col(1)), tau, 4 * error);
      if (family.theta_from_tau) {
        EXPECT_NEAR(family.tau(family.from_tau(2, tau)), tau, 1e-12);
        EXPECT_EQ(family.tau_range(2).contains(-0.6),
                  name != "180" ? next.family->tau_range(2).contains(0.6) : next.family->tau_range(2).contains(-0.6));
      }
    }
  }
}

// C(t, t) / t and the same of the survival copula, near the corners.
TEST(RotatedFamily, HasTheTailsOfItsCdf) {
  constexpr double kNear = 1e-200, kTolerance = 1e-6;
  const Points corner = Points::Constant(1, 2, kNear);
  for (const test::FamilyCase& next : test::family_cases({2})) {
    if (std::abs(next.tau()) > 0.9) continue;  // Gumbel's C(t, t) / t falls as a power of 1.4 / theta
    for (const std::string name : {"90", "180", "270"}) {
      const FamilyInfo family = rotated(next.family->name, name);
      SCOPED_TRACE(next.name() + "@" + name);
      const CopulaPtr copula = family.make(2, next.theta);
      const TailDependence tails = family.tails(next.theta);
      EXPECT_NEAR(copula->cdf(corner)(0) / kNear, tails.lower, kTolerance);
      EXPECT_NEAR(survival_copula(copula)->cdf(corner)(0) / kNear, tails.upper, kTolerance);
    }
  }
  EXPECT_EQ(rotated("clayton", "90").tails({-1}).lower, 1);  // the comonotone limit
  EXPECT_EQ(rotated("clayton", "90").tau({-1}), 1);
}

TEST(RotatedFamily, OfAListHasNoTauOfEveryPair) {
  const FamilyInfo family = rotated("gumbel", "u1+u3");
  EXPECT_TRUE(std::isnan(family.tau({2.0})) && std::isnan(family.tails({2.0}).lower));
  EXPECT_EQ(error_of([&] { (void)family.from_tau(3, 0.5); }),
            "gumbel@u1+u3: has no inverse of Kendall's tau; give theta");
}

TEST(RotatedFamily, SaysWhatIsWrong) {
  EXPECT_EQ(error_of([] { (void)rotated("clayton", "90").make(3, {2}); }), "clayton@90: dimension must be 2, got 3");
  EXPECT_EQ(error_of([] { (void)rotated("clayton", "90").make(1, {2}); }), "clayton@90: dimension must be 2, got 1");
  EXPECT_EQ(error_of([] { (void)rotated("clayton", "u2+u5").make(4, {2}); }),
            "clayton@u2+u5: dimension must be 5 or more, got 4");
  EXPECT_EQ(error_of([] { (void)rotated("clayton", "180").make(3, {-0.6}); }),
            "clayton@180: theta must be in [-0.5, inf) in dimension 3, got -0.6");
  EXPECT_EQ(error_of([] { (void)rotated_family(rotated("clayton", "90"), Rotation("180")); }),
            "'clayton@90@180': clayton@90 is rotated already");
  FamilyInfo pairs = families::find("clayton");
  pairs.dimensions = {2, 2};
  EXPECT_EQ(error_of([&] { (void)rotated_family(pairs, Rotation("u1")); }),
            "@u1 is for dimension 3 or more, clayton has dimension 2");
}

}  // namespace
}  // namespace sklar
