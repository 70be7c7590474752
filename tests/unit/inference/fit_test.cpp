#include "copula/inference/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "copula/inference/dependence.hpp"
#include "copula/inference/objective.hpp"
#include "copula/inference/select.hpp"
#include "copula/inference/spearman.hpp"
#include "copula/rotated_family.hpp"
#include "tests/support/family_cases.hpp"

namespace sklar {
namespace {

constexpr double kStandardErrors = 4;  ///< a fit of simulated data may be off by this many

/// Points of the case, the same for every case of the same dimension.
Points simulated(const test::FamilyCase& test_case, Index n, std::uint64_t seed = 11) {
  Rng rng(seed);
  return test_case.copula()->sample(n, rng);
}

TEST(MaximumLikelihood, RecoversTheParametersOfEveryFamily) {
  std::size_t judged = 0;
  const auto cases = test::family_cases({2, 3, 5});
  for (const test::FamilyCase& test_case : cases) {
    const Points u = simulated(test_case, 1000);
    const FitResult result = fit_maximum_likelihood(*test_case.family, u);
    ASSERT_EQ(result.theta.size(), test_case.theta.size());
    EXPECT_EQ(result.nonfinite, 0) << test_case.name();
    EXPECT_NE(result.status, FitStatus::failed) << test_case.name() << ": " << result.message;
    for (std::size_t i = 0; i < result.theta.size(); ++i) {
      if (std::isnan(result.standard_error[i])) continue;
      ++judged;
      EXPECT_NEAR(result.theta[i], test_case.theta[i], kStandardErrors * result.standard_error[i]) << test_case.name();
    }
    // |tau| of a sample of 1000 has a standard error below 2/3 / sqrt(1000).
    EXPECT_NEAR(result.tau, test_case.tau(), kStandardErrors * 0.667 / std::sqrt(1000.0)) << test_case.name();
  }
  EXPECT_GE(judged, cases.size() / 2) << "too few fits had a standard error";
}

TEST(MaximumLikelihood, IsAtAMaximum) {
  for (const test::FamilyCase& test_case : test::family_cases_near(0.5, {2, 4})) {
    const Points u = simulated(test_case, 500);
    const FitResult result = fit_maximum_likelihood(*test_case.family, u);
    EXPECT_EQ(result.log_likelihood, test_case.family->make(test_case.dim, result.theta)->log_pdf(u).sum());
    EXPECT_EQ(result.objective, -result.log_likelihood);
    for (std::size_t i = 0; i < result.theta.size(); ++i) {
      for (const double shift : {-0.01, 0.01}) {
        Theta other = result.theta;
        other[i] += shift * result.standard_error[i];
        EXPECT_LT(test_case.family->make(test_case.dim, other)->log_pdf(u).sum(), result.log_likelihood)
            << test_case.name();
      }
    }
  }
}

// Over R samples, the mean of ((theta - estimate) / standard error)^2 is a chi-square of R degrees over R.
TEST(MaximumLikelihood, StandardErrorsAreThoseOfRepeatedSamples) {
  constexpr int kSamples = 60;
  for (const test::FamilyCase& test_case : test::family_cases_near(0.2, {2, 3})) {
    if (test_case.theta.empty()) continue;
    double sum = 0;
    for (int sample = 0; sample < kSamples; ++sample) {
      const Points u = simulated(test_case, 400, 100 + static_cast<std::uint64_t>(sample));
      const FitResult result = fit_maximum_likelihood(*test_case.family, u);
      sum += std::pow((result.theta[0] - test_case.theta[0]) / result.standard_error[0], 2);
    }
    const double spread = kStandardErrors * std::sqrt(2.0 / kSamples);
    EXPECT_NEAR(sum / kSamples, 1, spread) << test_case.name();
  }
}

TEST(MaximumLikelihood, WeightIsMultiplicity) {
  const test::FamilyCase test_case = test::family_cases_near(0.5, {3}).back();
  const Points u = simulated(test_case, 300);
  const Column weights = (uniforms(*std::make_unique<Rng>(3), 300, 1).col(0) * 4).floor();
  Points repeated(static_cast<Index>(weights.sum()), 3);
  Index next = 0;
  for (Index row = 0; row < u.rows(); ++row) {
    for (int copy = 0; copy < weights[row]; ++copy) repeated.row(next++) = u.row(row);
  }
  const FitResult weighted = fit_maximum_likelihood(*test_case.family, u, weights);
  const FitResult expected = fit_maximum_likelihood(*test_case.family, repeated);
  const double error = expected.standard_error[0];
  EXPECT_NEAR(weighted.theta[0], expected.theta[0], 1e-4 * error);
  EXPECT_NEAR(weighted.log_likelihood, expected.log_likelihood, 1e-9 * std::abs(expected.log_likelihood));
  EXPECT_NEAR(weighted.standard_error[0], error, 1e-3 * error);
  EXPECT_NEAR(weighted.bic, expected.bic, 1e-9 * std::abs(expected.bic));

  const FitResult scaled = fit_maximum_likelihood(*test_case.family, u, weights / weights.sum());
  EXPECT_NEAR(scaled.theta[0], weighted.theta[0], 1e-4 * error);
}

TEST(MaximumLikelihood, NeitherWeightsOfOneNorRowsOfNoneChangeIt) {
  constexpr Index kRows = 30'000;  // above both the rows of a chunk and those of the start
  const test::FamilyCase test_case = test::family_cases_near(0.5, {2}).back();
  const Points u = simulated(test_case, kRows);
  const FitResult expected = fit_maximum_likelihood(*test_case.family, u);
  const double error = expected.standard_error[0];
  const FitResult ones = fit_maximum_likelihood(*test_case.family, u, Column::Ones(kRows));
  EXPECT_NEAR(ones.theta[0], expected.theta[0], 1e-6 * error);

  Points padded = Points::Constant(2 * kRows, 2, 0.5);  // every other row without weight
  Column weights = Column::Zero(2 * kRows);
  for (Index i = 0; i < kRows; ++i) {
    padded.row(2 * i + 1) = u.row(i);
    weights[2 * i + 1] = 1;
  }
  const FitResult sparse = fit_maximum_likelihood(*test_case.family, padded, weights);
  EXPECT_NEAR(sparse.theta[0], expected.theta[0], 1e-6 * error);
  EXPECT_NEAR(sparse.log_likelihood, expected.log_likelihood, 1e-10 * std::abs(expected.log_likelihood));
  EXPECT_NEAR(sparse.standard_error[0], error, 1e-3 * error);
}

TEST(MaximumLikelihood, DoesNotDependOnThreadsAndIsReproducible) {
  const test::FamilyCase test_case = test::family_cases_near(0.5, {2}).back();
  const Points u = simulated(test_case, 30000);
  const FitResult one = fit_maximum_likelihood(*test_case.family, u, Column(), {.parallel = false});
  for (int repetition = 0; repetition < 3; ++repetition) {
    const FitResult many = fit_maximum_likelihood(*test_case.family, u, Column(), {.parallel = true});
    EXPECT_EQ(many.theta, one.theta);
    EXPECT_EQ(many.log_likelihood, one.log_likelihood);
    EXPECT_EQ(many.standard_error, one.standard_error);
    EXPECT_EQ(many.evaluations, one.evaluations);
  }
  EXPECT_LE(one.evaluations, 20);
}

TEST(MaximumLikelihood, ComonotoneDataEndAtTheBound) {
  const Column line = Column::LinSpaced(100, 0.005, 0.995);
  Points u(100, 2);
  u << line, line;
  for (const FamilyInfo& family : families::all()) {
    if (family.parameters.empty()) continue;
    const FitResult result = fit_maximum_likelihood(family, u);
    EXPECT_NE(result.status, FitStatus::converged) << family.name;
    EXPECT_GT(result.tau, family.tau_range(2).highest - 0.001) << family.name;
    EXPECT_TRUE(std::isnan(result.standard_error[0])) << family.name;
  }
}

TEST(TauInversion, HasTheTauOfTheDataOrTheNearest) {
  for (const test::FamilyCase& test_case : test::family_cases({2, 3})) {
    if (!test_case.theta.empty() && !test_case.family->theta_from_tau) continue;
    const Points u = simulated(test_case, 500);
    const FitResult result = fit_tau_inversion(*test_case.family, u);
    const double tau = mean_kendall_tau(u);
    if (result.status == FitStatus::converged && !result.theta.empty()) {
      EXPECT_NEAR(result.tau, tau, 1e-13) << test_case.name();
    } else if (!result.theta.empty()) {
      EXPECT_FALSE(test_case.family->tau_range(test_case.dim).contains(tau)) << test_case.name();
      EXPECT_FALSE(result.message.empty());
    }
    EXPECT_TRUE(test_case.family->admits(test_case.dim, result.theta));
  }
}

/// The cells of a grid with the density of the case at the centres.
CellTable exact_cells(const test::FamilyCase& test_case, Index bins) {
  std::vector<Index> shape(static_cast<std::size_t>(test_case.dim), bins);
  CellTable cells = cell_table(Column::Ones(static_cast<Index>(std::pow(bins, test_case.dim))), shape);
  cells.mass = test_case.copula()->pdf(cells.u) * cells.margin;
  return cells;
}

TEST(LeastSquares, RecoversTheParametersFromExactCells) {
  constexpr double kRelative = 1e-6;
  for (const test::FamilyCase& test_case : test::family_cases({2, 3})) {
    const CellTable cells = exact_cells(test_case, test_case.dim == 2 ? 20 : 8);
    // A support smaller than the cube, with a density that may be unbounded at its edge, makes the sum a needle.
    if ((cells.mass == 0).any() && test_case.tau() < 0) continue;
    const FitResult result = fit_least_squares(*test_case.family, cells);
    EXPECT_NE(result.status, FitStatus::failed) << test_case.name() << result.message;
    for (std::size_t i = 0; i < result.theta.size(); ++i) {
      EXPECT_NEAR(result.theta[i], test_case.theta[i], kRelative * std::max(1.0, std::abs(test_case.theta[i])))
          << test_case.name() << " evaluations " << result.evaluations;
    }
    EXPECT_TRUE(std::isnan(result.aic) && std::isnan(result.bic));
  }
}

TEST(LeastSquares, IgnoresCellsOfWeightZero) {
  for (const test::FamilyCase& test_case : test::family_cases_near(0.4, {2})) {
    CellTable cells = exact_cells(test_case, 16);
    cells.weight = Column::Ones(cells.mass.size());
    for (Index cell = 0; cell < cells.mass.size(); cell += 3) {
      cells.weight[cell] = 0;
      cells.mass[cell] = 1;
    }
    const FitResult result = fit_least_squares(*test_case.family, cells);
    for (std::size_t i = 0; i < result.theta.size(); ++i) EXPECT_NEAR(result.theta[i], test_case.theta[i], 1e-5);
  }
}

TEST(LeastSquares, OfPointsIsNearTheirParameters) {
  // The density at the centre is not the mean over the cell: least squares is biased where the density has a peak in a
  // corner, by 0.18 at most here (Joe, d = 3, tau = 0.5).
  constexpr double kBias = 0.2;
  for (const test::FamilyCase& test_case : test::family_cases_near(0.4, {2, 3})) {
    const Points u = simulated(test_case, 20000);
    const FitResult result = fit(*test_case.family, FitMethod::least_squares, u);
    EXPECT_NEAR(result.tau, test_case.tau(), kBias) << test_case.name();
    const CellTable cells = count_cells(u, Column(), FitOptions().bins);
    EXPECT_LE(result.objective, squared_error(*test_case.copula(), cells, {}).value) << test_case.name();
    EXPECT_TRUE(std::isfinite(result.aic));
  }
}

TEST(Fit, RotatedFamiliesServeNegativeDependence) {
  for (const std::string name : {"clayton", "gumbel", "joe"}) {
    const FamilyInfo& base = families::find(name);
    const FamilyInfo own = rotated_family(base, Rotation("90")), other = rotated_family(base, Rotation("270")),
                     survival = rotated_family(base, Rotation("180"));
    const Theta theta = own.from_tau(2, -0.5);
    Rng rng(11);
    const Points u = own.make(2, theta)->sample(2000, rng);
    const std::vector<const FamilyInfo*> families = {&base, &survival, &other, &own, &families::find("frank")};
    const std::vector<FitResult> results = fit_all(families, FitMethod::maximum_likelihood, u);
    EXPECT_EQ(results.front().family, name + "@90");
    EXPECT_NEAR(results.front().theta[0], theta[0], kStandardErrors * results.front().standard_error[0]) << name;
    const FitResult by_tau = fit_tau_inversion(own, u);
    EXPECT_NEAR(by_tau.tau, -0.5, kStandardErrors * 0.667 / std::sqrt(2000.0)) << name;
  }
}

TEST(Fit, RotationsOfChosenCoordinatesAreFoundWithoutTau) {
  const FamilyInfo family = rotated_family(families::find("gumbel"), Rotation("u1+u3"));
  Rng rng(12);
  const Points u = family.make(4, {2})->sample(1000, rng);
  const FitResult result = fit_maximum_likelihood(family, u);
  EXPECT_EQ(result.status, FitStatus::converged) << result.message;
  EXPECT_NEAR(result.theta[0], 2, kStandardErrors * result.standard_error[0]);
  EXPECT_LT(result.standard_error[0], 0.1);
  EXPECT_THROW((void)fit_tau_inversion(family, u), std::invalid_argument);
  const FamilyInfo pairs = rotated_family(families::find("gumbel"), Rotation("90"));
  EXPECT_THROW((void)fit_maximum_likelihood(pairs, u), std::domain_error);
}

TEST(RhoInversion, HasTheRhoOfTheDataOrSaysTheRange) {
  Rng rng(9);
  const Points u = families::find("frank").make(3, {3.0})->sample(400, rng);
  const FitResult found = fit(families::find("gumbel"), FitMethod::rho_inversion, u);
  EXPECT_EQ(found.status, FitStatus::converged);
  EXPECT_NEAR(spearman_rho(*families::find("gumbel").make(2, found.theta)), mean_spearman_rho(u), 1e-9);
  EXPECT_TRUE(std::isfinite(found.log_likelihood));
  Points negative = u.leftCols(2);
  negative.col(1) = 1 - negative.col(1);
  const FitResult none = fit(families::find("gumbel"), FitMethod::rho_inversion, negative);
  EXPECT_EQ(none.status, FitStatus::failed);
  EXPECT_NE(none.message.find("gumbel: rho must be 0 or more in dimension 2, got -0.4"), std::string::npos)
      << none.message;
}

TEST(Fit, NoParametersNeedNoSearch) {
  for (const FamilyInfo& family : families::all()) {
    if (!family.parameters.empty()) continue;
    const Points u = uniforms(*std::make_unique<Rng>(1), 100, 3);
    for (const FitMethod method : {FitMethod::maximum_likelihood, FitMethod::least_squares, FitMethod::tau_inversion,
                                   FitMethod::rho_inversion}) {
      const FitResult result = fit(family, method, u);
      EXPECT_EQ(result.status, FitStatus::converged);
      EXPECT_EQ(result.theta, Theta{});
      EXPECT_EQ(result.aic, -2 * result.log_likelihood);
    }
  }
}

std::string refusal(const Points& u, const Column& weights = Column(), const FitOptions& options = {}) {
  try {
    (void)fit_maximum_likelihood(families::all().front(), u, weights, options);
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Fit, RefusesUnusableData) {
  const Points u = Points::Constant(3, 2, 0.5);
  EXPECT_EQ(refusal(Points(0, 2)), "fit_maximum_likelihood: u must have 2 or more rows, got 0");
  EXPECT_EQ(refusal(u.topRows(1)), "fit_maximum_likelihood: u must have 2 or more rows, got 1");
  EXPECT_EQ(refusal(u.leftCols(1)), "fit_maximum_likelihood: u must have 2 or more columns, got 1");
  for (const double bad : {0.0, 1.0, -0.5, std::nan("")}) {
    Points v = u;
    v(2, 1) = bad;
    EXPECT_EQ(refusal(v).substr(0, 63),
              "fit_maximum_likelihood: u must be in (0,1), got u(2,1) = " + refusal(v).substr(57, 6));
  }
  EXPECT_EQ(refusal(u, Column{{1, 0.5}}), "fit_maximum_likelihood: weights must have 3 rows, got 2");
  EXPECT_EQ(refusal(u, Column{{1, 0.5, -1}}),
            "fit_maximum_likelihood: weights must be finite and 0 or more, got weights(2,0) = -1");
  EXPECT_EQ(refusal(u, Column{{0, 0, 0}}), "fit_maximum_likelihood: all weights are zero");
  EXPECT_EQ(refusal(u, Column(), {.max_evaluations = 0}), "fit options: max_evaluations must be 1 or more");
}

TEST(Objective, IsTheSameInChunks) {
  const test::FamilyCase test_case = test::family_cases_near(0.5, {3}).back();
  const Points u = simulated(test_case, 1000);
  const CopulaPtr copula = test_case.copula();
  const double whole = log_likelihood(*copula, u, Column(), {.rows = 1000, .parallel = false}).value;
  const RowSum parts = log_likelihood(*copula, u, Column(), {.rows = 7, .parallel = true});
  EXPECT_NEAR(parts.value, whole, 1e-12 * std::abs(whole));
  EXPECT_EQ(parts.nonfinite, 0);
}

}  // namespace
}  // namespace sklar
