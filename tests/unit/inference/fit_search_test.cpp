/// The search itself, on families made for the purpose: several parameters, rows that cannot be evaluated, errors.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "copula/inference/fit.hpp"
#include "copula/inference/minimise.hpp"
#include "copula/inference/parameter_scale.hpp"
#include "copula/inference/select.hpp"

namespace sklar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using LogDensity = std::function<double(double u, double v, const Theta& theta)>;

/// A density on the square. What a fit does not use has no formula here and gives NaN.
class FormulaCopula final : public Copula {
 public:
  FormulaCopula(LogDensity log_density, Theta theta)
      : Copula(2), log_density_(std::move(log_density)), theta_(std::move(theta)) {}

 private:
  void log_pdf_into(const PointsRef& u, const Reflection&, ColumnOut out) const override {
    for (Index row = 0; row < u.rows(); ++row) out[row] = log_density_(u(row, 0), u(row, 1), theta_);
  }
  void log_cdf_into(const PointsRef&, const Reflection&, ColumnOut out) const override { out = std::nan(""); }
  void conditional_into(const PointsRef&, const Reflection&, Tail, ColumnOut out) const override { out = std::nan(""); }
  void conditional_inverse_into(const PointsRef&, const Reflection&, Tail, ColumnOut out) const override {
    out = std::nan("");
  }
  bool has_frailty() const override { return false; }
  BigFloat exact_row(Quantity, std::span<const BigFloat>, const Reflection&, int) const override {
    return std::nan("");
  }
  void draw(Route, const Reflection&, Rng&, std::span<double> u) const override { std::ranges::fill(u, std::nan("")); }

  LogDensity log_density_;
  Theta theta_;
};

FamilyInfo family_of(const LogDensity& log_density, const std::vector<Interval>& domains, const Theta& example) {
  FamilyInfo family{.name = "formula",
                    .title = "Formula",
                    .psi = "",
                    .source = "",
                    .parameters = {},
                    .examples = {example},
                    .make_unchecked = [log_density](int, const Theta& theta) -> CopulaPtr {
                      return std::make_shared<FormulaCopula>(log_density, theta);
                    },
                    .tau = [](const Theta&) { return 0.0; },
                    .theta_from_tau = {},
                    .tails = {}};
  for (std::size_t i = 0; i < domains.size(); ++i) {
    family.parameters.push_back({"theta" + std::to_string(i + 1), [domain = domains[i]](int) { return domain; }});
  }
  return family;
}

double first_legendre(double u) {
  return 2 * u - 1;
}
double second_legendre(double u) {
  return 1 - 6 * u + 6 * u * u;
}

/// c = 1 + a P1(u) P1(v) + b P2(u) P2(v): linear in two parameters.
FamilyInfo legendre() {
  const LogDensity log_density = [](double u, double v, const Theta& theta) {
    return std::log1p(theta[0] * first_legendre(u) * first_legendre(v) +
                      theta[1] * second_legendre(u) * second_legendre(v));
  };
  return family_of(log_density, {{-0.5, 0.5}, {-0.4, 0.4}}, {0.1, 0.1});
}

/// Points of a density below `bound`, by rejection.
Points rejection_sample(const Copula& copula, double bound, Index n, Rng& rng) {
  Points u(n, 2);
  for (Index row = 0; row < n;) {
    const Points w = uniforms(rng, 1, 3);
    if (w(0, 2) * bound < copula.pdf(w.leftCols(2))[0]) u.row(row++) = w.leftCols(2);
  }
  return u;
}

TEST(FitSeveralParameters, RecoversThemWithTheirErrors) {
  const FamilyInfo family = legendre();
  const Theta theta = {0.3, -0.2};
  Rng rng(4);
  const Points u = rejection_sample(*family.make(2, theta), 2, 20000, rng);
  const FitResult result = fit_maximum_likelihood(family, u);
  ASSERT_EQ(result.status, FitStatus::converged) << result.message;
  // Fisher information of a: about E P1(u)^2 P1(v)^2 = 1/9 near independence, of b: 1/25.
  EXPECT_NEAR(result.standard_error[0], 3 / std::sqrt(20000.0), 0.2 * 3 / std::sqrt(20000.0));
  EXPECT_NEAR(result.standard_error[1], 5 / std::sqrt(20000.0), 0.2 * 5 / std::sqrt(20000.0));
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(result.theta[i], theta[i], 4 * result.standard_error[i]);
}

TEST(FitSeveralParameters, LeastSquaresFindsTheExactOnes) {
  const FamilyInfo family = legendre();
  const Theta theta = {0.3, -0.2};
  const std::vector<Index> shape = {12, 12};
  CellTable cells = cell_table(Column::Ones(144), shape);
  cells.mass = family.make(2, theta)->pdf(cells.u) * cells.margin;
  const FitResult result = fit_least_squares(family, cells);
  ASSERT_EQ(result.status, FitStatus::converged) << result.message;
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(result.theta[i], theta[i], 1e-6);
}

TEST(FitSeveralParameters, TauCannotBeInverted) {
  EXPECT_THROW((void)fit_tau_inversion(legendre(), Points::Constant(3, 2, 0.5)), std::invalid_argument);
}

const Points kRows{{0.2, 0.3}, {0.4, 0.6}, {0.7, 0.5}, {0.9, 0.8}};

// Without rows that break, more theta is always better; above 1 the first row breaks.
TEST(FitBrokenRows, DoNotPay) {
  for (const double broken : {std::nan(""), kInfinity, -kInfinity}) {
    const LogDensity log_density = [broken](double u, double, const Theta& theta) {
      return u < 0.3 && theta[0] > 1 ? broken : 100 * theta[0];
    };
    const FitResult result = fit_maximum_likelihood(family_of(log_density, {{0, 3}}, {2.0}), kRows);
    EXPECT_EQ(result.nonfinite, 0);
    EXPECT_LE(result.theta[0], 1);
    EXPECT_GT(result.theta[0], 0.9);
  }
}

