#include "copula/inference/joint.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <concepts>
#include <limits>

#include "tests/support/family_cases.hpp"

namespace sklar {
namespace {

template <class J>
concept HasLogPdf = requires(const J& joint, const Points& x) {
  joint.log_pdf(x);
};
static_assert(HasLogPdf<JointDensity> && !HasLogPdf<JointDistribution>);

/// Margins that differ, on [0, 4].
std::shared_ptr<const HistogramMarginal> margin(int i) {
  return std::make_shared<HistogramMarginal>(std::vector<double>{0, 1, 2.5, 4}, std::vector<double>{1.0 + i, 2, 0.5});
}

JointDensity joint_of(const test::FamilyCase& test_case) {
  std::vector<std::shared_ptr<const DensityMarginal>> margins;
  margins.reserve(static_cast<std::size_t>(test_case.dim));
  for (int i = 0; i < test_case.dim; ++i) margins.push_back(margin(i));
  return {std::move(margins), test_case.copula()};
}

/// Probability of the box (low, high]^d by inclusion and exclusion.
double box_probability(const JointDensity& joint, double low, double high) {
  const int corners = 1 << joint.dim();
  Points x(corners, joint.dim());
  Column sign = Column::Ones(corners);
  for (int corner = 0; corner < corners; ++corner) {
    for (int i = 0; i < joint.dim(); ++i) {
      const bool lower = (corner >> i & 1) != 0;
      x(corner, i) = lower ? low : high;
      if (lower) sign[corner] = -sign[corner];
    }
  }
  return (sign * joint.cdf(x)).sum();
}

/// Integral of the density over [low, high]^d by a product Gauss rule; the box must lie within one bin of every margin.
double box_integral(const JointDensity& joint, double low, double high) {
  constexpr unsigned kNodes = 20;
  using Rule = boost::math::quadrature::gauss<double, kNodes>;
  std::vector<std::pair<double, double>> rule;  // node, weight on [low, high]
  const double half = 0.5 * (high - low);
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    for (const double sign : {-1.0, 1.0}) {
      rule.emplace_back(low + half + sign * half * Rule::abscissa()[i], half * Rule::weights()[i]);
    }
  }
  const auto count = static_cast<Index>(std::pow(rule.size(), joint.dim()));
  Points x(count, joint.dim());
  Column weight = Column::Ones(count);
  for (Index row = 0; row < count; ++row) {
    Index digits = row;
    for (int i = 0; i < joint.dim(); ++i, digits /= static_cast<Index>(rule.size())) {
      const auto& [node, node_weight] = rule[static_cast<std::size_t>(digits) % rule.size()];
      x(row, i) = node;
      weight[row] *= node_weight;
    }
  }
  return (weight * joint.log_pdf(x).exp()).sum();
}

TEST(Joint, DensityIntegratesToTheProbabilityOfABox) {
  constexpr double kQuadrature = 1e-9;  // 20 Gauss nodes on a smooth density, tau about 0.3
  for (const test::FamilyCase& test_case : test::family_cases_near(0.3, {2, 3})) {
    const JointDensity joint = joint_of(test_case);
    const double expected = box_probability(joint, 1.25, 2.25);
    EXPECT_NEAR(box_integral(joint, 1.25, 2.25), expected, kQuadrature * expected) << test_case.name();
  }
}

TEST(Joint, HasMassOneWithinItsSupport) {
  for (const test::FamilyCase& test_case : test::family_cases({2, 3})) {
    const JointDensity joint = joint_of(test_case);
    EXPECT_EQ(joint.cdf(Points::Constant(1, test_case.dim, 4.0))[0], 1) << test_case.name();
    EXPECT_EQ(joint.cdf(Points::Constant(1, test_case.dim, 0.0))[0], 0) << test_case.name();
    EXPECT_EQ(joint.log_pdf(Points::Constant(1, test_case.dim, 4.5))[0], -std::numeric_limits<double>::infinity());
  }
}

TEST(Joint, ConditionalsAreInverseAndKeepWhatIsGiven) {
  constexpr double kRoundTrip = 1e-9;  // relative; the cdf of the sample is rounded before it is conditioned on
  Rng rng(5);
  for (const test::FamilyCase& test_case : test::family_cases_near(0.3, {2, 4})) {
    const JointDensity joint = joint_of(test_case);
    const Points w = uniforms(rng, 50, test_case.dim - 1);
    const Points x = joint.inverse_rosenblatt(w, Points::Constant(1, 1, 1.7));
    EXPECT_TRUE((x.col(0) == 1.7).all());
    for (int k = 1; k < test_case.dim; ++k) {
      const Column back = joint.conditional_cdf(x.leftCols(k + 1));
      EXPECT_LE(((back - w.col(k - 1)) / w.col(k - 1)).abs().maxCoeff(), kRoundTrip) << test_case.name();
      Points p = x.leftCols(k + 1);
      p.col(k) = w.col(k - 1);
      EXPECT_LE((joint.conditional_quantile(p) - x.col(k)).abs().maxCoeff(), kRoundTrip) << test_case.name();
    }
  }
}

TEST(Joint, SampleIsItsUniformsTransformed) {
  const test::FamilyCase test_case = test::family_cases_near(0.3, {3}).back();
  const JointDensity joint = joint_of(test_case);
  Rng rng(6);
  Rng same(6);
  EXPECT_TRUE((joint.sample(10, rng) == joint.inverse_rosenblatt(uniforms(same, 10, 3))).all());
}

TEST(Joint, NaNStaysInItsRow) {
  const JointDensity joint = joint_of(test::family_cases_near(0.3, {2}).back());
  Points x = Points::Constant(2, 2, 1.5);
  x(1, 0) = std::nan("");
  EXPECT_TRUE(std::isnan(joint.log_pdf(x)[1]) && std::isnan(joint.cdf(x)[1]));
  EXPECT_TRUE(std::isfinite(joint.log_pdf(x)[0]) && std::isfinite(joint.cdf(x)[0]));
}

TEST(Joint, RefusesWrongShapes) {
  const test::FamilyCase test_case = test::family_cases_near(0.3, {2}).back();
  const JointDensity joint = joint_of(test_case);
  EXPECT_THROW((void)JointDensity({margin(0)}, test_case.copula()), std::invalid_argument);
  EXPECT_THROW((void)joint.log_pdf(Points::Ones(1, 3)), std::invalid_argument);
  EXPECT_THROW((void)joint.cdf(Points::Ones(1, 1)), std::invalid_argument);
  EXPECT_THROW((void)joint.conditional_cdf(Points::Ones(1, 3)), std::invalid_argument);
}

}  // namespace
}  // namespace sklar
