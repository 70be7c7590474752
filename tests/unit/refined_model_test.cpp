#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "brdf/data/tabulate.hpp"
#include "brdf/model/model_binary.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/model/refined_fit.hpp"
#include "brdf/model/refined_problem.hpp"
#include "brdf/model/spline.hpp"
#include "brdf/render/hemisphere.hpp"
#include "brdf/study/albedo.hpp"
#include "brdf/study/energy.hpp"
#include "brdf/study/metrics.hpp"
#include "brdf/study/refined_budget.hpp"
#include "copula/error.hpp"
#include "copula/random.hpp"
#include "families/registry.hpp"
#include "tests/support/gradient_check.hpp"
#include "tests/support/instruction_sets.hpp"
#include "tests/support/refined_cases.hpp"

namespace sklar::brdf {
namespace {

using test::builtin_table;
using test::kSinglePrecision;
using test::small_structure;

RefinedFit quick_fit(const MeasuredTable& table, RefinedFitOptions options = {}) {
  options.structure = small_structure();
  options.evaluations = 40;
  return fit_refined(table, options);
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

double log1p_mae(const MeasuredTable& table, const Brdf& brdf) {
  return cell_errors(table, predict(brdf, table)).log1p_mae.mean();
}

TEST(Warp, IsReciprocalToTheBitAndInTheUnitCube) {
  const Directions wo = random_hemisphere(2000, 1), wi = random_hemisphere(2000, 2);
  for (Eigen::Index i = 0; i < wo.rows(); ++i) {
    const Warped a = warp(0.05, wo.row(i), wi.row(i)), b = warp(0.05, wi.row(i), wo.row(i));
    EXPECT_EQ(a.half, b.half);
    EXPECT_EQ(a.difference, b.difference);
    EXPECT_EQ(a.azimuth, b.azimuth);
    for (const double x : {a.half, a.difference, a.azimuth}) {
      EXPECT_GE(x, 0);
      EXPECT_LE(x, 1);
    }
  }
  const Warped normal = warp(0.05, Vec3(0, 0, 1), Vec3(0, 0, 1));
  EXPECT_EQ(normal.half, 0);
  EXPECT_EQ(normal.difference, 0);
  EXPECT_EQ(normal.azimuth, 0);
}

TEST(RefinedProblem, GradientIsThatOfTheObjective) {
  for (const char* name : {"independence", "frank", "clayton@180", "gumbel"}) {
    const FamilyInfo& family = families::resolve(name);
    const RefinedProblem problem(small_structure(), {family, family},
                                 refined_cells(builtin_table(), CellMeasure::per_cell, small_structure()));
    test::expect_gradient_of_objective(problem, 19, 0, name);
  }
}

TEST(RefinedModel, BeatsThePapersModelInATwentiethOfItsSize) {
  const RefinedFit fit = fit_refined(builtin_table(), {.structure = small_structure(), .evaluations = 200});
  EXPECT_LT(fit.objective, fit.start);
  EXPECT_LT(fit.brdf->bytes(), 1000U);
  EXPECT_LT(log1p_mae(builtin_table(), *fit.brdf), 0.007);  // the paper's, 20 KB: 0.0083
}

TEST(RefinedModel, IsReciprocalPositiveFiniteAndTheSameInABatchInEveryInstructionSet) {
  const RefinedFit fit = quick_fit(builtin_table(), {.families = {families::find("frank")}});
  const RefinedBrdf& brdf = *fit.brdf;
  Directions wo = random_hemisphere(500, 4), wi = random_hemisphere(500, 5);
  wo.row(0) << 0, 0, 1;
  wi.row(0) << 0, 0, 1;
  wo.row(1) << std::sqrt(1 - 1e-12), 0, 1e-6;
  wi.row(1) << -std::sqrt(1 - 1e-12), 0, 1e-6;
  wo.row(2) << 0.6, 0, -0.8;
  wo.row(3) = -wi.row(3);
  test::for_each_target([&] {
    const RgbRows forth = brdf.eval(wo, wi), back = brdf.eval(wi, wo);
    EXPECT_TRUE((forth == back).all());
    EXPECT_TRUE(forth.isFinite().all());
    EXPECT_TRUE((forth.middleRows(2, 2) == 0).all()) << "below the horizon";
    for (Eigen::Index i = 0; i < wo.rows(); ++i) {
      if (i == 2 || i == 3) {
        EXPECT_TRUE((brdf.eval(Vec3(wo.row(i)), Vec3(wi.row(i))) == 0).all());
        continue;
      }
      EXPECT_GT(forth.row(i).minCoeff(), 0);
      const Rgb one = brdf.eval(Vec3(wo.row(i)), Vec3(wi.row(i)));
      EXPECT_TRUE((one == forth.row(i).transpose()).all());
      const Rgb exact = brdf.at(coordinates(brdf.structure(), wo.row(i), wi.row(i)));
      EXPECT_LT(((one - exact) / exact).abs().maxCoeff(), kSinglePrecision) << i;
    }
  });
}

TEST(RefinedModel, DoesNotDependOnTheNumberOfThreads) {
  const RefinedFit many = quick_fit(builtin_table(), {.families = {families::find("frank")}});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const RefinedFit single = quick_fit(builtin_table(), {.families = {families::find("frank")}});
  EXPECT_EQ(many.brdf->coefficients().levels, single.brdf->coefficients().levels);
}

TEST(RefinedModel, CouplesByAnyFamilyThatTauDetermines) {
  for (const char* name : {"frank", "clayton", "gumbel@90", "joe", "amh"}) {
    const RefinedFit fit = quick_fit(builtin_table(), {.families = {families::resolve(name)}});
    for (int k = 0; k < 2; ++k) EXPECT_LE(std::abs(fit.brdf->tau(k, 0.5)), 0.81) << name;
    EXPECT_TRUE(std::isfinite(fit.objective)) << name;
  }
  const std::string bb1 = SKLAR_EXAMPLE_FAMILIES "/bb1.json";
  EXPECT_THROW((void)quick_fit(builtin_table(), {.families = {families::resolve(bb1)}}), std::invalid_argument);
}

TEST(RefinedModel, ChoosesTheFamilyOfAComponent) {
  RefinedStructure structure = small_structure();
  structure.components = 1;
  const RefinedFit margins = fit_refined(builtin_table(), {.structure = structure, .evaluations = 20});
  constexpr double kTau = 0.4;
  const auto coupled_by = [&](const char* name) {
    const FamilyInfo& family = families::find(name);
    RefinedFit fit = margins;
    fit.coefficients.insert(fit.coefficients.end(), static_cast<std::size_t>(structure.coupling_difference),
                            Coupling(family).dependence(kTau));
    const RefinedLayout layout(structure, {true});
    fit.brdf = std::make_shared<RefinedBrdf>(structure, std::vector{family}, pack(layout, 16, fit.coefficients));
    return fit;
  };
  const MeasuredTable table = tabulate(*coupled_by("gumbel").brdf, "gumbel", Provenance::synthetic);
  std::vector<FamilyInfo> candidates;
  for (const char* name : {"independence", "frank", "clayton", "gumbel", "gumbel@180", "joe"}) {
    candidates.push_back(families::find(name));
  }
  for (const char* name : {"frank", "clayton"}) {
    EXPECT_EQ(choose_families(table, {.structure = structure}, coupled_by(name), candidates)[0].name, "gumbel") << name;
  }
  const RefinedFitOptions options{.structure = structure, .families = {families::find("gumbel")}, .evaluations = 8};
  const RefinedFit fit = refit_refined(table, options, coupled_by("frank"));
  EXPECT_LT(log1p_mae(table, *fit.brdf), 0.1 * log1p_mae(table, *coupled_by("frank").brdf));
  EXPECT_NEAR(fit.brdf->tau(0, 0.5), kTau, 0.02);
  EXPECT_THROW((void)refit_refined(table, {.structure = small_structure()}, margins), std::invalid_argument);
  EXPECT_THROW((void)choose_families(table, {.structure = small_structure()}, margins, candidates),
               std::invalid_argument);
}

TEST(RefinedModel, FitsDirtyData) {
  const auto fits = [](const char* what, auto&& damage) {
    MeasuredTable table = builtin_table();
    damage(table);
    const RefinedFit fit = quick_fit(table);
    EXPECT_LT(fit.objective, fit.start) << what;
    const RgbRows values = fit.brdf->eval(random_hemisphere(200, 6), random_hemisphere(200, 7));
    EXPECT_TRUE(values.isFinite().all() && (values >= 0).all()) << what;
    return log1p_mae(builtin_table(), *fit.brdf);
  };
  const auto mask = [](MeasuredTable& table, auto&& masked) {
    for (int n = 0; n < Grid::cells; ++n) {
      const auto cell = static_cast<std::size_t>(n);
      if (!masked(n)) continue;
      table.valid[cell] = 0;
      for (auto& plane : table.values) plane[cell] = 0;
    }
  };
  const double whole = fits("whole", [](MeasuredTable&) {});
  Rng rng(8);
  EXPECT_LT(fits("half missing", [&](auto& table) { mask(table, [&](int) { return uniform(rng) < 0.5; }); }),
            2 * whole);
  EXPECT_LT(fits("an empty slice",
                 [&](auto& table) { mask(table, [](int n) { return n / Grid::phi_d % Grid::theta_d == 40; }); }),
            2 * whole);
  EXPECT_LT(
      fits("a spike", [](auto& table) { table.values[1][static_cast<std::size_t>(Grid::index(30, 20, 80))] = 1e6; }),
      2 * whole);
  fits("all equal", [](auto& table) {
    for (auto& plane : table.values) {
      for (std::size_t n = 0; n < plane.size(); ++n) plane[n] = table.valid[n] != 0 ? 0.25 : 0;
    }
  });
  fits("a black channel", [](auto& table) { std::fill(table.values[2].begin(), table.values[2].end(), 0.0); });
}

TEST(RefinedModel, FollowsTinyValues) {
  MeasuredTable table = builtin_table();
  for (auto& plane : table.values) {
    for (double& value : plane) value *= 1e-12;
  }
  const RefinedFit tiny = quick_fit(table);
  const Vec3 wo(0, 0.6, 0.8), wi(0.6, 0, 0.8);
  const Rgb ratio = tiny.brdf->eval(wo, wi) / quick_fit(builtin_table()).brdf->eval(wo, wi);
  EXPECT_NEAR(ratio[1] * 1e12, 1, 0.2);
}

TEST(RefinedModel, SurvivesItsFileBitForBit) {
  const RefinedFit fit = quick_fit(builtin_table(), {.families = {families::find("frank")}, .bits = 12});
  const StoredBrdf stored{.material = "synthetic", .provenance = Provenance::synthetic, .model = fit.brdf};
  const StoredBrdf read = parse_brdf(to_json(stored), "model.json");
  EXPECT_EQ(to_json(read), to_json(stored));
  const Directions wo = random_hemisphere(100, 9), wi = random_hemisphere(100, 10);
  EXPECT_TRUE((read.brdf()->eval(wo, wi) == fit.brdf->eval(wo, wi)).all());
  std::string text = to_json(stored);
  text.replace(text.find("\"bits\":12"), 9, "\"bits\":11");
  EXPECT_THROW((void)parse_brdf(text, "model.json"), FileError);
}

TEST(RefinedModel, SurvivesItsBinaryFileBitForBit) {
  for (const int bits : {6, 11, 16}) {
    const RefinedFit fit = quick_fit(
        builtin_table(), {.families = {families::find("frank"), families::find("independence")}, .bits = bits});
    const StoredBrdf stored{.material = "a \"name\"", .provenance = Provenance::measured, .model = fit.brdf};
    const std::string bytes = to_binary(stored);
    const std::string name = "a \"name\"", families = "frankindependence";
    constexpr std::size_t kHeader = 9 + 3 + 4 + 1 + 2 * 4;  // magic, three bytes, lengths of three texts, their number
    EXPECT_EQ(bytes.size(), kHeader + name.size() + families.size() + fit.brdf->bytes()) << bits;
    EXPECT_EQ(to_json(parse_binary(bytes, "model.sklar")), to_json(stored));
  }
}

TEST(RefinedModel, RefusesBrokenBinaryFiles) {
  const StoredBrdf stored{
      .material = "m", .provenance = Provenance::synthetic, .model = quick_fit(builtin_table()).brdf};
  const std::string bytes = to_binary(stored);
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 20) {
    EXPECT_THROW((void)parse_binary(bytes.substr(0, length), "model.sklar"), FileError) << length;
  }
  EXPECT_THROW((void)parse_binary(bytes + "x", "model.sklar"), FileError);
  Rng rng(11);
  for (int n = 0; n < 2000; ++n) {  // any byte may be wrong: it is refused, or what is read is a model
    std::string wrong = bytes;
    wrong[rng() % wrong.size()] = static_cast<char>(rng());
    try {
      const Rgb value = parse_binary(wrong, "model.sklar").brdf()->eval(Vec3(0, 0.6, 0.8), Vec3(0, 0, 1));
      EXPECT_TRUE(value.isFinite().all() && (value >= 0).all());
    } catch (const FileError&) {
    }
  }
}

TEST(RefinedModel, FewerBitsCostLittleError) {
  const double fine = log1p_mae(builtin_table(), *quick_fit(builtin_table(), {.bits = 16}).brdf);
  const RefinedFit coarse = quick_fit(builtin_table(), {.bits = 12});
  EXPECT_LT(log1p_mae(builtin_table(), *coarse.brdf), 1.1 * fine);
  EXPECT_LT(coarse.brdf->bytes(), 0.8 * static_cast<double>(quick_fit(builtin_table(), {.bits = 16}).brdf->bytes()));
}

TEST(RefinedModel, RefusesBadArguments) {
  RefinedFitOptions options;
  options.structure.components = 9;
  EXPECT_THROW((void)fit_refined(builtin_table(), options), std::invalid_argument);
  options.structure = {.width = 0};
  EXPECT_THROW((void)fit_refined(builtin_table(), options), std::invalid_argument);
  options = {.families = {families::find("frank"), families::find("frank")}};
  EXPECT_THROW((void)fit_refined(builtin_table(), options), std::invalid_argument);
  EXPECT_THROW((void)fit_refined(MeasuredTable{}), std::invalid_argument);
  EXPECT_THROW((void)RefinedBrdf(small_structure(), {}, {}), std::invalid_argument);
}

const BudgetSearch& quick_search() {
  static const BudgetSearch kSearch{.families = {families::find("independence"), families::find("frank")},
                                    .bits = {8, 12}};
  return kSearch;
}

TEST(Budget, TakesTheSmallestModelThatIsGoodEnough) {
  const RefinedFitOptions options{.evaluations = 40};
  constexpr double kEnough = 0.02;
  const BudgetChoice choice = choose_model(builtin_table(), {.max_error = kEnough}, quick_search(), options);
  EXPECT_LE(choice.front[choice.chosen].figures.log1p_mae, kEnough);
  for (std::size_t i = 0; i < choice.chosen; ++i) EXPECT_GT(choice.front[i].figures.log1p_mae, kEnough);
  EXPECT_NE(to_markdown(choice).find("chosen"), std::string::npos);
}

TEST(Budget, TakesTheMostExactModelThatIsSmallEnough) {
  constexpr double kMost = 800;
  const BudgetChoice choice =
      choose_model(builtin_table(), {.max_bytes = kMost}, quick_search(), RefinedFitOptions{.evaluations = 40});
  EXPECT_LE(static_cast<double>(choice.front[choice.chosen].figures.bytes), kMost);
  for (std::size_t i = 1; i < choice.front.size(); ++i) {
    EXPECT_GE(choice.front[i].figures.bytes, choice.front[i - 1].figures.bytes);
    EXPECT_LT(choice.front[i].figures.log1p_mae, choice.front[i - 1].figures.log1p_mae);
  }
  for (const FrontPoint& point : choice.front) {
    if (static_cast<double>(point.figures.bytes) > kMost) continue;
    EXPECT_GE(point.figures.log1p_mae, choice.front[choice.chosen].figures.log1p_mae);
    EXPECT_EQ(point.figures.bytes, point.fit.brdf->bytes());
    EXPECT_EQ(point.bits, point.fit.brdf->coefficients().bits);
  }
}

TEST(Budget, FitsOneStructureWithoutASearch) {
  const BudgetChoice choice = fit_largest(builtin_table(), 600, quick_search(), RefinedFitOptions{.evaluations = 8});
  ASSERT_EQ(choice.front.size(), 1U);
  EXPECT_EQ(choice.front[0].figures.bytes, stored_bytes(largest_structure(600, 8), 8, false));
}

TEST(Budget, SaysWhatIsTheBestWhereNoModelMeetsIt) {
  const RefinedFitOptions options{.evaluations = 8};
  const BudgetSearch search{.families = {families::find("independence")}, .bits = {12}};
  try {
    (void)choose_model(builtin_table(), {.max_error = 1e-9, .max_bytes = 600}, search, options);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no model meets the budget; the most exact one has"), std::string::npos);
  }
  EXPECT_THROW((void)choose_model(builtin_table(), {.max_bytes = 10}, search, options), std::runtime_error);
  EXPECT_THROW((void)choose_model(builtin_table(), {.max_bytes = -1}, search, options), std::invalid_argument);
}

TEST(Energy, LowersOnlyWhatSendsBackTooMuch) {
  const RefinedFit fit = quick_fit(builtin_table());
  const double largest = directional_albedo(*fit.brdf).albedo.maxCoeff();
  const Limited<RefinedBrdf> same = limit_albedo(fit.brdf, 1.01 * largest);
  EXPECT_EQ(same.brdf, fit.brdf);
  EXPECT_EQ(same.lowest_factor, 1);
  const double limit = 0.8 * largest;
  const Limited<RefinedBrdf> lower = limit_albedo(fit.brdf, limit);
  constexpr double kNodes = 5e-3;  // relative: other nodes, and angles to 89 instead of 89.5 degrees
  EXPECT_NEAR(lower.albedo_before, largest, kNodes * largest);
  EXPECT_LE(lower.albedo_after, limit);
  EXPECT_GT(lower.albedo_after, 0.99 * limit);
  EXPECT_LE(directional_albedo(*lower.brdf).albedo.maxCoeff(), (1 + kNodes) * limit);
  EXPECT_LT(lower.lowest_factor, 1);
  EXPECT_GT(lower.lowest_factor, 0.5);
  EXPECT_EQ(lower.brdf->bytes(), fit.brdf->bytes());
  EXPECT_THROW((void)limit_albedo(fit.brdf, 0), std::invalid_argument);
}

}  // namespace
}  // namespace sklar::brdf