TEST(FitBrokenRows, AreCountedWhereNothingHelps) {
  const LogDensity log_density = [](double u, double, const Theta&) { return u < 0.5 ? -kInfinity : 0.0; };
  const FitResult result = fit_maximum_likelihood(family_of(log_density, {{0, 3}}, {2.0}), kRows);
  EXPECT_EQ(result.status, FitStatus::failed);
  EXPECT_EQ(result.nonfinite, 2);
  EXPECT_EQ(result.log_likelihood, -kInfinity);
  EXPECT_EQ(result.message, "2 rows have no finite density at the best parameters found");
  EXPECT_EQ(fit_maximum_likelihood(family_of(log_density, {{0, 3}}, {2.0}), kRows, Column{{0, 0, 1, 1}}).nonfinite, 0);
}

TEST(FitSearch, RethrowsWhatTheDensityThrows) {
  const LogDensity log_density = [](double, double, const Theta& theta) -> double {
    if (theta[0] < 1) throw std::runtime_error("no density here");
    return theta[0];
  };
  EXPECT_THROW((void)fit_maximum_likelihood(family_of(log_density, {{0, 3}}, {1.01}), kRows), std::runtime_error);
}

TEST(FitSearch, KeepsTheBestPointWhenEvaluationsRunOut) {
  const LogDensity log_density = [](double, double, const Theta& theta) { return -std::pow(theta[0] - 1.7, 2); };
  const FamilyInfo family = family_of(log_density, {{-kInfinity, kInfinity}}, {100.0});
  const FitResult result = fit_maximum_likelihood(family, kRows, Column(), {.max_evaluations = 4});
  EXPECT_EQ(result.status, FitStatus::max_evaluations);
  EXPECT_EQ(result.evaluations, 4);
  EXPECT_GT(result.log_likelihood, -4 * std::pow(100 - 1.7, 2));
  EXPECT_NEAR(fit_maximum_likelihood(family, kRows).theta[0], 1.7, 1e-5);
}

TEST(ParameterScale, IsWithinEveryKindOfDomain) {
  const LogDensity none = [](double, double, const Theta&) { return 0.0; };
  const std::vector<Interval> domains = {
      {0, 1, false, false}, {-2, kInfinity}, {-kInfinity, 3, true, false}, {-kInfinity, kInfinity}};
  const FamilyInfo family = family_of(none, domains, {0.5, 1, 1, 1});
  const ParameterScale scale(family, 2);
  EXPECT_TRUE(family.make(2, scale.theta(scale.box().lower)));
  EXPECT_TRUE(family.make(2, scale.theta(scale.box().upper)));
  const Theta example = scale.theta(scale.lattice().back());
  for (std::size_t i = 0; i < domains.size(); ++i) EXPECT_DOUBLE_EQ(example[i], family.examples.front()[i]);
}

TEST(Minimise, TakesFewEvaluationsInOneDimension) {
  const Objective parabola = [](const std::vector<double>& z) {
    return Evaluation{.value = std::cosh(z[0] - 0.3), .nonfinite = 0};
  };
  const Minimum minimum =
      minimise(parabola, {0.25}, {{-5}, {5}}, {.step = 0.03, .tolerance = 1e-7, .max_evaluations = 100});
  EXPECT_NEAR(minimum.z[0], 0.3, 1e-6);
  EXPECT_LE(minimum.evaluations, 15);
  EXPECT_EQ(minimum.stop, MinimiseStop::tolerance);
}

TEST(Minimise, EndsOnABound) {
  const Objective slope = [](const std::vector<double>& z) { return Evaluation{.value = z[0], .nonfinite = 0}; };
  const Minimum minimum =
      minimise(slope, {0.5}, {{0.25}, {5}}, {.step = 0.03, .tolerance = 1e-7, .max_evaluations = 100});
  EXPECT_EQ(minimum.z[0], 0.25);
}

TEST(FitAll, OrdersByAicAndKeepsFailures) {
  FamilyInfo good = legendre();
  good.name = "good";
  FamilyInfo flat = family_of([](double, double, const Theta&) { return 0.0; }, {}, {});
  flat.name = "flat";
  FamilyInfo broken = family_of([](double, double, const Theta&) { return -kInfinity; }, {{0, 1}}, {0.5});
  broken.name = "broken";
  FamilyInfo throwing = broken;
  throwing.name = "throwing";
  throwing.make_unchecked = [](int, const Theta&) -> CopulaPtr { throw std::runtime_error("not in this dimension"); };
  Rng rng(9);
  const Points u = rejection_sample(*good.make(2, {0.4, 0.3}), 2, 2000, rng);
  const std::vector<const FamilyInfo*> families = {&throwing, &broken, &flat, &good};
  const std::vector<FitResult> results = fit_all(families, FitMethod::maximum_likelihood, u);
  ASSERT_EQ(results.size(), 4u);
  EXPECT_EQ(results[0].family, "good");
  EXPECT_EQ(results[1].family, "flat");
  EXPECT_LT(results[0].aic, results[1].aic);
  for (const FitResult& failed : {results[2], results[3]}) {
    EXPECT_EQ(failed.status, FitStatus::failed);
    EXPECT_FALSE(failed.message.empty());
  }
  EXPECT_THROW((void)fit_all(families, FitMethod::maximum_likelihood, Points(0, 2)), std::invalid_argument);
}

}  // namespace
}  // namespace sklar
