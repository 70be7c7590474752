#include "brdf/sampling/paper_sampler.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <stdexcept>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/study/efficiency.hpp"
#include "families/registry.hpp"
#include "tests/support/sampler_check.hpp"

namespace sklar::brdf {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// The paper's sampler: draws by the closed-form inverses follow the density, in three coordinates (a quadratic) and in
// four (a quadratic, then a cubic).
TEST(PaperSampler, DrawsFollowTheDensity) {
  const auto material = std::make_shared<const Ggx>(Rgb(0.9, 0.6, 0.3), 0.5);
  const FamilyInfo& frank = families::find("frank");
  for (const PaperCoordinates coordinates : {PaperCoordinates::isotropic, PaperCoordinates::full}) {
    const PaperSampledBrdf brdf(material, frank, PaperTarget::reflected_light, coordinates);
    const auto tests = static_cast<int>(2 * test::sampled_directions().size());
    for (std::size_t i = 0; i < test::sampled_directions().size(); i += coordinates == PaperCoordinates::full ? 3 : 1) {
      test::check_sampler(brdf, test::sampled_directions()[i], test::seed_of_this_test(),
                          {.draws = test::sampler_draws() / 50,
                           .theta_cells = 9,
                           .phi_cells = 24,
                           .tests = tests,
                           .mass_tolerance = 2e-4});
    }
  }
}

// Eq. 24 with its K: where the reflectance is the density of the copula itself, f_r cos / pdf is K h cos sin.
TEST(PaperSampler, TheWeightIsThatOfEquation24) {
  constexpr double kRounding = 1e-11;  ///< relative, of logs up to 10 and a copula's density
  const auto material = std::make_shared<const Ggx>(Rgb(0.9, 0.6, 0.3), 0.5);
  Rng rng(test::seed_of_this_test());
  for (const PaperCoordinates coordinates : {PaperCoordinates::isotropic, PaperCoordinates::full}) {
    const PaperSampledBrdf brdf(material, families::find("frank"), PaperTarget::reflectance, coordinates);
    EXPECT_NE(brdf.theta()[0], 0);
    for (int n = 0; n < 1000; ++n) {
      const Vec3 wo = test::uniform_hemisphere(rng);
      const Vec3 wi = brdf.sample(wo, {uniform(rng), 0.5}).wi;
      EXPECT_NEAR(brdf.modelled(wo, wi) * wi.z() / brdf.pdf(wo, wi) / brdf.printed_weight(wo, wi), 1, kRounding);
    }
  }
}

TEST(PaperSampler, TheCosineInTheTargetLowersTheVariance) {
  const auto material = std::make_shared<const Lambert>(Rgb(0.2, 0.5, 0.8));
  const FamilyInfo& frank = families::find("frank");
  const PaperSampledBrdf printed(material, frank, PaperTarget::reflectance);
  const PaperSampledBrdf corrected(material, frank, PaperTarget::reflected_light);
  for (const double theta_o : {5, 45, 75}) {
    EXPECT_LT(weight_deviation(corrected, theta_o * kDegree), 0.1) << theta_o;
    EXPECT_GT(weight_deviation(printed, theta_o * kDegree), 0.3) << theta_o;
  }
}

TEST(PaperSampler, RefusesWhatItCannotSample) {
  const FamilyInfo& frank = families::find("frank");
  EXPECT_THROW(PaperSampledBrdf(nullptr, frank, PaperTarget::reflectance), std::invalid_argument);
  EXPECT_THROW(PaperSampledBrdf(brushed_metal(), frank, PaperTarget::reflectance), std::invalid_argument);
}

}  // namespace
}  // namespace sklar::brdf
