#include "copula/inference/marginal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <concepts>
#include <limits>
#include <stdexcept>

#include "copula/inference/dependence.hpp"
#include "copula/random.hpp"

namespace sklar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// cdf and quantile are each linear within a bin: two roundings of numbers up to 1.
constexpr double kRoundTrip = 4 * std::numeric_limits<double>::epsilon();

// What has no density has no log_pdf, and the compiler knows.
template <class M>
concept HasLogPdf = requires(const M& margin) {
  margin.log_pdf(0.5);
};
static_assert(HasLogPdf<HistogramMarginal> && !HasLogPdf<EmpiricalMarginal> && !HasLogPdf<Marginal>);

/// Bins of mass 0 at both ends and inside; uneven widths.
HistogramMarginal with_gaps() {
  return {{-3, -2, 0, 0.5, 1, 4, 9}, {0, 2, 0, 3, 1, 0}};
}

TEST(HistogramMarginal, IntegratesItsDensity) {
  const HistogramMarginal margin = with_gaps();
  double mass = 0;
  for (std::size_t i = 0; i + 1 < margin.edges().size(); ++i) {
    const double width = margin.edges()[i + 1] - margin.edges()[i];
    const double centre = margin.edges()[i] + width / 2;
    const double density = std::exp(margin.log_pdf(centre));
    EXPECT_NEAR(margin.cdf(centre), mass + density * width / 2, kRoundTrip);
    mass += density * width;
    EXPECT_NEAR(margin.cdf(margin.edges()[i + 1]), mass, kRoundTrip);
  }
  EXPECT_NEAR(mass, 1, kRoundTrip);
}

TEST(HistogramMarginal, QuantileInvertsTheCdf) {
  const HistogramMarginal margin = with_gaps();
  Rng rng(1);
  const Column p = uniforms(rng, 1000, 1);
  EXPECT_LE((margin.cdf(margin.quantile(p)) - p).abs().maxCoeff(), kRoundTrip);
  for (const double x : {-1.5, -1e-3, 0.75, 1.0 + 1e-9, 3.999}) {
    EXPECT_NEAR(margin.quantile(margin.cdf(x)), x, kRoundTrip * 20);  // slope of the quantile: up to 3 / (1/6)
  }
}

TEST(HistogramMarginal, FlatPiecesGiveTheirLowerEnd) {
  const HistogramMarginal margin = with_gaps();
  EXPECT_EQ(margin.quantile(0.0), -2);
  EXPECT_EQ(margin.quantile(margin.cdf(0.25)), 0);
  EXPECT_EQ(margin.quantile(1.0), 4);
  EXPECT_EQ(margin.log_pdf(0.25), -kInfinity);
}

TEST(HistogramMarginal, EndsAndBeyond) {
  const HistogramMarginal margin({0, 1, 2}, {1, 3});
  EXPECT_EQ(margin.cdf(-kInfinity), 0);
  EXPECT_EQ(margin.cdf(0.0), 0);
  EXPECT_EQ(margin.cdf(2.0), 1);
  EXPECT_EQ(margin.cdf(kInfinity), 1);
  EXPECT_EQ(margin.log_pdf(-1e-9), -kInfinity);
  EXPECT_DOUBLE_EQ(margin.log_pdf(0.0), std::log(0.25));
  EXPECT_DOUBLE_EQ(margin.log_pdf(2.0), std::log(0.75));
  for (const double value : {margin.cdf(std::nan("")), margin.quantile(std::nan("")), margin.log_pdf(std::nan(""))}) {
    EXPECT_TRUE(std::isnan(value));
  }
}

TEST(HistogramMarginal, KeepsMassesThatVanishInTheCdf) {
  const HistogramMarginal margin({0, 1, 2}, {1, 1e-30});
  EXPECT_DOUBLE_EQ(margin.log_pdf(1.5), std::log(1e-30));
}

TEST(HistogramMarginal, ScaleOfTheMassesDoesNotMatter) {
  const HistogramMarginal small({0, 1, 2, 3}, {1e-320, 2e-320, 5e-321});
  const HistogramMarginal large({0, 1, 2, 3}, {8e307, 16e307, 4e307});
  EXPECT_NEAR(small.cdf(1.0), large.cdf(1.0), 1e-3);  // a subnormal holds few digits
  EXPECT_DOUBLE_EQ(large.cdf(1.0), 8.0 / 28.0);
}

TEST(HistogramMarginal, RefusesWhatIsNotAHistogram) {
  const auto make = [](std::vector<double> edges, std::vector<double> masses) {
    return HistogramMarginal(std::move(edges), std::move(masses));
  };
  EXPECT_THROW((void)make({0, 1}, {1, 1}), std::invalid_argument);
  EXPECT_THROW((void)make({0}, {}), std::invalid_argument);
  EXPECT_THROW((void)make({0, 1, 2}, {0, 0}), std::invalid_argument);
  EXPECT_THROW((void)make({0, 1, 1}, {1, 1}), std::domain_error);
  EXPECT_THROW((void)make({0, std::nan(""), 2}, {1, 1}), std::domain_error);
  EXPECT_THROW((void)make({0, 1, 2}, {1, -1}), std::domain_error);
  EXPECT_THROW((void)with_gaps().quantile(Column{{0.5, 1.5}}), std::domain_error);
}

TEST(EmpiricalMarginal, AgreesWithPseudoObservations) {
  Rng rng(2);
  Points x = uniforms(rng, 200, 1);
  x = (x * 50).floor();
  const EmpiricalMarginal margin(x.col(0));
  EXPECT_TRUE((margin.cdf(x.col(0)) == pseudo_observations(x).col(0)).all());
}

TEST(EmpiricalMarginal, StepsBetweenTheData) {
  const EmpiricalMarginal margin(Column{{5, 1, 3}});
  EXPECT_EQ(margin.cdf(0.0), 0);
  EXPECT_EQ(margin.cdf(1.0), 0.25);
  EXPECT_EQ(margin.cdf(2.0), 0.25);
  EXPECT_EQ(margin.cdf(9.0), 0.75);
  EXPECT_EQ(margin.quantile(0.0), 1);
  EXPECT_EQ(margin.quantile(0.25), 1);
  EXPECT_EQ(margin.quantile(0.26), 3);
  EXPECT_EQ(margin.quantile(1.0), 5);
  EXPECT_TRUE(std::isnan(margin.cdf(std::nan(""))));
}

TEST(EmpiricalMarginal, NeedsFiniteData) {
  EXPECT_THROW(EmpiricalMarginal{Column()}, std::invalid_argument);
  EXPECT_THROW(EmpiricalMarginal(Column{{1, kInfinity}}), std::domain_error);
}

}  // namespace
}  // namespace sklar
