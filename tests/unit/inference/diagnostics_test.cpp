#include "copula/inference/diagnostics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "copula/rotated.hpp"
#include "families/registry.hpp"

namespace sklar {
namespace {

constexpr double kRelative = 1e-10;

double normal_cdf(double z) {
  return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

TEST(JointRanks, OfSixRowsWorkedOutByHand) {
  // The learning data of Genest and Favre, J. Hydrol. Eng. 12 (2007) 347.
  const Points x{{-2.224, 0.431}, {-1.538, 1.035}, {-0.807, 0.586}, {0.024, 1.465}, {0.052, 1.115}, {1.324, -0.847}};
  const Column expected{{0.0, 0.2, 0.2, 0.6, 0.6, 0.0}};
  EXPECT_TRUE((joint_ranks(x) == expected).all()) << joint_ranks(x);
}

TEST(JointRanks, FollowTheDefinitionWithTies) {
  constexpr Index kRows = 60;
  Rng rng(5);
  for (const Index columns : {2, 3, 4}) {
    Points x(kRows, columns);
    for (double& value : x.reshaped()) value = std::floor(6 * uniform(rng));
    Column expected = Column::Zero(kRows);
    for (Index i = 0; i < kRows; ++i) {
      for (Index j = 0; j < kRows; ++j) expected[i] += j != i && (x.row(j) <= x.row(i)).all();
    }
    EXPECT_TRUE((joint_ranks(x) == expected / (kRows - 1)).all()) << columns << " columns";
  }
}

TEST(JointRanks, RefuseWhatTheyCannotRank) {
  EXPECT_THROW((void)joint_ranks(Points::Ones(1, 2)), std::invalid_argument);
  EXPECT_THROW((void)joint_ranks(Points::Ones(4, 1)), std::invalid_argument);
  EXPECT_THROW((void)joint_ranks(Points::Constant(4, 2, std::nan(""))), std::domain_error);
}

TEST(ExpectedJointRank, SixIndependentPairs) {
  // Kendall plot of the learning data of Genest and Favre (2007), as a test of the R package copula has them.
  constexpr double kPrinted[] = {0.0383659, 0.0924076, 0.163329, 0.255939, 0.381122, 0.568837};
  for (Index i = 1; i <= 6; ++i) EXPECT_NEAR(expected_joint_rank(i, 6, 2), kPrinted[i - 1], 5e-7) << i;
}

TEST(ExpectedJointRank, ClosedForms) {
  for (const Index i : {1, 2, 7, 10}) {
    EXPECT_NEAR(expected_joint_rank(i, 10, 1) * 11 / static_cast<double>(i), 1, kRelative) << i;
  }
  // int (w - w log w)^2 dw = 17/27: the larger of two is expected at 10/27.
  EXPECT_NEAR(expected_joint_rank(2, 2, 2) * 27 / 10, 1, kRelative);
  EXPECT_NEAR(expected_joint_rank(1, 2, 2) * 54 / 7, 1, kRelative);
  EXPECT_NEAR(expected_joint_rank(1, 1, 5) * 32, 1, kRelative);
}

TEST(ExpectedJointRank, SumsToTheMeanOfProducts) {
  for (const int dim : {2, 3, 6}) {
    double sum = 0;
    for (Index i = 1; i <= 300; ++i) sum += expected_joint_rank(i, 300, dim);
    EXPECT_NEAR(sum / 300 * std::pow(2, dim), 1, kRelative) << dim;
  }
}

TEST(ExpectedJointRank, OfManyRowsIsTheQuantile) {
  // The median of K_0 up to terms of order 1/n, for n = 1e6: K_0(w) = 1/2 at w = 0.18668...
  const double w = expected_joint_rank(500'000, 1'000'000, 2);
  EXPECT_NEAR(w - w * std::log(w), 0.5, 2e-6);
}

TEST(ExpectedJointRank, RefusesBadArguments) {
  EXPECT_THROW((void)expected_joint_rank(0, 5, 2), std::invalid_argument);
  EXPECT_THROW((void)expected_joint_rank(6, 5, 2), std::invalid_argument);
  EXPECT_THROW((void)expected_joint_rank(1, 5, 0), std::invalid_argument);
}

TEST(KendallDistribution, OfClayton) {
  const Column t{{0.0, 0.1, 0.5, 0.9, 1.0}};  // K(t) = t + t (1 - t^theta) / theta
  const Column k = kendall_distribution(*families::find("clayton").make(2, {2.0}), t);
  EXPECT_LT((k - (t + t * (1 - t.square()) / 2)).abs().maxCoeff(), 1e-14) << k;
}

TEST(KendallDistribution, OfASurvivalCopulaHasItsTau) {
  constexpr double kFourErrors = 4 * 4 * 0.0036;  // tau = 3 - 4 int K(t) dt
  const CopulaPtr copula = survival_copula(families::find("clayton").make(2, {2.0}));
  const Column middles = Column::LinSpaced(1000, 0.0005, 0.9995);
  EXPECT_NEAR(3 - 4 * kendall_distribution(*copula, middles).mean(), 0.5, kFourErrors);
  EXPECT_THROW((void)kendall_distribution(*copula, Column{{1.5}}), std::domain_error);
}

TEST(NormalScores, InvertTheNormalDistribution) {
  const Points z{{-9.0, -1.0, 0.0}, {0.5, 2.0, 5.0}};
  EXPECT_LT((normal_scores(z.unaryExpr(&normal_cdf)) - z).abs().maxCoeff(), 1e-9);
  EXPECT_THROW((void)normal_scores(Points::Ones(1, 2)), std::domain_error);
}

TEST(SquaredNormalScores, OfIndependentCoordinates) {
  const CopulaPtr copula = families::find("independence").make(2, {});
  const Points u{{0.5, 0.5}, {normal_cdf(1), normal_cdf(-2)}, {normal_cdf(-9), 0.5}};
  const Column expected{{0.0, 5.0, 81.0}};
  EXPECT_LT((squared_normal_scores(*copula, u) - expected).abs().maxCoeff(), 1e-11);
  EXPECT_THROW((void)squared_normal_scores(*copula, Points::Zero(1, 2)), std::domain_error);
}

TEST(SquaredNormalScores, AreChiSquareWhereTheCopulaIsRight) {
  constexpr Index kRows = 20'000;
  Rng rng(3);
  const CopulaPtr copula = families::find("gumbel").make(3, {1.7});
  const Column squares = squared_normal_scores(*copula, copula->sample(kRows, rng));
  EXPECT_NEAR(squares.mean(), 3, 4 * std::sqrt(6.0 / kRows));
  const double above = (squares > chi_square_quantile(0.95, 3)).cast<double>().mean();
  EXPECT_NEAR(above, 0.05, 4 * std::sqrt(0.05 * 0.95 / kRows));
}

TEST(ChiSquare, QuantilesOfTables) {
  EXPECT_NEAR(chi_square_quantile(0.95, 1), 3.841459, 5e-7);
  EXPECT_NEAR(chi_square_quantile(0.95, 2), -2 * std::log(0.05), 1e-12);
  EXPECT_NEAR(chi_square_quantile(0.99, 5), 15.08627, 5e-6);
}

}  // namespace
}  // namespace sklar
