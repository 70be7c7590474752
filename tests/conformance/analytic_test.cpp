/// What every registered reflectance model must do, on each of its examples and at the corners of its bounds.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>
#include <string_view>

#include "brdf/analytic/not_computable.hpp"
#include "brdf/analytic/registry.hpp"
#include "brdf/geometry/frame.hpp"
#include "tests/support/sampler_check.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTurned = 1e-7;  // relative change when both directions turn: rounding times the slope of a lobe

struct Case {
  const AnalyticInfo* info;
  std::size_t example;

  [[nodiscard]] BrdfPtr make() const { return info->make(info->examples[example]); }
};

std::vector<Case> cases() {
  std::vector<Case> list;
  for (const AnalyticInfo& info : analytic::all()) {
    for (std::size_t n = 0; n < info.examples.size(); ++n) list.push_back({&info, n});
  }
  return list;
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return info.param.info->name + "_" + std::to_string(info.param.example);
}

const std::vector<Vec3>& given_directions() {
  static const auto list = [] {
    std::vector<Vec3> result;
    for (const auto& [theta, phi] : {std::pair(0, 0), {5, 30}, {45, 30}, {45, 100}, {75, 170}, {89, 30}}) {
      result.push_back(spherical_direction(theta * kPi / 180, phi * kPi / 180));
    }
    return result;
  }();
  return list;
}

class AnalyticModel : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(All, AnalyticModel, testing::ValuesIn(cases()), name_of);

/// Uniform over the hemisphere, every third one close to the horizon, every fifth one close to the normal.
Vec3 direction(Rng& rng, int n) {
  const Vec3 w = test::uniform_hemisphere(rng);
  const double z = n % 3 == 0 ? w.z() * 1e-9 : n % 5 == 0 ? 1 - 1e-9 * w.z() : w.z();
  const Vec2 across = Vec2(w.x(), w.y()).normalized() * std::sqrt((1 - z) * (1 + z));
  return {across.x(), across.y(), z};
}

void expect_sound(const Brdf& model) {
  Rng rng(test::seed_of_this_test());
  for (int n = 0; n < 20000; ++n) {
    const Vec3 wi = direction(rng, n);
    const Vec3 wo = n % 7 == 0 ? Vec3(-wi.x(), -wi.y(), wi.z()) : direction(rng, n / 3);
    const Vec3 below(wi.x(), wi.y(), -wi.z());
    const Rgb value = model.eval(wo, wi);
    ASSERT_TRUE((value >= 0).all() && value.isFinite().all()) << wo.transpose() << " | " << wi.transpose();
    if (model.traits().reciprocal) {
      ASSERT_TRUE((value == model.eval(wi, wo)).all()) << wo.transpose() << " | " << wi.transpose();
    }
    ASSERT_TRUE((model.eval(wo, below) == 0).all() && (model.eval(below, wo) == 0).all());
    const double density = model.pdf(wo, wi);
    ASSERT_TRUE(density >= 0 && std::isfinite(density)) << wo.transpose() << " | " << wi.transpose();
    ASSERT_EQ(model.pdf(wo, below), 0);
    const double first = uniform(rng);
    const Sample draw = model.sample(wo, {first, uniform(rng)});
    ASSERT_TRUE(draw.wi.allFinite() && draw.weight.isFinite().all() && (draw.weight >= 0).all()) << wo.transpose();
  }
}

TEST_P(AnalyticModel, IsSoundAndReciprocalAsClaimed) {
  expect_sound(*GetParam().make());
}

TEST_P(AnalyticModel, TurnsAsClaimed) {
  const BrdfPtr model = GetParam().make();
  Rng rng(test::seed_of_this_test());
  double largest = 0;
  for (int n = 0; n < 5000; ++n) {
    const Vec3 wi = test::uniform_hemisphere(rng);
    const Vec3 wo = test::uniform_hemisphere(rng);
    const Eigen::AngleAxisd turn(2 * kPi * uniform(rng), Vec3::UnitZ());
    const double here = model->eval(wo, wi).sum();
    const double there = model->eval(turn * wo, turn * wi).sum();
    if (here > 1e-100) largest = std::max(largest, std::abs(there / here - 1));
  }
  if (model->traits().isotropic) {
    EXPECT_LT(largest, kTurned);
  } else {
    EXPECT_GT(largest, 0.01);
  }
}

TEST_P(AnalyticModel, ItsIsotropicValuesAreIsotropic) {
  const Case& c = GetParam();
  const AnalyticValues& values = c.info->examples[c.example];
  const BrdfPtr turned = c.info->make(c.info->isotropic(values));
  EXPECT_TRUE(turned->traits().isotropic);
  if (c.make()->traits().isotropic) {
    EXPECT_EQ(c.info->isotropic(values), values);
  }
}

TEST_P(AnalyticModel, IsItsIsotropicFormWhereIsotropic) {
  const Case& c = GetParam();
  if (c.info->isotropic_form.empty()) return;
  const AnalyticValues tied = c.info->isotropic(c.info->examples[c.example]);
  AnalyticValues free;
  std::size_t next = 0;
  for (const AnalyticParameter& parameter : c.info->parameters) {
    const std::size_t count = parameter.per_channel ? 3 : 1;
    if (parameter.isotropic_as.empty()) free.insert(free.end(), &tied[next], &tied[next] + count);
    next += count;
  }
  const BrdfPtr model = c.info->make(tied), form = analytic::find(c.info->isotropic_form).make(free);
  Rng rng(test::seed_of_this_test());
  for (int n = 0; n < 1000; ++n) {
    const Vec3 wi = test::uniform_hemisphere(rng), wo = test::uniform_hemisphere(rng);
    ASSERT_TRUE((model->eval(wo, wi) == form->eval(wo, wi)).all()) << wo.transpose() << " | " << wi.transpose();
  }
}

