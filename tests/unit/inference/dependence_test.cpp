#include "copula/inference/dependence.hpp"

#include <gtest/gtest.h>

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
