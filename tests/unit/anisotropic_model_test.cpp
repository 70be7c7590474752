#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "brdf/analytic/registry.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/data/isotropy.hpp"
#include "brdf/data/tabulate.hpp"
#include "brdf/model/anisotropic_fit.hpp"
#include "brdf/model/anisotropic_problem.hpp"
#include "brdf/model/model_binary.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/model/refined_fit.hpp"
#include "brdf/render/hemisphere.hpp"
#include "brdf/study/anisotropic_budget.hpp"
#include "brdf/study/energy.hpp"
#include "brdf/study/metrics.hpp"
#include "brdf/study/refined_budget.hpp"
#include "copula/error.hpp"
#include "copula/random.hpp"
#include "tests/support/gradient_check.hpp"
#include "tests/support/instruction_sets.hpp"

namespace sklar::brdf {
namespace {

constexpr AnisotropicGrid kGrid{.theta_h = 30, .phi_h = 36, .theta_d = 16, .phi_d = 12};

/// A surface turned about its normal.
class Turned final : public Brdf {
 public:
  Turned(BrdfPtr base, double angle) : base_(std::move(base)), cosine_(std::cos(angle)), sine_(std::sin(angle)) {}

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override { return base_->eval(turn(wo), turn(wi)); }
  [[nodiscard]] Traits traits() const override { return {.isotropic = false}; }
  [[nodiscard]] std::size_t bytes() const override { return base_->bytes(); }

