/// What every registered basis model must do, fitted to the built-in material. Each test is a process of its own, so a
/// model is fitted in as few of them as its claims allow.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/sum.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/basis/registry.hpp"
#include "brdf/data/tabulate.hpp"
#include "brdf/geometry/coordinates.hpp"
#include "tests/support/function_brdf.hpp"
#include "tests/support/message.hpp"
#include "tests/support/sampler_check.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSmall = 1500, kLarge = 4500;  // bytes
constexpr double kWorst = 0.45;                 // error of any model, of that of a black one

using TablePtr = std::shared_ptr<const MeasuredTable>;

/// Materials of the kind of the built-in one, for models that learn.
std::span<const TablePtr> others() {
  static const auto list = [] {
    std::vector<TablePtr> tables;
    const Ggx smooth(Rgb::Constant(0.05), 0.15), rough(Rgb::Constant(0.04), 0.4);
    for (const auto& [albedo, alpha] : {std::pair(Rgb(0.3, 0.2, 0.1), 0.2), {Rgb(0.02, 0.05, 0.5), 0.35}}) {
      const Sum sum(std::make_shared<const Lambert>(albedo), std::make_shared<const Ggx>(Rgb::Constant(0.05), alpha),
                    0.5);
      tables.push_back(std::make_shared<const MeasuredTable>(
          tabulate(sum, "other " + std::to_string(tables.size()), Provenance::synthetic)));
    }
    return tables;
  }();
  return list;
}

BrdfPtr fit(const BasisInfo& info, const MeasuredTable& table, double max_bytes) {
  return info.fit({.table = table, .others = info.learns_from > 0 ? others() : std::span<const TablePtr>()}, max_bytes);
}

/// Mean over some thousand valid cells with both angles at most 80 degrees, and channels, of |ln(1 + f c) - ln(1 + g
/// c)|; a negative g counts as 0.
double log_error(const Brdf& model, const MeasuredTable& table) {
  double sum = 0;
  int count = 0;
  for (int cell = 0; cell < Grid::cells; cell += 97) {
    const int k = cell % Grid::phi_d, j = cell / Grid::phi_d % Grid::theta_d, i = cell / (Grid::phi_d * Grid::theta_d);
    const auto n = static_cast<std::size_t>(cell);
    const DirectionPair pair = directions({Grid::theta_h_centre(i), Grid::theta_d_centre(j), Grid::phi_d_centre(k)});
    if (!table.valid[n] || std::min(pair.wi.z(), pair.wo.z()) < std::cos(80 * kPi / 180)) continue;
    const Rgb g = model.eval(pair.wo, pair.wi).max(0.0) * pair.wi.z();
    const Rgb f = Rgb(table.values[0][n], table.values[1][n], table.values[2][n]) * pair.wi.z();
    sum += (f.log1p() - g.log1p()).abs().mean();
    ++count;
  }
  return sum / count;
}

/// Uniform over the hemisphere, every third one close to the horizon, every fifth one close to the normal.
Vec3 direction(Rng& rng, int n) {
  const Vec3 w = test::uniform_hemisphere(rng);
  const double z = n % 3 == 0 ? w.z() * 1e-9 : n % 5 == 0 ? 1 - 1e-9 * w.z() : w.z();
  const Vec2 across = Vec2(w.x(), w.y()).normalized() * std::sqrt((1 - z) * (1 + z));
  return {across.x(), across.y(), z};
}

