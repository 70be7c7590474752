#include "copula/inference/dependence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "copula/random.hpp"

namespace sklar {
namespace {

/// The definition, pair by pair.
double tau_by_pairs(const Column& x, const Column& y, const Column& w) {
  const auto sign = [](double difference) { return (difference > 0) - (difference < 0); };
  double score = 0;
  double untied_x = 0;
  double untied_y = 0;
  for (Index i = 0; i < x.size(); ++i) {
    for (Index j = 0; j < i; ++j) {
      const int sx = sign(x[i] - x[j]);
      const int sy = sign(y[i] - y[j]);
      score += w[i] * w[j] * sx * sy;
      untied_x += w[i] * w[j] * sx * sx;
      untied_y += w[i] * w[j] * sy * sy;
    }
  }
  return score / std::sqrt(untied_x * untied_y);
}

Column tied(const Column& x, double steps) {
  return (x * steps).floor();
}

TEST(KendallTau, IsThatOfThePairs) {
  Rng rng(1);
  for (const Index n : {2, 3, 10, 257}) {
    const Points w = uniforms(rng, n, 3);
    const Column y = w.col(0) + 0.7 * w.col(1);
    // Sums of whole numbers are exact.
    EXPECT_EQ(kendall_tau(w.col(0), y), tau_by_pairs(w.col(0), y, Column::Ones(n))) << n;
    EXPECT_NEAR(kendall_tau(w.col(0), y, w.col(2)), tau_by_pairs(w.col(0), y, w.col(2)), 1e-14) << n;
  }
}

TEST(KendallTau, CountsTiesInEitherColumnAndInBoth) {
  Rng rng(2);
  const Points w = uniforms(rng, 300, 3);
  const Column y = w.col(0) + w.col(1);
  for (const double steps : {2.0, 7.0, 40.0}) {
    const Column x_tied = tied(w.col(0), steps);
    const Column y_tied = tied(y, steps);
    EXPECT_EQ(kendall_tau(x_tied, y), tau_by_pairs(x_tied, y, Column::Ones(300)));
    EXPECT_EQ(kendall_tau(x_tied, y_tied), tau_by_pairs(x_tied, y_tied, Column::Ones(300)));
    EXPECT_NEAR(kendall_tau(x_tied, y_tied, w.col(2)), tau_by_pairs(x_tied, y_tied, w.col(2)), 1e-14);
  }
}

TEST(KendallTau, WeightIsMultiplicityAndItsScaleDoesNotMatter) {
  const Column x{{1, 2, 3, 4, 5}};
  const Column y{{2, 1, 4, 5, 3}};
  const Column weights{{1, 2, 0, 3, 1}};
  const Column x_repeated{{1, 2, 2, 4, 4, 4, 5}};
  const Column y_repeated{{2, 1, 1, 5, 5, 5, 3}};
  const double expected = kendall_tau(x_repeated, y_repeated);
  EXPECT_DOUBLE_EQ(kendall_tau(x, y, weights), expected);
  EXPECT_DOUBLE_EQ(kendall_tau(x, y, weights * 1e-200), expected);
}

TEST(KendallTau, HasItsExtremes) {
  const Column x = Column::LinSpaced(1000, 0, 1);
  EXPECT_EQ(kendall_tau(x, x.exp()), 1.0);
  EXPECT_EQ(kendall_tau(x, -x), -1.0);
  EXPECT_TRUE(std::isnan(kendall_tau(x, Column::Ones(1000))));
}

TEST(KendallTau, MeanIsOverAllPairs) {
  Rng rng(3);
  Points w = uniforms(rng, 100, 3);
  w.col(1) += w.col(0);
  const double expected =
      (kendall_tau(w.col(0), w.col(1)) + kendall_tau(w.col(0), w.col(2)) + kendall_tau(w.col(1), w.col(2))) / 3;
  EXPECT_DOUBLE_EQ(mean_kendall_tau(w), expected);
}

TEST(KendallTau, RefusesWhatItCannotRank) {
  const Column x = Column::LinSpaced(3, 0, 1);
  Column bad = x;
  bad[1] = std::nan("");
  EXPECT_THROW((void)kendall_tau(x, bad), std::domain_error);
  EXPECT_THROW((void)kendall_tau(x, x.head(2)), std::invalid_argument);
  EXPECT_THROW((void)kendall_tau(x.head(1), x.head(1)), std::invalid_argument);
  EXPECT_THROW((void)kendall_tau(x, x, -x), std::domain_error);
  EXPECT_THROW((void)kendall_tau(x, x, 0 * x), std::invalid_argument);
  EXPECT_THROW((void)mean_kendall_tau(x), std::invalid_argument);
}

TEST(PseudoObservations, AreMeanRanksOverNPlusOne) {
  const Points x{{3.0, 1.0}, {-1.0, 1.0}, {3.0, 0.0}, {7.0, 1.0}};
  const Points expected{{2.5, 3.0}, {1.0, 3.0}, {2.5, 1.0}, {4.0, 3.0}};
  EXPECT_TRUE((pseudo_observations(x) == expected / 5).all()) << pseudo_observations(x);
}

TEST(SpearmanRho, IsTheCorrelationOfTheRanks) {
  // Without ties 1 - 6 sum d^2 / (n (n^2 - 1)): d = 1 1 1 1 0.
  const Column x{{1, 2, 3, 4, 5}};
  const Column y{{2, 1, 4, 3.5, 9}};
  EXPECT_DOUBLE_EQ(spearman_rho(x, y), 1 - 6 * 4.0 / (5 * 24));
  // Ranks 1.5 1.5 3 4 and 1 3 3 3, less their mean 2.5: the sum of products is 2, those of squares 4.5 and 3.
  EXPECT_DOUBLE_EQ(spearman_rho(Column{{0, 0, 1, 2}}, Column{{0, 5, 5, 5}}), 2 / std::sqrt(4.5 * 3));
  EXPECT_DOUBLE_EQ(spearman_rho(x, x.exp()), 1);
  EXPECT_DOUBLE_EQ(spearman_rho(x, -x), -1);
  EXPECT_TRUE(std::isnan(spearman_rho(x, Column::Ones(5))));
  EXPECT_THROW((void)spearman_rho(x, y.head(3)), std::invalid_argument);
  EXPECT_DOUBLE_EQ(mean_spearman_rho(Points{{1, 2, 2}, {2, 1, 1}, {3, 3, 3}}), (0.5 + 0.5 + 1) / 3);
}

TEST(SpearmanRho, WeightIsMultiplicityAndItsScaleDoesNotMatter) {
  const Column x{{1, 2, 3, 4, 5}};
  const Column y{{2, 1, 4, 5, 3}};
  const Column weights{{1, 2, 0, 3, 1}};
  const double expected = spearman_rho(Column{{1, 2, 2, 4, 4, 4, 5}}, Column{{2, 1, 1, 5, 5, 5, 3}});
  EXPECT_DOUBLE_EQ(spearman_rho(x, y, weights), expected);
  EXPECT_DOUBLE_EQ(spearman_rho(x, y, weights * 1e-100), expected);
}

TEST(PseudoObservations, TiesAreRankedAsAskedFor) {
  const Points x{{3.0}, {-1.0}, {3.0}, {7.0}, {3.0}};
  const auto ranks = [&](Ties ties, std::uint64_t seed = 1) {
    return Column(pseudo_observations(x, Column(), {.ties = ties, .seed = seed}).col(0) * 6);
  };
  EXPECT_TRUE((ranks(Ties::average) == Column{{3, 1, 3, 5, 3}}).all());
  EXPECT_TRUE((ranks(Ties::lowest) == Column{{2, 1, 2, 5, 2}}).all());
  EXPECT_TRUE((ranks(Ties::highest) == Column{{4, 1, 4, 5, 4}}).all());
  Column sum = Column::Zero(5);
  constexpr int kSeeds = 600;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Column random = ranks(Ties::random, static_cast<std::uint64_t>(seed));
    sum += random;
    std::sort(random.begin(), random.end());
    EXPECT_TRUE((random - Column{{1, 2, 3, 4, 5}}).abs().maxCoeff() < 1e-14) << seed;
  }
  // The mean of kSeeds ranks among 2, 3, 4: four standard errors of sqrt(2/3) each.
  EXPECT_LE((sum / kSeeds - Column{{3, 1, 3, 5, 3}}).abs().maxCoeff(), 4 * std::sqrt(2.0 / 3 / kSeeds));
  EXPECT_TRUE((ranks(Ties::random, 5) == ranks(Ties::random, 5)).all());
  EXPECT_EQ(tied_rows(Points{{1, 1, 2}, {2, 1, 2}, {3, 1, 3}, {2, 2, 3}}), (std::vector<Index>{2, 3, 4}));
}

TEST(PseudoObservations, WeightIsMultiplicity) {
  const Points x{{3.0}, {1.0}, {3.0}, {2.0}};
  const Column weights{{2, 1, 1, 3}};
  const Points repeated{{3.0}, {3.0}, {1.0}, {3.0}, {2.0}, {2.0}, {2.0}};
  const Points all = pseudo_observations(repeated);
  EXPECT_TRUE((pseudo_observations(x, weights).col(0) == Column{{all(0), all(2), all(3), all(4)}}).all());
  // A row of weight 2 tied with one of weight 1, above ranks 1 to 4: it takes the mean of its own two ranks.
  EXPECT_TRUE((pseudo_observations(x, weights, {.ties = Ties::lowest}) * 8 == Points{{5.5}, {1}, {5}, {3}}).all());
  EXPECT_TRUE((pseudo_observations(x, weights, {.ties = Ties::highest}) * 8 == Points{{6.5}, {1}, {7}, {3}}).all());
  EXPECT_THROW((void)pseudo_observations(x, -weights), std::domain_error);
}

TEST(PseudoObservations, NameTheEntryThatIsNotFinite) {
  Points x = Points::Ones(4, 2);
  x(2, 1) = std::nan("");
  try {
    (void)pseudo_observations(x);
    FAIL() << "NaN was ranked";
  } catch (const std::domain_error& error) {
    EXPECT_STREQ(error.what(), "pseudo_observations: x must be finite, got x(2,1) = nan");
  }
}

}  // namespace
}  // namespace sklar
