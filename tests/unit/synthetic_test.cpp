#include "brdf/analytic/synthetic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "brdf/analytic/ggx.hpp"
#include "brdf/data/table_brdf.hpp"
#include "brdf/data/tabulate.hpp"
#include "brdf/geometry/frame.hpp"
#include "copula/random.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Tabulate, HoldsTheModelAtTheCentres) {
  const Ggx model({0.04, 0.5, 1.0}, 0.3);
  const MeasuredTable table = tabulate(model, "gloss", Provenance::synthetic);
  EXPECT_NO_THROW(require_table("test", table));
  EXPECT_NEAR(1 - static_cast<double>(table.valid_cells()) / Grid::cells, 0.248, 0.0005);
  EXPECT_LT(table.report.mirror_asymmetry, 1e-14);
  const TableBrdf read(std::make_shared<const MeasuredTable>(table));
  Rng rng(3);
  for (int n = 0; n < 2000; ++n) {  // linear interpolation of a lobe of width 0.3 in steps of a degree
    const Vec3 wi = spherical_direction(uniform(rng), 2 * kPi * uniform(rng));
    const Vec3 wo = spherical_direction(uniform(rng), 2 * kPi * uniform(rng));
    EXPECT_TRUE((read.eval(wo, wi) / model.eval(wo, wi) - 1).abs().maxCoeff() < 2e-3);
  }
}

TEST(Synthetic, IsAPlausibleMeasurement) {
  const MeasuredTable table = builtin_material();
  EXPECT_EQ(table.name, "synthetic");
  EXPECT_EQ(table.provenance, Provenance::synthetic);
  EXPECT_NO_THROW(require_table("test", table));
  EXPECT_NEAR(1 - static_cast<double>(table.valid_cells()) / Grid::cells, 0.248, 0.0005);
  // Two values with independent scatter 0.02 differ by 0.02 sqrt(2) |z|, of which the channels are averaged: the median
  // lies between that of |z| (one channel counts) and its mean (many do).
  EXPECT_GT(table.report.mirror_asymmetry, 0.02 * std::sqrt(2.0) * 0.6745);
  EXPECT_LT(table.report.mirror_asymmetry, 0.02 * std::sqrt(2.0) * std::sqrt(2 / kPi));
  const MeasuredTable again = builtin_material();
  for (std::size_t channel = 0; channel < 3; ++channel) EXPECT_TRUE(table.values[channel] == again.values[channel]);

  const TableBrdf brdf(std::make_shared<const MeasuredTable>(table));
  for (const double theta : {5.0, 45.0, 75.0, 85.0}) {
    const Vec3 wo = spherical_direction(theta * kPi / 180, 0.5);
    constexpr int kSteps = 100;
    Rgb sum = Rgb::Zero();
    for (int k = 0; k < kSteps * kSteps; ++k) {
      const double cosine = std::sqrt((k / kSteps + 0.5) / kSteps);
      sum += brdf.eval(wo, spherical_direction(std::acos(cosine), 2 * kPi * (k % kSteps + 0.5) / kSteps));
    }
    const Rgb total = sum * kPi / (kSteps * kSteps);
    EXPECT_TRUE((total > 0.05).all() && (total < 1).all()) << theta << ": " << total.transpose();
  }
}

TEST(Synthetic, AnisotropicMaterialIsBrushedMetal) {
  const AnisotropicTable table = builtin_anisotropic_material();
  EXPECT_EQ(table.name, kAnisotropicSynthetic);
  EXPECT_EQ(table.provenance, Provenance::synthetic);
  EXPECT_NO_THROW(require_table("test", table));
  EXPECT_GT(table.report.isotropy_deviation, 0.5);
  EXPECT_TRUE(builtin_anisotropic_material().values[1] == table.values[1]);
  const BrdfPtr metal = brushed_metal();
  for (const auto& [theta, phi] : {std::pair(0.0, 0.0), {0.8, 0.3}, {1.3, 1.5}, {1.5, 0.0}}) {
    const Vec3 wo = spherical_direction(theta, phi);
    Rng rng(7);
    constexpr int kDraws = 20000;
    Rgb sum = Rgb::Zero();
    for (int n = 0; n < kDraws; ++n) {
      const double first = uniform(rng);
      sum += metal->sample(wo, {first, uniform(rng)}).weight;
    }
    EXPECT_TRUE((sum / kDraws < 1).all() && (sum / kDraws > 0.1).all()) << theta << ": " << sum.transpose() / kDraws;
  }
}

TEST(Synthetic, ScatterAndMaskAreAsAskedFor) {
  AnisotropicSynthetic options{.scatter = 0, .grid = {.theta_h = 20, .phi_h = 24, .theta_d = 10, .phi_d = 8}};
  const AnisotropicTable plain = builtin_anisotropic_material(options);
  options.scatter = 0.1;
  options.masked_share = 0.25;
  const AnisotropicTable rough = builtin_anisotropic_material(options);
  options.seed = 2;
  EXPECT_FALSE(builtin_anisotropic_material(options).values[0] == rough.values[0]);
  EXPECT_NEAR(static_cast<double>(rough.valid_cells()) / static_cast<double>(plain.valid_cells()), 0.75, 0.01);
  double square = 0;
  for (std::size_t cell = 0; cell < plain.valid.size(); ++cell) {
    if (!rough.valid[cell]) {
      ASSERT_EQ(rough.values[0][cell], 0);
      continue;
    }
    const double ratio =
        std::log(static_cast<double>(rough.values[0][cell]) / static_cast<double>(plain.values[0][cell]));
    square += ratio * ratio;
  }
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(rough.valid_cells())), 0.1, 0.003);
  options.masked_share = 1;
  EXPECT_THROW((void)builtin_anisotropic_material(options), std::domain_error);
}

}  // namespace
}  // namespace sklar::brdf
