#include "copula/inference/held_out.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "copula/inference/dependence.hpp"
#include "families/registry.hpp"

namespace sklar {
namespace {

TEST(HeldOut, LeavingOneOutIsThatOfTheOtherRows) {
  Rng rng(6);
  const Points x = families::find("clayton").make(2, {3.0})->sample(12, rng).log();
  const std::vector<const FamilyInfo*> families = {&families::find("independence"), &families::find("clayton")};
  const std::vector<MarginSpec> ranks(2), normals(2, {.kind = MarginKind::normal});
  const HeldOutOptions one_out{.folds = 12};
  const HeldOut by_ranks = held_out_likelihood(families, FitMethod::maximum_likelihood, ranks, x, Column(), one_out)[1];
  const HeldOut by_normals =
      held_out_likelihood(families, FitMethod::maximum_likelihood, normals, x, Column(), one_out)[0];
  Column of_ranks(12), of_normals = Column::Zero(12);
  for (Index i = 0; i < 12; ++i) {
    std::vector<Index> others;
    for (Index j = 0; j < 12; ++j) {
      if (j != i) others.push_back(j);
    }
    const Points rest = x(others, Eigen::all);
    Points u(1, 2);
    for (Index k = 0; k < 2; ++k) {
      u(0, k) = (static_cast<double>((rest.col(k) < x(i, k)).count()) + 0.5) / 12;
      const double mean = rest.col(k).mean();
      const double variance = (rest.col(k) - mean).square().mean();
      of_normals[i] -= 0.5 * (std::log(2 * M_PI * variance) + (x(i, k) - mean) * (x(i, k) - mean) / variance);
    }
    const FitResult fit = fit_maximum_likelihood(*families[1], pseudo_observations(rest));
    of_ranks[i] = families[1]->make(2, fit.theta)->log_pdf(u)(0);
  }
  const auto error = [](const Column& l) { return std::sqrt((l - l.mean()).square().sum() / 11 / 12); };
  EXPECT_NEAR(by_ranks.mean, of_ranks.mean(), 1e-12);
  EXPECT_NEAR(by_ranks.standard_error, error(of_ranks), 1e-12);
  EXPECT_NEAR(by_normals.mean, of_normals.mean(), 1e-12);
  EXPECT_NEAR(by_normals.standard_error, error(of_normals), 1e-12);
}

TEST(HeldOut, PrefersTheFamilyOfTheSample) {
  Rng rng(7);
  const Points u = families::find("clayton").make(2, {2.0})->sample(600, rng);
  const std::vector<const FamilyInfo*> families = {&families::find("gumbel"), &families::find("clayton"),
                                                   &families::find("independence")};
  const auto study = [&](const HeldOutOptions& options) {
    return held_out_likelihood(families, FitMethod::maximum_likelihood, {}, u, Column(), options);
  };
  for (const bool every_fold : {true, false}) {
    const std::vector<HeldOut> found = study({.every_fold = every_fold});
    EXPECT_GT(found[1].mean, found[0].mean);
    EXPECT_GT(found[0].mean, found[2].mean);
    EXPECT_EQ(found[2].mean, 0);
    EXPECT_EQ(study({.every_fold = every_fold})[1].mean, found[1].mean);
    EXPECT_NE(study({.every_fold = every_fold, .seed = 2})[1].mean, found[1].mean);
  }
  EXPECT_THROW((void)study({.folds = 1}), std::invalid_argument);
  EXPECT_THROW((void)study({.folds = 601}), std::invalid_argument);
}

TEST(HeldOut, AFamilyThatFailsSaysWhere) {
  Rng rng(8);
  const Points u = uniforms(rng, 40, 3);
  const std::vector<const FamilyInfo*> families = {&families::find("clayton")};
  const FamilyInfo turned = families::resolve("clayton@u1+u2");
  const std::vector<const FamilyInfo*> both = {&turned, families[0]};
  const std::vector<HeldOut> found = held_out_likelihood(both, FitMethod::tau_inversion, {}, u);
  EXPECT_TRUE(std::isnan(found[0].mean));
  EXPECT_EQ(found[0].message.substr(0, 8), "part 1: ");
  EXPECT_TRUE(std::isfinite(found[1].mean));
}

}  // namespace
}  // namespace sklar