 private:
  [[nodiscard]] Vec3 turn(const Vec3& w) const {
    return {cosine_ * w.x() + sine_ * w.y(), cosine_ * w.y() - sine_ * w.x(), w.z()};
  }
  BrdfPtr base_;
  double cosine_, sine_;
};

/// Ward's exponent around an axis off the normal, as gratings have it.
class Blazed final : public Brdf {
 public:
  static constexpr double kSlope = 0.15;

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override {
    if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
    const Vec3 sum = wi + wo;
    const double x = (sum.x() / sum.z() - kSlope) / 0.1, y = sum.y() / sum.z() / 0.3;
    return Rgb(0.03, 0.05, 0.08) + Rgb(2, 1.5, 1) * std::exp(-(x * x + y * y));
  }
  [[nodiscard]] Traits traits() const override { return {.isotropic = false}; }
  [[nodiscard]] std::size_t bytes() const override { return 0; }
};

AnisotropicTable table_of(const Brdf& brdf) {
  return tabulate_anisotropic(brdf, "test", Provenance::synthetic, kGrid);
}

const AnisotropicTable& brass() {
  static const AnisotropicTable kTable = table_of(*brushed_metal());
  return kTable;
}

AnisotropicStructure small(bool tilted = false) {
  AnisotropicStructure structure = anisotropic_ladder().front();
  structure.tilted = tilted;
  return structure;
}

AnisotropicFit quick_fit(const AnisotropicTable& table, AnisotropicFitOptions options = {}) {
  if (options.structure == AnisotropicStructure{}) options.structure = small();
  options.evaluations = 80;
  return fit_anisotropic(table, options);
}

Directions random_hemisphere(Eigen::Index count, std::uint64_t seed) {
  Rng rng(seed);
  Directions w(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double z = uniform(rng), phi = 2 * std::numbers::pi * uniform(rng), r = std::sqrt(1 - z * z);
    w.row(i) << r * std::cos(phi), r * std::sin(phi), z;
  }
  return w;
}

/// Azimuth in [0, pi) along which a lobe is narrowest.
double narrowest(const Metric& metric) {
  const double angle = std::atan2(2 * metric.xy, metric.xx - metric.yy) / 2;
  return angle < 0 ? angle + std::numbers::pi : angle;
}

TEST(AnisotropicMetric, GradientIsThatOfTheMatrix) {
  constexpr double kStep = 1e-5, kTolerance = 1e-8;
  const std::array<double, 5> by = {0.3, -0.7, 0.9, 0.2, -0.4};
  const auto value = [&](const std::array<double, 5>& x) {
    const Metric m = Metric::from(x.data(), true);
    return by[0] * m.xx + by[1] * m.xy + by[2] * m.yy + by[3] * m.x + by[4] * m.y;
  };
  for (const std::array<double, 5>& at : {std::array<double, 5>{0.2, 0.4, -0.6, 0.1, 0.2},
                                          {0, 0, 0, 0, 0},
                                          {1, 1e-3, 2e-3, 0, 0.3},
                                          {-1, -2, 0.5, 0, 0}}) {
    std::array<double, 5> gradient{};
    Metric::pull_back(at.data(), true, by, gradient.data());
    for (std::size_t i = 0; i < at.size(); ++i) {
      std::array<double, 5> up = at, down = at;
      up[i] += kStep;
      down[i] -= kStep;
      EXPECT_NEAR(gradient[i], (value(up) - value(down)) / (2 * kStep), kTolerance) << i;
    }
    const Metric m = Metric::from(at.data(), true);
    EXPECT_NEAR(m.xx * m.yy - m.xy * m.xy, std::exp(2 * at[0]), 1e-12 * std::exp(2 * at[0]));
  }
}

TEST(AnisotropicProblem, GradientIsThatOfTheObjective) {
  for (const bool tilted : {false, true}) {
    const AnisotropicProblem problem(small(tilted),
                                     anisotropic_cells(brass(), small(tilted), CellMeasure::per_cell, 24));
    test::expect_gradient_of_objective(problem, 7, 5, tilted ? "tilted" : "upright");  // the metric comes last
  }
}

TEST(AnisotropicModel, IsFarMoreExactThanTheIsotropicOne) {
  struct Case {
    const char* name;
    AnalyticValues values;
  };
  for (const Case& c : {Case{"ward", {0.1, 0.1, 0.1, 0.33, 0.33, 0.33, 0.05, 0.16}},
                        Case{"ggx_anisotropic", {0.04, 0.5, 1, 0.05, 0.25}}}) {
    const Turned turned(analytic::find(c.name).make_unchecked(c.values), 0.5);
    const AnisotropicTable table = table_of(turned);
    const AnisotropicFit fit = fit_anisotropic(table, {.structure = anisotropic_ladder()[1], .evaluations = 400});
    const RefinedFit isotropic =
        fit_refined(isotropic_mean(table), {.structure = structure_ladder()[1], .bits = 12, .evaluations = 200});
    EXPECT_LT(fit.brdf->bytes(), isotropic.brdf->bytes()) << c.name;
    EXPECT_LT(fit.objective, fit.start) << c.name;
    const CellErrors errors = cell_errors(table, *fit.brdf), round = cell_errors(table, *isotropic.brdf);
    EXPECT_LT(errors.log1p_mae.mean(), 0.0015) << c.name;
    EXPECT_LT(errors.logrel_mae.mean(), 0.015) << c.name;
    EXPECT_LT(30 * errors.log1p_mae.mean(), round.log1p_mae.mean()) << c.name;
  }
}

TEST(AnisotropicModel, FindsTheDirectionOfTheGrain) {
  constexpr double kTolerance = 0.01;  // radians
  for (const double angle : {0.3, 1.2, 2.5}) {
    const AnisotropicFit fit = quick_fit(table_of(Turned(brushed_metal(), angle)));
    EXPECT_NEAR(narrowest(fit.brdf->metric(0)), angle, kTolerance);
  }
}

TEST(AnisotropicModel, FindsLobesOffTheNormal) {
  const AnisotropicTable table = table_of(Blazed());
  EXPECT_FALSE(repeats_after_half_turn(table));
  EXPECT_TRUE(repeats_after_half_turn(brass()));
  const AnisotropicFit tilted = quick_fit(table, {.structure = small(true)}), straight = quick_fit(table);
  EXPECT_NEAR(tilted.brdf->metric(0).x, Blazed::kSlope, 0.02);
  EXPECT_NEAR(tilted.brdf->metric(0).y, 0, 0.02);
  EXPECT_LT(5 * cell_errors(table, *tilted.brdf).log1p_mae.mean(), cell_errors(table, *straight.brdf).log1p_mae.mean());
}

TEST(AnisotropicModel, IsReciprocalPositiveFiniteAndTheSameInABatchInEveryInstructionSet) {
  const AnisotropicFit fit = quick_fit(table_of(Blazed()), {.structure = small(true)});
  Directions wo = random_hemisphere(500, 4), wi = random_hemisphere(500, 5);
  wo.row(0) << 0, 0, 1;
  wi.row(0) << 0, 0, 1;
  wo.row(1) << std::sqrt(1 - 1e-12), 0, 1e-6;
  wi.row(1) << -std::sqrt(1 - 1e-12), 0, 1e-6;
  wo.row(2) << 0.6, 0, -0.8;
  wo.row(3) << 0, 1, 1e-200;
  wi.row(3) << 0, -1, 1e-200;
  wi.row(4) = wo.row(4);
  wo.row(5) << 0, -1, 1e-12;
  constexpr double kSinglePrecision = 1e-4;  // relative, between instruction sets
  const RgbRows widest = fit.brdf->eval(wo, wi);
  test::for_each_target([&] {
    const RgbRows forth = fit.brdf->eval(wo, wi), back = fit.brdf->eval(wi, wo);
    EXPECT_TRUE((forth == back).all());
    EXPECT_TRUE(forth.isFinite().all());
    EXPECT_TRUE((forth.row(2) == 0).all()) << "below the horizon";
    for (Eigen::Index i = 0; i < wo.rows(); ++i) {
      EXPECT_TRUE(i == 2 || forth.row(i).minCoeff() > 0) << i;
      const Rgb one = fit.brdf->eval(Vec3(wo.row(i)), Vec3(wi.row(i)));
      EXPECT_TRUE((one == forth.row(i).transpose()).all()) << i;
    }
    EXPECT_LT(((forth - widest).abs() / (widest + 1e-30)).maxCoeff(), kSinglePrecision);
  });
  EXPECT_FALSE(fit.brdf->traits().isotropic);
}

TEST(AnisotropicModel, CellsMayCountBySolidAngle) {
  const AnisotropicFit cells = quick_fit(brass());
  const AnisotropicFit angles = quick_fit(brass(), {.measure = CellMeasure::per_solid_angle});
  const Vec3 wo = Vec3(0.8, 0.1, 0.5).normalized(), wi = Vec3(0.1, 0.9, 0.6).normalized();  // theta_h = 56 degrees
  const Rgb f = brushed_metal()->eval(wo, wi);
  EXPECT_LT((angles.brdf->eval(wo, wi) / f - 1).abs().mean(), 0.05);
  EXPECT_NE(angles.objective, cells.objective);
}

TEST(AnisotropicModel, HasNoSeamsAtThePoles) {
  constexpr double kNear = 1e-5, kTolerance = 0.01;
  const AnisotropicFit fit = quick_fit(brass());
  const Vec3 wo = Vec3(0.3, 0.2, 0.9).normalized();
  for (const Vec3& centre : {Vec3(-wo.x(), -wo.y(), wo.z()), wo}) {  // theta_h = 0, and theta_d = 0
    const Rgb middle = fit.brdf->eval(wo, centre);
    for (int k = 0; k < 8; ++k) {
      const double phi = k * std::numbers::pi / 4;
      const Vec3 wi = (centre + kNear * Vec3(std::cos(phi), std::sin(phi), 0)).normalized();
      EXPECT_LT((fit.brdf->eval(wo, wi) / middle - 1).abs().maxCoeff(), kTolerance) << k;
    }
  }
}

TEST(AnisotropicModel, DoesNotDependOnTheNumberOfThreads) {
  const AnisotropicFit many = quick_fit(brass());
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(many.brdf->coefficients().levels, quick_fit(brass()).brdf->coefficients().levels);
}

TEST(AnisotropicModel, FitsDirtyData) {
  const auto fits = [](const char* what, auto&& damage) {
    AnisotropicTable table = brass();
    damage(table);
    const AnisotropicFit fit = quick_fit(table);
    const RgbRows values = fit.brdf->eval(random_hemisphere(200, 6), random_hemisphere(200, 7));
    EXPECT_TRUE(values.isFinite().all() && (values >= 0).all()) << what;
    return cell_errors(brass(), *fit.brdf).log1p_mae.mean();
  };
  const auto mask = [](AnisotropicTable& table, std::size_t cell) {
    table.valid[cell] = 0;
    for (auto& plane : table.values) plane[cell] = 0;
  };
  const double whole = fits("whole", [](AnisotropicTable&) {});
  Rng rng(8);
  EXPECT_LT(fits("half missing",
                 [&](auto& table) {
                   for (std::size_t n = 0; n < table.valid.size(); ++n) {
                     if (uniform(rng) < 0.5) mask(table, n);
                   }
                 }),
            2 * whole);
  EXPECT_LT(fits("an empty slice",
                 [&](auto& table) {
                   for (int row = 0; row < kGrid.theta_h * kGrid.phi_h; ++row) {
                     for (int k = 0; k < kGrid.phi_d; ++k) {
                       mask(table, kGrid.index(row / kGrid.phi_h, row % kGrid.phi_h, 7, k));
                     }
                   }
                 }),
            3 * whole);
  EXPECT_LT(fits("a spike", [](auto& table) { table.values[1][kGrid.index(10, 20, 5, 3)] = 1e6F; }), 3 * whole);
  fits("a black channel", [](auto& table) { std::fill(table.values[2].begin(), table.values[2].end(), 0.0F); });
  fits("all equal", [](auto& table) {
    for (auto& plane : table.values) {
      for (std::size_t n = 0; n < plane.size(); ++n) plane[n] = table.valid[n] != 0 ? 0.25F : 0.0F;
    }
  });
  fits("black", [](auto& table) {
    for (auto& plane : table.values) std::fill(plane.begin(), plane.end(), 0.0F);
  });
}

TEST(AnisotropicModel, FollowsTinyValues) {
  AnisotropicTable table = brass();
  for (auto& plane : table.values) {
    for (float& value : plane) value *= 1e-12F;
  }
  const Vec3 wo(0, 0.6, 0.8), wi(0.6, 0, 0.8);
  const Rgb ratio = quick_fit(table).brdf->eval(wo, wi) / quick_fit(brass()).brdf->eval(wo, wi);
  EXPECT_NEAR(ratio[1] * 1e12, 1, 0.1);
}

TEST(AnisotropicModel, SurvivesItsFileBitForBit) {
  const AnisotropicFit fit = quick_fit(table_of(Blazed()), {.structure = small(true)});
  const StoredBrdf stored{.material = "test", .provenance = Provenance::synthetic, .model = fit.brdf};
  const StoredBrdf read = parse_brdf(to_json(stored), "model.json");
  EXPECT_EQ(to_json(read), to_json(stored));
  EXPECT_EQ(read.brdf()->bytes(), fit.brdf->bytes());
  constexpr std::size_t kHeader = 9 + 3 + 4 + 4;  // magic, three bytes, the material
  EXPECT_EQ(to_binary(stored).size(), kHeader + fit.brdf->bytes());
  EXPECT_EQ(to_json(parse_binary(to_binary(stored), "model.sklar")), to_json(stored));
  const Directions wo = random_hemisphere(100, 9), wi = random_hemisphere(100, 10);
  EXPECT_TRUE((read.brdf()->eval(wo, wi) == fit.brdf->eval(wo, wi)).all());
  for (const auto& [from, to] : {std::pair("\"bits\":12", "\"bits\":11"),
                                 {"\"masking\":3", "\"masking\":2"},
                                 {"\"tilted\":true", "\"tilted\":1"},
                                 {"\"half\":10", "\"half\":2"}}) {
    std::string text = to_json(stored);
    text.replace(text.find(from), std::string(from).size(), to);
    EXPECT_THROW((void)parse_brdf(text, "model.json"), FileError) << to;
  }
}

/// The largest over some wo and the channels, by more nodes than limit_albedo takes.
double largest_albedo(const BrdfPtr& brdf) {
  double largest = 0;
  for (const double theta : {0.1, 0.8, 1.3, 1.5}) {
    const HemisphereNodes nodes = hemisphere_nodes(theta, {.polar = 96, .azimuth = 128});
    Directions wo(nodes.wi.rows(), 3);
    wo.rowwise() = Eigen::Array<double, 1, 3>(std::sin(theta), 0, std::cos(theta));
    for (const double angle : {0.0, 0.5, 1.1, 1.6, 2.6}) {
      const RgbRows f = Turned(brdf, angle).eval(wo, nodes.wi);
      largest = std::max(largest, (f.colwise() * nodes.weight).colwise().sum().maxCoeff());
    }
  }
  return largest;
}

TEST(AnisotropicModel, SendsBackNoMoreThanALimit) {
  const AnisotropicFit fit = quick_fit(brass());
  const double before = largest_albedo(fit.brdf), limit = 0.9 * before;
  EXPECT_EQ(limit_albedo(fit.brdf, 10 * before).brdf, fit.brdf);
  const Limited<AnisotropicModel> lower = limit_albedo(fit.brdf, limit);
  constexpr double kNodes = 1e-2;  // relative
  EXPECT_GT(lower.albedo_before, (1 - kNodes) * before);
  EXPECT_LE(lower.albedo_after, limit);
  EXPECT_GT(lower.albedo_after, 0.99 * limit);
  EXPECT_LE(largest_albedo(lower.brdf), (1 + kNodes) * limit);
  EXPECT_LT(lower.lowest_factor, 1);
  EXPECT_GT(lower.lowest_factor, 0.5);
  EXPECT_EQ(lower.brdf->bytes(), fit.brdf->bytes());
  EXPECT_THROW((void)limit_albedo(fit.brdf, -1), std::invalid_argument);
}

TEST(AnisotropicModel, RefusesBadArguments) {
  AnisotropicFitOptions options;
  options.structure.components = 9;
  EXPECT_THROW((void)fit_anisotropic(brass(), options), std::invalid_argument);
  EXPECT_THROW((void)fit_anisotropic(brass(), {.bits = 5}), std::invalid_argument);
  EXPECT_THROW((void)fit_anisotropic(brass(), {.evaluations = 0}), std::invalid_argument);
  EXPECT_THROW((void)fit_anisotropic(brass(), {.samples = 0}), std::invalid_argument);
  EXPECT_THROW((void)fit_anisotropic(AnisotropicTable{}), std::invalid_argument);
  EXPECT_THROW((void)AnisotropicModel(small(), {}), std::invalid_argument);
  PackedCoefficients steep = quick_fit(brass()).brdf->coefficients();
  steep.lowest[0] = 200;
  EXPECT_THROW((void)AnisotropicModel(small(), steep), std::domain_error);
  PackedCoefficients sharp = quick_fit(brass()).brdf->coefficients();
  sharp.lowest[static_cast<std::size_t>(AnisotropicPart::metric)] = 40;
  EXPECT_THROW((void)AnisotropicModel(small(), sharp), std::domain_error);
}

TEST(AnisotropicBudget, TakesTheSmallestModelThatIsGoodEnough) {
  const AnisotropicFitOptions options{.evaluations = 80};
  const AnisotropicChoice choice = choose_anisotropic(brass(), {.max_error = 0.01}, options);
  EXPECT_EQ(choice.chosen, choice.front.size() - 1);
  EXPECT_LE(choice.front[choice.chosen].figures.log1p_mae, 0.01);
  EXPECT_NE(to_markdown(choice).find("chosen"), std::string::npos);
  const AnisotropicChoice bytes = choose_anisotropic(brass(), {.max_bytes = 600}, options);
  EXPECT_LE(bytes.front[bytes.chosen].figures.bytes, 600U);
  EXPECT_THROW((void)choose_anisotropic(brass(), {.max_error = 1e-9, .max_bytes = 600}, options), std::runtime_error);
  EXPECT_THROW((void)choose_anisotropic(brass(), {.max_bytes = 10}, options), std::runtime_error);
  EXPECT_THROW((void)choose_anisotropic(brass(), {.max_bytes = -1}, options), std::invalid_argument);
}

}  // namespace
}  // namespace sklar::brdf
