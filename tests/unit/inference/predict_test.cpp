#include "copula/inference/predict.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "copula/mixture.hpp"
#include "copula/reordered.hpp"
#include "families/registry.hpp"
#include "tests/support/message.hpp"

namespace sklar {
namespace {

CopulaPtr copula(std::string_view family, int dim, double theta) {
  return families::resolve(family).make(dim, {theta});
}

/// Smooth densities, none of them exchangeable but the first.
std::vector<CopulaPtr> copulas() {
  const auto mixture = [](int dim) {
    return std::make_shared<Mixture>(
        std::vector<CopulaPtr>{copula("frank@u2", dim, 3), copula("frank@u1+u3", dim, 5), copula("frank", dim, 2)},
        std::vector<double>{0.5, 0.25, 0.25});
  };
  return {copula("frank", 3, 4), copula("frank@u1", 3, 4), copula("frank@u1+u3", 4, 3), mixture(3), mixture(4)};
}

/// Margins that differ, on [0, 4].
std::shared_ptr<const JointDensity> joint_of(const CopulaPtr& copula) {
  std::vector<std::shared_ptr<const DensityMarginal>> margins;
  margins.reserve(static_cast<std::size_t>(copula->dim()));
  for (int i = 0; i < copula->dim(); ++i) {
    margins.push_back(
        std::make_shared<HistogramMarginal>(std::vector<double>{0, 1, 4}, std::vector<double>{1.0 + i, 2}));
  }
  return std::make_shared<JointDensity>(std::move(margins), copula);
}

std::shared_ptr<const JointDistribution> with_uniform_margins(const CopulaPtr& copula) {
  const auto uniform = std::make_shared<HistogramMarginal>(std::vector<double>{0, 1}, std::vector<double>{1});
  std::vector<std::shared_ptr<const Marginal>> margins(static_cast<std::size_t>(copula->dim()), uniform);
  return std::make_shared<JointDistribution>(std::move(margins), copula);
}

/// The integral of the joint density over the columns from `column` on that are not given, that of the target up to
/// `end`, by Gauss rules on each bin.
double integral(const JointDensity& joint, Points& x, const std::vector<int>& given, int target, double end,
                int column = 0) {
  using Rule = boost::math::quadrature::gauss<double, 15>;
  if (column == joint.dim()) return std::exp(joint.log_pdf(x)[0]);
  if (std::ranges::find(given, column) != given.end()) return integral(joint, x, given, target, end, column + 1);
  const double last = column == target ? end : 4;
  const auto inner = [&](double value) {
    x(0, column) = value;
    return integral(joint, x, given, target, end, column + 1);
  };
  double sum = Rule::integrate(inner, 0.0, std::min(last, 1.0));
  if (last > 1) sum += Rule::integrate(inner, 1.0, last);
  return sum;
}

TEST(Prediction, IsTheIntegralOfTheJointDensity) {
  constexpr double kQuadrature = 1e-9;
  const std::vector<std::vector<int>> subsets = {{2}, {1}, {2, 0}, {1, 2}};
  for (const CopulaPtr& copula : copulas()) {
    const auto joint = joint_of(copula);
    for (const std::vector<int>& given : subsets) {
      if (static_cast<int>(given.size()) < joint->dim() - 2) continue;  // integrals over three columns take seconds
      const Prediction prediction(joint, given);
      Points values(1, static_cast<Index>(given.size()));
      Points x(1, joint->dim());
      for (std::size_t i = 0; i < given.size(); ++i) {
        values(0, static_cast<Index>(i)) = 0.7 + 1.5 * static_cast<double>(i);
        x(0, given[i]) = values(0, static_cast<Index>(i));
      }
      for (const int target : prediction.missing()) {
        const double expected = integral(*joint, x, given, target, 2.5) / integral(*joint, x, given, target, 4);
        EXPECT_NEAR(prediction.cdf(target, values, Column::Constant(1, 2.5))[0], expected, kQuadrature)
            << "dimension " << joint->dim() << ", given " << given[0] << ", target " << target;
      }
    }
  }
}

TEST(Prediction, QuantilesAndProbabilitiesAreInverse) {
  constexpr double kRoundTrip = 1e-12;
  const Column p = Column::LinSpaced(21, 0.01, 0.99);
  for (const CopulaPtr& copula : copulas()) {
    const auto joint = with_uniform_margins(copula);
    for (const std::vector<int>& given : {std::vector<int>{}, {2}, {1, 0}}) {
      const Prediction prediction(joint, given);
      const Points values = Points::Constant(21, static_cast<Index>(given.size()), 0.8);
      for (const int target : prediction.missing()) {
        const Column x = prediction.quantile(target, values, p);
        EXPECT_LE((prediction.cdf(target, values, x) - p).abs().maxCoeff(), kRoundTrip);
      }
    }
  }
}

TEST(Prediction, SamplesKeepWhatIsGivenAndHaveItsDistribution) {
  constexpr int kPoints = 4000;
  for (const CopulaPtr& copula : copulas()) {
    const auto joint = joint_of(copula);
    const Prediction prediction(joint, {2, 1});
    const Points given = (Points(1, 2) << 0.5, 3).finished();
    Rng rng(3), same(3);
    const Points x = prediction.sample(kPoints, rng, given);
    EXPECT_TRUE((x == prediction.sample(kPoints, same, given)).all());
    EXPECT_TRUE((x.col(2) == 0.5).all() && (x.col(1) == 3).all());
    for (const int target : prediction.missing()) {
      const double median = prediction.quantile(target, given, Column::Constant(1, 0.5))[0];
      const double below = static_cast<double>((x.col(target) <= median).count()) / kPoints;
      EXPECT_NEAR(below, 0.5, 4 * 0.5 / std::sqrt(kPoints)) << target;
    }
  }
}

TEST(Prediction, NaNStaysInItsRow) {
  const Prediction prediction(joint_of(copulas().back()), {3});
  const Points given = (Points(2, 1) << std::nan(""), 1).finished();
  const Column median = prediction.quantile(0, given, Column::Constant(2, 0.5));
  EXPECT_TRUE(std::isnan(median[0]) && std::isfinite(median[1]));
}

TEST(Prediction, RefusesOtherColumns) {
  const auto joint = joint_of(copulas().front());
  for (const std::vector<int>& given : {std::vector<int>{0, 1, 2}, {3}, {-1}, {1, 1}}) {
    EXPECT_THROW((void)Prediction(joint, given), std::invalid_argument);
  }
  const Prediction prediction(joint, {1});
  EXPECT_THROW((void)prediction.quantile(1, Points::Ones(1, 1), Column::Ones(1)), std::invalid_argument);
  EXPECT_THROW((void)prediction.quantile(0, Points::Ones(1, 2), Column::Ones(1)), std::invalid_argument);
  EXPECT_THROW((void)prediction.quantile(0, Points::Ones(2, 1), Column::Ones(1)), std::invalid_argument);
}

TEST(Reordered, HasTheDensityOfTheOriginalAtReorderedPoints) {
  constexpr double kRounding = 1e-13;
  Rng rng(8);
  for (const CopulaPtr& copula : copulas()) {
    const Points u = uniforms(rng, 20, copula->dim());
    std::vector<int> order = {2, 0, 1};
    if (copula->dim() == 4) order.insert(order.begin(), 3);
    const Points moved = u(Eigen::all, order);
    EXPECT_LE((reordered(copula, order)->log_pdf(moved) - copula->log_pdf(u)).abs().maxCoeff(), kRounding * 10);
    EXPECT_THROW((void)reordered(copula, std::vector<int>{0, 0, 1}), std::invalid_argument);
  }
}

/// A copula of no known kind.
class Unknown final : public Copula {
 public:
  Unknown() : Copula(2) {}

 private:
  void log_pdf_into(const PointsRef&, const Reflection&, ColumnOut out) const override { out = 0; }
  void log_cdf_into(const PointsRef&, const Reflection&, ColumnOut out) const override { out = 0; }
  void conditional_into(const PointsRef&, const Reflection&, Tail, ColumnOut out) const override { out = 0; }
  void conditional_inverse_into(const PointsRef&, const Reflection&, Tail, ColumnOut out) const override { out = 0; }
  bool has_frailty() const override { return false; }
  BigFloat exact_row(Quantity, std::span<const BigFloat>, const Reflection&, int) const override { return 0; }
  void draw(Route, const Reflection&, Rng&, std::span<double>) const override {}
};

TEST(Reordered, RefusesWhatItDoesNotKnow) {
  const CopulaPtr unknown = std::make_shared<Unknown>();
  EXPECT_EQ(reordered(unknown, std::vector<int>{0, 1}), unknown);
  EXPECT_EQ(test::message_of<std::invalid_argument>([&] {
              (void)reordered(unknown, std::vector<int>{1, 0});
            }),
            "reordered: this copula is not known to be exchangeable");
}

}  // namespace
}  // namespace sklar