/// @param reciprocal_by_chance a model not reciprocal may be so here.
void expect_sound(const Brdf& model, bool reciprocal_by_chance = false) {
  const Traits traits = model.traits();
  Rng rng(test::seed_of_this_test());
  bool reciprocal = true, non_negative = true;
  for (int n = 0; n < 3000; ++n) {
    const Vec3 wi = n % 11 == 0 ? Vec3(0, 0, 1) : direction(rng, n);
    const Vec3 wo = n % 7 == 0 ? Vec3(-wi.x(), -wi.y(), wi.z()) : direction(rng, n / 3);
    const Vec3 below(wi.x(), wi.y(), -std::abs(wi.z()));
    const Rgb value = model.eval(wo, wi);
    ASSERT_TRUE(value.isFinite().all()) << wo.transpose() << " | " << wi.transpose();
    reciprocal = reciprocal && (value == model.eval(wi, wo)).all();
    non_negative = non_negative && (value >= 0).all();
    ASSERT_TRUE((model.eval(wo, below) == 0).all() && (model.eval(below, wo) == 0).all());
    const double density = model.pdf(wo, wi);
    ASSERT_TRUE(density >= 0 && std::isfinite(density)) << wo.transpose() << " | " << wi.transpose();
    ASSERT_EQ(model.pdf(wo, below), 0);
    const double first = uniform(rng);
    const Sample draw = model.sample(wo, {first, uniform(rng)});
    ASSERT_TRUE(draw.wi.allFinite() && draw.weight.isFinite().all()) << wo.transpose();
  }
  if (traits.reciprocal || !reciprocal_by_chance) {
    EXPECT_EQ(reciprocal, traits.reciprocal);
  }
  if (traits.non_negative) {
    EXPECT_TRUE(non_negative);
  }
}

void expect_isotropic(const Brdf& model) {
  constexpr double kTurned = 1e-6;  // relative: rounding times the slope of an interpolated lobe
  ASSERT_TRUE(model.traits().isotropic);
  Rng rng(test::seed_of_this_test());
  for (int n = 0; n < 1000; ++n) {
    const Vec3 wi = test::uniform_hemisphere(rng), wo = test::uniform_hemisphere(rng);
    const Eigen::AngleAxisd turn(2 * kPi * uniform(rng), Vec3::UnitZ());
    const Rgb here = model.eval(wo, wi), there = model.eval(turn * wo, turn * wi);
    ASSERT_TRUE(((here - there).abs() <= kTurned * (here.abs() + 1e-3)).all()) << here.transpose() << there.transpose();
  }
}

void expect_batch_as_single(const Brdf& model) {
  Rng rng(test::seed_of_this_test());
  Directions wo(64, 3), wi(64, 3);
  for (int n = 0; n < 64; ++n) {
    wo.row(n) = test::uniform_hemisphere(rng).transpose().array();
    wi.row(n) = test::uniform_hemisphere(rng).transpose().array();
  }
  const RgbRows batch = model.eval(wo, wi);
  for (int n = 0; n < 64; ++n) {
    const Rgb single = model.eval(Vec3(wo.row(n).transpose()), Vec3(wi.row(n).transpose()));
    ASSERT_TRUE((batch.row(n).transpose() == single).all());
  }
}

std::vector<const BasisInfo*> models() {
  std::vector<const BasisInfo*> list;
  for (const BasisInfo& info : basis::all()) list.push_back(&info);
  return list;
}

class BasisModel : public testing::TestWithParam<const BasisInfo*> {};
INSTANTIATE_TEST_SUITE_P(All, BasisModel, testing::ValuesIn(models()),
                         [](const auto& test) { return test.param->name; });

TEST_P(BasisModel, KeepsItsBudgetAndItsClaims) {
  const BasisInfo& info = *GetParam();
  EXPECT_EQ(&basis::find(info.name), &info);
  EXPECT_FALSE(info.title.empty() || info.source.empty());
  const MeasuredTable table = builtin_material();
  const double black =
      log_error(test::FunctionBrdf([](const Vec3&, const Vec3&) -> Rgb { return Rgb::Zero(); }), table);
  double previous = kWorst * black;
  for (const double budget : {kSmall, kLarge}) {
    SCOPED_TRACE(budget);
    std::string message;
    const BasisData data{.table = table,
                         .others = info.learns_from > 0 ? others() : std::span<const TablePtr>(),
                         .on_message = [&](std::string_view text) { message = text; }};
    const BrdfPtr model = info.fit(data, budget);
    EXPECT_GT(model->bytes(), 0);
    EXPECT_EQ(static_cast<double>(model->bytes()) > budget, !message.empty()) << message;
    EXPECT_TRUE(message.empty() || info.name == "table") << message;
    const double error = log_error(*model, table);
    EXPECT_LE(error, previous * 1.05);  // the measure is not the one that the fit lessens
    previous = error;
    expect_sound(*model);
    expect_isotropic(*model);
    expect_batch_as_single(*model);
  }
}