TEST_P(AnalyticModel, ValuesPerChannelActOnTheirChannelAlone) {
  const Case& c = GetParam();
  AnalyticValues values = c.info->examples[c.example];
  const BrdfPtr before = c.make();
  std::size_t first = 0;
  double changed = 0;
  for (const AnalyticParameter& parameter : c.info->parameters) {
    for (std::size_t channel = 0; parameter.per_channel && channel < 3; ++channel) {
      const double kept = values[first + channel];
      values[first + channel] = kept > 0 ? 0.5 * kept : 0.5;
      const BrdfPtr after = c.info->make(values);
      Rng rng(test::seed_of_this_test());
      for (int n = 0; n < 200; ++n) {
        const Vec3 wi = test::uniform_hemisphere(rng), wo = test::uniform_hemisphere(rng);
        const Rgb change = (after->eval(wo, wi) - before->eval(wo, wi)).abs();
        const double own = change[static_cast<Eigen::Index>(channel)];
        changed += own;
        ASSERT_EQ(change.sum(), own) << parameter.name << " " << channel;
      }
      values[first + channel] = kept;
    }
    first += parameter.per_channel ? 3 : 1;
  }
  EXPECT_GT(changed, 0);
}

TEST_P(AnalyticModel, AlbedoIsAsClaimed) {
  const BrdfPtr model = GetParam().make();
  const double bound = model->traits().albedo_bound;
  if (bound == 0) return;
  for (const Vec3& wo : given_directions()) {
    Rng rng(test::seed_of_this_test());
    test::RgbMean mean;
    for (int n = 0; n < 20000; ++n) {
      const double first = uniform(rng);
      mean.add(model->sample(wo, {first, uniform(rng)}).weight);
    }
    EXPECT_TRUE((mean.mean() <= bound + 4 * mean.variance().sqrt() + 1e-12).all()) << wo.transpose();
  }
}

TEST_P(AnalyticModel, SamplerFollowsItsDensity) {
  const BrdfPtr model = GetParam().make();
  const auto tests = static_cast<int>(cases().size() * given_directions().size());
  for (const Vec3& wo : given_directions()) {
    test::check_sampler(*model, wo, test::seed_of_this_test(), {.draws = test::sampler_draws() / 3, .tests = tests});
  }
}

class AnalyticList : public testing::TestWithParam<const AnalyticInfo*> {};

std::vector<const AnalyticInfo*> models() {
  std::vector<const AnalyticInfo*> list;
  for (const AnalyticInfo& info : analytic::all()) list.push_back(&info);
  return list;
}

INSTANTIATE_TEST_SUITE_P(All, AnalyticList, testing::ValuesIn(models()),
                         [](const auto& test) { return test.param->name; });

TEST_P(AnalyticList, IsDescribed) {
  const AnalyticInfo& info = *GetParam();
  EXPECT_EQ(&analytic::find(info.name), &info);
  EXPECT_FALSE(info.title.empty() || info.source.empty() || info.examples.empty());
  EXPECT_NO_THROW((void)info.make(info.initial()));
  std::set<std::string> names;
  for (const AnalyticParameter& parameter : info.parameters) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_TRUE(std::isfinite(parameter.bounds.lowest) && std::isfinite(parameter.bounds.highest)) << parameter.name;
  }
}

TEST_P(AnalyticList, IsSoundAtItsBoundsAndRefusesMore) {
  const AnalyticInfo& info = *GetParam();
  std::vector<double> low, high;
  for (const AnalyticParameter& parameter : info.parameters) {
    low.insert(low.end(), parameter.per_channel ? 3 : 1, parameter.bounds.lowest);
    high.insert(high.end(), parameter.per_channel ? 3 : 1, parameter.bounds.highest);
  }
  expect_sound(*info.make(low));
  expect_sound(*info.make(high));
  for (std::size_t n = 0; n < info.size(); ++n) {
    for (const double beyond : {low[n] - 1e-9, high[n] + 1e-9, std::nan("")}) {
      AnalyticValues values = info.initial();
      values[n] = beyond;
      EXPECT_THROW((void)info.make(values), std::domain_error) << n << ": " << beyond;
      EXPECT_THROW((void)info.make_unchecked(values), std::domain_error) << n << ": " << beyond;
    }
    AnalyticValues corner = low;
    corner[n] = high[n];
    expect_sound(*info.make(corner));
  }
  EXPECT_THROW((void)info.make(AnalyticValues(info.size() + 1, 0.5)), std::invalid_argument);
}

TEST(AnalyticRegistry, UnknownNameListsTheKnownOnes) {
  try {
    (void)analytic::find("shiny");
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("'shiny'"), std::string::npos) << message;
    for (const AnalyticInfo& info : analytic::all()) EXPECT_NE(message.find(info.name), std::string::npos) << message;
  }
}

TEST(NotComputable, EachSaysWhyInASentenceAndIsNotInTheList) {
  std::set<std::string_view> names;
  for (const analytic::NotComputable& entry : analytic::kNotComputable) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_NE(entry.source.find_first_of("12"), std::string_view::npos) << entry.name << ": a year";
    ASSERT_FALSE(entry.why.empty());
    EXPECT_EQ(entry.why.find('.'), entry.why.size() - 1) << entry.name << ": one sentence";
    for (const AnalyticInfo& info : analytic::all()) {
      EXPECT_EQ(info.source.find(entry.source), std::string::npos) << entry.name << " and " << info.name;
    }
  }
}

}  // namespace
}  // namespace sklar::brdf
