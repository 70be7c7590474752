#include "copula/inference/margin_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "copula/random.hpp"
#include "tests/support/message.hpp"

namespace sklar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr double kExact = 1e-13;  ///< relative, of estimates that long double determines to 1e-15

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], kExact * std::abs(expected[i])) << i;
}

/// The values, each as often as its weight says.
Column repeated(const Column& x, const Column& weights) {
  std::vector<double> all;
  for (Index i = 0; i < x.size(); ++i) all.insert(all.end(), static_cast<std::size_t>(weights[i]), x[i]);
  return Eigen::Map<const Column>(all.data(), static_cast<Index>(all.size()));
}

const Column kPositive{{0.25, 0.5, 1.5, 2, 4.75, 8}};
const Column kPart{{0.0625, 0.25, 0.375, 0.5, 0.875}};

// Estimates and standard errors below are computed with 30 digits from the equations of the likelihood.
TEST(FitMargin, NormalIsMeanAndDeviation) {
  const MarginFit fit = fit_margin({.kind = MarginKind::normal}, Column{{1, 2, 4, 9}});
  expect_near(fit.parameters, {4, std::sqrt(9.5)});
  expect_near(fit.standard_error, {std::sqrt(9.5 / 4), std::sqrt(9.5 / 8)});
  EXPECT_NEAR(fit.log_likelihood, -2 * (std::log(2 * M_PI * 9.5) + 1), kExact * 10);
}

TEST(FitMargin, GammaSolvesTheLikelihoodEquations) {
  const MarginFit fit = fit_margin({.kind = MarginKind::gamma}, kPositive);
  expect_near(fit.parameters, {0.96790871705886506492, 2.9272732886866016325});
  expect_near(fit.standard_error, {0.49061484105609061038, 1.9175789824656514007});
  EXPECT_NEAR(fit.log_likelihood, -12.246634174473117181, kExact * 13);
  // x = 1 + e with e small has shape 1 / var(log x) to first order.
  const MarginFit narrow = fit_margin({.kind = MarginKind::gamma}, Column{{1 - 0x1p-20, 1 + 0x1p-20}});
  EXPECT_NEAR(narrow.parameters[0] * 0x1p-40, 1, 1e-9);
}

TEST(FitMargin, BetaSolvesTheLikelihoodEquationsOnItsSupport) {
  const MarginFit fit = fit_margin({.kind = MarginKind::beta}, kPart);
  expect_near(fit.parameters, {1.0559190480458080235, 1.4467539907020362678});
  expect_near(fit.standard_error, {0.60741181340840962697, 0.87959534607797695523});
  const MarginFit wide = fit_margin({.kind = MarginKind::beta, .lowest = -2, .highest = 6}, -2 + 8 * kPart);
  expect_near(wide.parameters, fit.parameters);
  EXPECT_NEAR(wide.log_likelihood, fit.log_likelihood - 5 * std::log(8.0), kExact * 20);
}

TEST(FitMargin, AWeightCountsRows) {
  const Column weights{{2, 0, 1, 3, 1}};
  for (const MarginKind kind : {MarginKind::normal, MarginKind::gamma, MarginKind::beta, MarginKind::kernel}) {
    const MarginFit weighted = fit_margin({.kind = kind}, kPart, weights);
    const MarginFit all = fit_margin({.kind = kind}, repeated(kPart, weights));
    expect_near(weighted.parameters, all.parameters);
    if (kind != MarginKind::kernel) expect_near(weighted.standard_error, all.standard_error);
    EXPECT_NEAR(weighted.log_likelihood, all.log_likelihood, 10 * kExact) << to_text(kind);
  }
}

TEST(FitMargin, RecoversWhatItWasDrawnFrom) {
  Rng rng(11);
  const Column u = uniforms(rng, 4000, 1).col(0);
  const std::vector<std::pair<MarginSpec, std::vector<double>>> cases = {
      {{.kind = MarginKind::normal}, {-3, 2}},
      {{.kind = MarginKind::gamma}, {0.3, 5}},
      {{.kind = MarginKind::gamma}, {40, 0.1}},
      {{.kind = MarginKind::beta}, {0.4, 3}},
      {{.kind = MarginKind::beta, .lowest = -1, .highest = 1}, {20, 8}}};
  for (const auto& [spec, parameters] : cases) {
    const StoredMarginal truth = make_margin(spec, parameters);
    const Column x = std::visit([&](const auto& margin) { return margin.quantile(u); }, truth);
    const MarginFit fit = fit_margin(spec, x);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LE(std::abs(fit.parameters[i] - parameters[i]), 4 * fit.standard_error[i])
          << to_text(spec.kind) << " " << parameters[i];
    }
  }
}

