#include "brdf/analytic/analytic_fit.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/analytic/fit_cells.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/registry.hpp"
#include "brdf/analytic/search_space.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/data/tabulate.hpp"
#include "brdf/geometry/coordinates.hpp"
#include "tests/support/function_brdf.hpp"

namespace sklar::brdf {
namespace {

constexpr double kSharpest = 0.003;
constexpr AnalyticFitOptions kShort = {.shapes = 1, .evaluations = 10};

MeasuredTable table_of(const char* model, const AnalyticValues& values) {
  return tabulate(*analytic::find(model).make(values), model, Provenance::synthetic);
}

MeasuredTable empty_table() {
  MeasuredTable table = table_of("lambert", {0, 0, 0});
  std::ranges::fill(table.valid, 0);
  return table;
}

struct SelfFit {
  const char* model;
  AnalyticValues values;  // far from the defaults and the examples, from which searches start
};

class AnalyticSelfFit : public testing::TestWithParam<SelfFit> {};
INSTANTIATE_TEST_SUITE_P(All, AnalyticSelfFit,
                         testing::Values(SelfFit{"lambert", {0.03, 0.6, 0.25}},
                                         SelfFit{"ggx", {0.7, 0.15, 0.08, 0.055}},
                                         SelfFit{"ward", {0.05, 0.3, 0.15, 0.2, 0.1, 0.4, 0.26, 0.26}},
                                         SelfFit{"cook_torrance", {0.02, 0.1, 0.4, 0.3, 0.08, 0.15, 0.33}},
                                         SelfFit{"oren_nayar", {0.2, 0.4, 0.6, 0.5}}),
                         [](const auto& test) { return std::string(test.param.model); });

TEST_P(AnalyticSelfFit, FindsItsValuesAgain) {
  const SelfFit& c = GetParam();
  const AnalyticFit fit = fit_analytic(analytic::find(c.model), table_of(c.model, c.values), kShort);
  ASSERT_EQ(fit.values.size(), c.values.size());
  for (std::size_t n = 0; n < c.values.size(); ++n) EXPECT_NEAR(fit.values[n] / c.values[n], 1, 0.01) << n;
  EXPECT_EQ(fit.status, AnalyticFitStatus::converged);
  EXPECT_LT(fit.objective, 1e-4);
}

TEST(AnalyticFit, IsNoWorseThanItsStartsHoweverShort) {
  const MeasuredTable table = builtin_material();
  const BalancedError error(fit_cells(table));
  for (const char* name : {"phong", "ggx"}) {
    const AnalyticInfo& info = analytic::find(name);
    const AnalyticFit fit = fit_analytic(info, table, {.shapes = 1, .evaluations = 1});
    EXPECT_EQ(error(*fit.brdf, kSharpest).mean(), fit.objective);
    EXPECT_GT(fit.starts.size(), 1 + info.examples.size());
    for (const AnalyticStart& start : fit.starts) {
      EXPECT_EQ(error(*info.make(start.values), kSharpest).mean(), start.objective);
      EXPECT_LE(fit.objective, start.objective) << name;
    }
  }
}

TEST(AnalyticFit, TiesWhatAnisotropyTells) {
  const AnalyticFit fit =
      fit_analytic(analytic::find("ggx_anisotropic"), table_of("ggx", {0.1, 0.3, 0.5, 0.3}), kShort);
  EXPECT_TRUE(fit.brdf->traits().isotropic);
  EXPECT_EQ(fit.values[3], fit.values[4]);
  EXPECT_NEAR(fit.values[3], 0.3, 0.003);
}

TEST(AnalyticFit, LeavesAloneWhereAModelIsNotFinite) {
  AnalyticInfo info;
  info.name = "breaking";
  info.parameters = {{"albedo", {0, 1}, 0.9}, {"rough", {0, 1}, 0.9}};
  info.examples = {{0.5, 0.1}};
  info.make_unchecked = [](const AnalyticValues& v) {
    const double value = v[1] > 0.5 ? std::numeric_limits<double>::infinity() : v[0] * (1 + v[1]);
    return std::make_shared<const test::FunctionBrdf>([=](const Vec3&, const Vec3&) { return Rgb::Constant(value); });
  };
  const AnalyticFit fit = fit_analytic(info, table_of("lambert", {0.5, 0.5, 0.5}), kShort);
  EXPECT_LT(fit.objective, 1e-6);
  EXPECT_NEAR(fit.values[0] * (1 + fit.values[1]), 0.5 / std::numbers::pi, 1e-4);
  EXPECT_EQ(fit.starts.front().objective, std::numeric_limits<double>::max());
}

TEST(AnalyticFit, SaysThatATableIsBlack) {
  const AnalyticFit fit = fit_analytic(analytic::find("lambert"), table_of("lambert", {0, 0, 0}), kShort);
  EXPECT_EQ(fit.status, AnalyticFitStatus::black);
  EXPECT_LT(*std::ranges::max_element(fit.values), 1e-6);
}

TEST(AnalyticFit, SaysThatATableIsTooSmall) {
  MeasuredTable table = empty_table();
  const auto cell = static_cast<std::size_t>(Grid::index(3, 40, 20));
  table.valid[cell] = 1;
  for (auto& plane : table.values) plane[cell] = 0.25;
  const AnalyticFit fit = fit_analytic(analytic::find("ggx"), table, kShort);
  EXPECT_EQ(fit.status, AnalyticFitStatus::underdetermined) << "three numbers, four values";
  EXPECT_EQ(fit.cells, 1);
  EXPECT_LT(fit.objective, 1e-3);
  EXPECT_EQ(fit_analytic(analytic::find("lambert"), table, kShort).status, AnalyticFitStatus::converged);
}

TEST(AnalyticFit, RefusesWhatItCannotUse) {
  MeasuredTable table = empty_table();
  const AnalyticInfo& info = analytic::find("lambert");
  EXPECT_THROW((void)fit_analytic(info, table), std::invalid_argument) << "no valid cell";
  table.valid[static_cast<std::size_t>(Grid::index(89, 89, 90))] = 1;
  EXPECT_THROW((void)fit_analytic(info, table), std::invalid_argument) << "only a grazing one";
  table.valid[0] = 1;
  EXPECT_THROW((void)fit_analytic(info, table, {.shapes = -1}), std::invalid_argument);
  EXPECT_THROW((void)fit_analytic(info, table, {.evaluations = 0}), std::invalid_argument);
  EXPECT_EQ(fit_analytic(info, table).cells, 1);
}

TEST(AnalyticFit, IsTheSameOnAnyNumberOfThreads) {
  const MeasuredTable table = builtin_material();
  const auto fit = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return fit_analytic(analytic::find("ggx"), table, {.shapes = 1, .evaluations = 3});
  };
  const AnalyticFit one = fit(1);
  const AnalyticFit two = fit(2);
  EXPECT_EQ(one.values, two.values);
  EXPECT_EQ(one.objective, two.objective);
  EXPECT_EQ(one.evaluations, two.evaluations);
}

TEST(AnalyticFit, TellsItsProgressAndIsInterruptedByIt) {
  const MeasuredTable table = table_of("lambert", {0.1, 0.2, 0.3});
  double last = 0;
  (void)fit_analytic(analytic::find("lambert"), table, kShort, [&](double share) {
    EXPECT_GT(share, last);
    last = share;
  });
  EXPECT_EQ(last, 1);
  struct Stop {};
  EXPECT_THROW((void)fit_analytic(analytic::find("lambert"), table, kShort, [](double) { throw Stop(); }), Stop);
}

TEST(FitCells, StandForTheWholeTable) {
  const MeasuredTable table = builtin_material();
  const FitCells cells = fit_cells(table);
  EXPECT_NEAR(cells.weight.sum(), 1, 1e-12);
  EXPECT_LT(cells.in_table, table.valid_cells());
  EXPECT_GT(cells.in_table, table.valid_cells() * 9 / 10);
  EXPECT_LT(cells.size(), 8000);
  int of_first_row = 0;
  for (Eigen::Index n = 0; n < cells.size(); ++n) {
    const Vec3 wi = cells.wi.row(n).transpose();
    const Vec3 wo = cells.wo.row(n).transpose();
    of_first_row += std::abs(half_difference(wo, wi).theta_h - Grid::theta_h_centre(0)) < 1e-9 ? 1 : 0;
  }
  EXPECT_GE(of_first_row, 14 * Grid::phi_d / 2 / 18) << "the highlight is in it";
}

/// The formula of BalancedError over every cell of a table.
double error_of_all_cells(const MeasuredTable& table, const Brdf& model, double softness) {
  const auto soft = [](double x, double e) { return std::sqrt(x * x + e * e) - e; };
  double power = 0, sum = 0, square = 0, total = 0;
  for (int cell = 0; cell < Grid::cells; ++cell) {
    const int i = cell / Grid::phi_d / Grid::theta_d, j = cell / Grid::phi_d % Grid::theta_d, k = cell % Grid::phi_d;
    const DirectionPair pair = directions({Grid::theta_h_centre(i), Grid::theta_d_centre(j), Grid::phi_d_centre(k)});
    const double a = pair.wi.z(), b = pair.wo.z(), w = std::max(a * b, 1e-3);
    if (!table.valid[static_cast<std::size_t>(cell)] || std::min(a, b) < 0.02) continue;
    const double weight = std::min(a, b) < std::cos(80 * std::numbers::pi / 180) ? 0.1 : 1.0;
    const Rgb value = model.eval(pair.wo, pair.wi);
    for (std::size_t c = 0; c < 3; ++c) {
      const double f = table.values[c][static_cast<std::size_t>(cell)], g = value[static_cast<Eigen::Index>(c)];
      const double log1p = soft(std::log((1 + g * a) / (1 + f * a)), softness) / 2 +
                           soft(std::log((1 + g * b) / (1 + f * b)), softness) / 2;
      sum += weight * (4 * log1p + soft(std::log((g * w + 1e-3) / (f * w + 1e-3)), 4 * softness));
      square += weight * (a * a + b * b) * (f - g) * (f - g);
      power += weight * (a * a + b * b) * f * f;
      total += weight;
    }
  }
  return sum / total + 2 * square / power;
}

TEST(BalancedError, IsThatOfAllCellsToAFewPerCent) {
  const MeasuredTable table = builtin_material();
  const BalancedError error(fit_cells(table));
  for (const auto& [name, values] :
       {std::pair<const char*, AnalyticValues>{"lambert", {0.1, 0.2, 0.3}}, {"ggx", {0.1, 0.1, 0.2, 0.2}}}) {
    const BrdfPtr model = analytic::find(name).make(values);
    const double softness = 0.02;
    EXPECT_NEAR(error(*model, softness).mean() / error_of_all_cells(table, *model, softness), 1, 0.03) << name;
  }
}

TEST(BalancedError, SeesTinyValuesAsOrdinaryOnes) {
  MeasuredTable table = table_of("lambert", {0.4, 0.4, 0.4});
  for (auto& plane : table.values) {
    for (double& value : plane) value *= 1e-6;
  }
  const AnalyticFit fit = fit_analytic(analytic::find("lambert"), table, kShort);
  for (const double albedo : fit.values) EXPECT_NEAR(albedo / 4e-7, 1, 0.01);
}

TEST(SearchSpace, GoesThereAndBack) {
  for (const AnalyticInfo& info : analytic::all()) {
    const SearchSpace space(info);
    for (const AnalyticValues& example : info.examples) {
      const AnalyticValues expected = info.isotropic(example);
      const AnalyticValues found = space.values(space.coordinates(example));
      for (std::size_t n = 0; n < expected.size(); ++n) {
        EXPECT_NEAR(found[n], expected[n], 1e-13 * (1 + std::abs(expected[n]))) << info.name << " " << n;
      }
    }
    EXPECT_NO_THROW((void)info.make(space.values(space.box().lower))) << info.name;
    EXPECT_NO_THROW((void)info.make(space.values(space.box().upper))) << info.name;
  }
}

TEST(SearchSpace, StartsSpreadOverTheShapes) {
  const SearchSpace space(analytic::find("ggx_anisotropic"));
  ASSERT_EQ(space.size(), 4) << "the second roughness is tied";
  const AnalyticValues smooth = space.values(space.start({0}));
  const AnalyticValues rough = space.values(space.start({1}));
  EXPECT_NEAR(smooth[3], 0.2 / 30, 1e-9);
  EXPECT_EQ(smooth[4], smooth[3]);
  EXPECT_NEAR(rough[3], 1, 1e-9);
  EXPECT_NEAR(rough[0], 0.5, 1e-12);
}

}  // namespace
}  // namespace sklar::brdf