TEST_P(BasisModel, SamplerFollowsItsDensity) {
  const BrdfPtr model = fit(*GetParam(), builtin_material(), kSmall);
  for (const int theta : {0, 40, 80}) {
    const double radians = theta * kPi / 180;
    const test::SamplerCheck options{.draws = std::min(test::sampler_draws(), 20000),
                                     .theta_cells = 12,
                                     .phi_cells = 24,
                                     .tests = 3 * static_cast<int>(models().size()),
                                     .mass_tolerance = 3e-4};
    test::check_sampler(*model, {std::sin(radians), 0, std::cos(radians)}, test::seed_of_this_test(), options);
  }
}

TEST_P(BasisModel, FitsABlackTable) {
  MeasuredTable table = builtin_material();
  table.name = "black";
  for (auto& plane : table.values) std::fill(plane.begin(), plane.end(), 0.0);
  const BrdfPtr model = fit(*GetParam(), table, kSmall);
  EXPECT_LT(log_error(*model, table), 2e-3);  // what learns from others has no black one
  expect_sound(*model, true);
}

/// Every second cell masked, and all of a lump of them; what they hold must not matter.
TEST_P(BasisModel, TakesNoNoticeOfMaskedCells) {
  const MeasuredTable whole = builtin_material();
  MeasuredTable table = whole;
  for (int cell = 0; cell < Grid::cells; ++cell) {
    const int k = cell % Grid::phi_d, j = cell / Grid::phi_d % Grid::theta_d, i = cell / (Grid::phi_d * Grid::theta_d);
    const bool lump = i >= 40 && i < 46 && j >= 20 && j < 30;
    if ((i + j + k) % 2 == 0 || lump) table.valid[static_cast<std::size_t>(cell)] = 0;
  }
  for (auto& plane : table.values) {
    for (std::size_t n = 0; n < plane.size(); ++n) plane[n] = table.valid[n] ? plane[n] : 0;
  }
  const BrdfPtr model = fit(*GetParam(), table, kSmall);
  // The measured table reads masked cells as 0 by its definition (docs/conventions.md).
  const MeasuredTable& judge = GetParam()->name == "table" ? table : whole;
  EXPECT_LT(log_error(*model, judge), 1.2 * log_error(*fit(*GetParam(), whole, kSmall), whole) + 1e-3);
  expect_sound(*model);
}

TEST_P(BasisModel, FitsLittleAndRefusesLess) {
  const BasisInfo& info = *GetParam();
  const MeasuredTable table = builtin_material();
  EXPECT_THROW((void)fit(info, table, 0), std::invalid_argument);
  EXPECT_THROW((void)fit(info, table, std::nan("")), std::invalid_argument);
  if (info.name != "table") {
    const std::string message = test::message_of<std::invalid_argument>([&] { (void)fit(info, table, 8); });
    EXPECT_NE(message.find(info.name), std::string::npos) << message;
    EXPECT_NE(message.find("budget is 8"), std::string::npos) << message;
    const BrdfPtr least = fit(info, table, 150);
    EXPECT_LE(least->bytes(), 150U);
    expect_sound(*least);
  }
  MeasuredTable bad = table;
  std::fill(bad.valid.begin(), bad.valid.end(), std::uint8_t{0});
  EXPECT_THROW((void)fit(info, bad, kSmall), std::invalid_argument);
  if (info.learns_from == 0) return;
  EXPECT_THROW((void)info.fit({.table = table}, kSmall), std::invalid_argument);
  const std::vector<TablePtr> itself = {others()[0], std::make_shared<const MeasuredTable>(table)};
  EXPECT_THROW((void)info.fit({.table = table, .others = itself}, kSmall), std::invalid_argument);
}

TEST(BasisRegistry, UnknownNameListsTheKnownOnes) {
  const std::string message = test::message_of<std::invalid_argument>([] { (void)basis::find("shiny"); });
  EXPECT_NE(message.find("'shiny'"), std::string::npos) << message;
  for (const BasisInfo& info : basis::all()) EXPECT_NE(message.find(info.name), std::string::npos) << message;
}

}  // namespace
}  // namespace sklar::brdf