TEST(FitMargin, SaysWhatIsOutside) {
  const auto refusal = [](MarginSpec spec, const Column& x) {
    return test::message_of<std::logic_error>([&] { (void)fit_margin(spec, x); });
  };
  EXPECT_EQ(refusal({.kind = MarginKind::gamma}, Column{{1, 0, 2}}),
            "gamma margin: x must be in (0, inf), got x(1) = 0");
  EXPECT_EQ(refusal({.kind = MarginKind::beta, .lowest = 1, .highest = 2}, Column{{1.5, 1.25, 2}}),
            "beta margin: x must be in (1, 2), got x(2) = 2");
  for (const MarginKind kind : {MarginKind::normal, MarginKind::gamma, MarginKind::beta, MarginKind::kernel}) {
    const std::string name(to_text(kind));
    EXPECT_EQ(refusal({.kind = kind}, Column{{0.1, 0.1, 0.1}}), name + " margin: all values are 0.1");
  }
}

TEST(KernelMarginal, IsThatOfManyDigitsInBothTails) {
  const KernelMarginal margin(Column{{5, 0, 1}}, 0.5);
  struct Reference {
    double x, cdf, log_pdf;
  };
  for (const auto& [x, cdf, log_pdf] :
       {Reference{-15, 1.6355713090493956865e-198, -451.32440364131283712},
        Reference{0.75, 0.41391011248570961328, -1.1361419537946141201},
        Reference{3, 0.66666666633780411832, -8.6312337610456508758}, Reference{30, 1, -1251.3244036413128371}}) {
    EXPECT_NEAR(margin.cdf(x), cdf, kExact * cdf) << x;
    EXPECT_NEAR(margin.log_pdf(x), log_pdf, kExact * std::abs(log_pdf)) << x;
  }
  EXPECT_NEAR(margin.quantile(1e-20), -4.5721655671230781712, kExact * 5);
  EXPECT_NEAR(margin.quantile(1 - 0x1p-40), 8.4465757772790909067, kExact * 9);
  for (const double p : {1e-300, 0.2, 0.5, 0.7, 1 - 0x1p-53}) {
    EXPECT_NEAR(margin.cdf(margin.quantile(p)) / p, 1, 1e-11) << p;  // 37 bandwidths out x moves it by 40 times as much
  }
  EXPECT_EQ(margin.quantile(0.0), -kInfinity);
  EXPECT_EQ(margin.cdf(kInfinity), 1);
  EXPECT_TRUE(std::isnan(margin.cdf(std::nan(""))) && std::isnan(margin.log_pdf(std::nan(""))));
}

TEST(KernelMarginal, BandwidthIsSilvermans) {
  // 1 to 10: sd sqrt(55/6), quartiles 3.25 and 7.75; the second: quartiles 1 and 1.75, the third: twice 1.
  EXPECT_DOUBLE_EQ(silverman_bandwidth(Column::LinSpaced(10, 1, 10)), 0.9 * std::sqrt(55 / 6.0) * std::pow(10, -0.2));
  EXPECT_DOUBLE_EQ(silverman_bandwidth(Column{{0, 1, 1, 1, 2, 10}}), 0.9 * (0.75 / 1.34) * std::pow(6, -0.2));
  EXPECT_DOUBLE_EQ(silverman_bandwidth(Column{{1, 1, 1, 1, 6}}), 0.9 * std::sqrt(5.0) * std::pow(5, -0.2));
  EXPECT_THROW((void)KernelMarginal(Column{{1, 2}}, 0), std::domain_error);
}

TEST(EmpiricalMarginal, WeightIsMultiplicity) {
  const Column x{{3, 1, 3, 2, 9}}, weights{{2, 1, 1, 3, 0}};
  const EmpiricalMarginal weighted(x, weights), all(repeated(x, weights));
  for (const double at : {0.0, 1.0, 1.5, 2.0, 2.5, 3.0, 8.0}) {
    EXPECT_EQ(weighted.cdf(at), all.cdf(at)) << at;
    EXPECT_EQ(weighted.pseudo_observation(at), all.pseudo_observation(at)) << at;
  }
  for (const double p : {0.0, 0.1, 0.125, 0.126, 0.5, 0.501, 0.875, 1.0}) {
    EXPECT_EQ(weighted.quantile(p), all.quantile(p)) << p;
  }
  EXPECT_EQ(all.pseudo_observation(0), 0.5 / 8);
  EXPECT_EQ(all.pseudo_observation(2.5), 4.5 / 8);
  EXPECT_EQ(all.pseudo_observation(99), 7.5 / 8);
}

}  // namespace
}  // namespace sklar
