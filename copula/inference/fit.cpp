#include "copula/inference/fit.hpp"

#include <algorithm>
#include <cmath>

#include "copula/error.hpp"
#include "copula/inference/checks.hpp"
#include "copula/inference/dependence.hpp"
#include "copula/inference/fitter.hpp"
#include "copula/inference/score.hpp"
#include "copula/inference/spearman.hpp"

namespace sklar {
namespace {

/// What a row without a finite term adds to the objective, in log densities or in sums of squares without a model: far
/// above any finite term.
constexpr double kBrokenRow = 1e6;

/// Least squares compares its lattice on this many times more cells than likelihood has rows at its start.
constexpr Index kCellsPerStartRow = 2;

void require_cells(const CellTable& cells) {
  constexpr std::string_view kFunction = "fit_least_squares";
  const Index n = cells.u.rows();
  require_enough_rows(kFunction, "u", n, 2);
  require_rows(kFunction, "mass", cells.mass.rows(), n);
  require_rows(kFunction, "margin", cells.margin.rows(), n);
  require_finite(kFunction, "u", cells.u);
  require_unit_cube(kFunction, "u", cells.u);
  require_finite(kFunction, "mass", cells.mass);
  require_finite(kFunction, "margin", cells.margin);
  require_weights(kFunction, cells.weight, n);
  if ((cells.mass < 0).any() || !(cells.mass > 0).any() || (cells.margin < 0).any()) {
    throw std::invalid_argument("fit_least_squares: masses and margins must be 0 or more, not all masses 0");
  }
}

/// At most `most` rows of positive weight, rising: all, or evenly spread ones.
std::vector<Index> subset(const ColumnRef& weights, Index rows, Index most) {
  const bool weighted = weights.size() > 0;
  const Index n = weighted ? (weights > 0).count() : rows;
  std::vector<Index> ranks;  // among those of positive weight
  if (n <= most) {
    for (Index i = 0; i < n; ++i) ranks.push_back(i);
  } else {
    for (const double position : spread_positions(most)) {
      ranks.push_back(static_cast<Index>(position * static_cast<double>(n)));
    }
    std::sort(ranks.begin(), ranks.end());
  }
  if (!weighted) return ranks;
  std::vector<Index> chosen;
  Index rank = 0;
  for (Index row = 0; chosen.size() < ranks.size(); ++row) {
    if (!(weights[row] > 0)) continue;
    while (chosen.size() < ranks.size() && ranks[chosen.size()] == rank) chosen.push_back(row);
    ++rank;
  }
  return chosen;
}

Column pick(const ColumnRef& x, const std::vector<Index>& rows) {
  return x.size() == 0 ? Column() : Column(x(rows));
}

Evaluation likelihood_objective(const Copula& copula, const PointsRef& u, const ColumnRef& weights,
                                const Chunking& chunking) {
  const RowSum sum = log_likelihood(copula, u, weights, chunking);
  return {kBrokenRow * sum.nonfinite_weight - sum.value, sum.nonfinite};
}

Evaluation cell_objective(const Copula& copula, const CellTable& cells, const Chunking& chunking) {
  const RowSum sum = squared_error(copula, cells, chunking);
  if (sum.nonfinite == 0) return {sum.value, 0};
  const double without_model =
      cells.weight.size() == 0 ? cells.mass.square().sum() : (cells.weight * cells.mass.square()).sum();
  const double share = sum.nonfinite_weight / total_weight(cells.weight, cells.u.rows());
  return {sum.value + kBrokenRow * without_model * share, sum.nonfinite};
}

/// Mean tau of neighbouring columns: every pair of an exchangeable family has the same.
double neighbour_tau(const Points& u, const Column& weights) {
  double sum = 0;
  for (Index i = 0; i + 1 < u.cols(); ++i) sum += kendall_tau(u.col(i), u.col(i + 1), weights);
  return sum / static_cast<double>(u.cols() - 1);
}

std::vector<double> likelihood_start(const Fitter& fitter, const Points& u, const Column& weights) {
  const CopulaObjective objective = [&](const Copula& copula) {
    return likelihood_objective(copula, u, weights, fitter.chunking());
  };
  const double tau = fitter.scale().by_tau() && u.rows() > 1 ? neighbour_tau(u, weights) : FitResult::kNone;
  if (std::isfinite(tau)) {
    std::vector<double> z = fitter.scale().at_tau(tau);
    if (objective(*fitter.copula(fitter.scale().theta(z))).nonfinite == 0) return z;
  }
  return fitter.best_of_lattice(objective);
}

}  // namespace

std::string_view to_text(FitMethod method) {
  switch (method) {
    case FitMethod::maximum_likelihood:
      return "ml";
    case FitMethod::least_squares:
      return "ls";
    case FitMethod::tau_inversion:
      return "tau";
    case FitMethod::rho_inversion:
      return "rho";
  }
  return "";
}

std::string_view to_text(FitStatus status) {
  switch (status) {
    case FitStatus::converged:
      return "converged";
    case FitStatus::at_bound:
      return "at_bound";
    case FitStatus::max_evaluations:
      return "max_evaluations";
    case FitStatus::failed:
      return "failed";
  }
  return "";
}

FitResult fit_maximum_likelihood(const FamilyInfo& family, const PointsRef& u, const ColumnRef& weights,
                                 const FitOptions& options) {
  require_sample("fit_maximum_likelihood", u, weights);
  Fitter fitter(family, FitMethod::maximum_likelihood, static_cast<int>(u.cols()), options);
  const std::vector<Index> rows = subset(weights, u.rows(), options.start_rows);
  const std::vector<double> start = likelihood_start(fitter, u(rows, Eigen::all), pick(weights, rows));
  // About two sampling errors of the start.
  const double step = std::min(1.5 / std::sqrt(static_cast<double>(rows.size())), fitter.scale().spacing());
  const auto objective = [&](const Copula& copula) {
    return likelihood_objective(copula, u, weights, fitter.chunking());
  };
  const double total = total_weight(weights, u.rows());
  if (fitter.scale().by_tau()) {
    fitter.search(objective, start, step);
    if (options.standard_errors) fitter.add_standard_error(objective, total);
  } else {
    const SampleScore score(family, u, weights, fitter.chunking());
    fitter.search(objective, start, fitter.scale().spacing(), score.symbolic() ? Score(std::cref(score)) : Score());
    if (options.standard_errors) fitter.add_standard_errors(std::cref(score));
  }
  FitResult& result = fitter.result();
  // 0 - x, so that a likelihood of 0 has no sign.
  fitter.set_likelihood(result.nonfinite == 0 ? 0 - result.objective : -std::numeric_limits<double>::infinity(), total);
  result.objective = 0 - result.log_likelihood;
  return result;
}

FitResult fit_tau_inversion(const FamilyInfo& family, const PointsRef& u, const ColumnRef& weights,
                            const FitOptions& options) {
  require_sample("fit_tau_inversion", u, weights);
  const int dim = static_cast<int>(u.cols());
  Fitter fitter(family, FitMethod::tau_inversion, dim, options);
  if (!family.parameters.empty() && !fitter.scale().by_tau()) {
    throw std::invalid_argument(family.name + ": has no inverse of Kendall's tau; choose another method");
  }
  const double tau = mean_kendall_tau(u, weights);
  FitResult& result = fitter.result();
  if (std::isnan(tau)) {
    result.message = "Kendall's tau of the data is not defined: a column is constant";
    return result;
  }
  fitter.set_theta(family.parameters.empty() ? Theta{} : fitter.scale().theta_at_tau(tau));
  result.status = FitStatus::converged;
  result.objective = std::abs(result.tau - tau);
  if (!family.parameters.empty()) {
    const Interval range = family.tau_range(dim);
    if (!range.contains(tau) || std::abs(tau) > ParameterScale::kLargestTau) {
      result.status = FitStatus::at_bound;
      result.message = "tau = " + to_text(tau) + " of the data is outside " + range.to_text();
    }
  }
  fitter.add_likelihood(u, weights);
  return result;
}

FitResult fit_rho_inversion(const FamilyInfo& family, const PointsRef& u, const ColumnRef& weights,
                            const FitOptions& options) {
  require_sample("fit_rho_inversion", u, weights);
  const int dim = static_cast<int>(u.cols());
  Fitter fitter(family, FitMethod::rho_inversion, dim, options);
  const double rho = mean_spearman_rho(u, weights);
  FitResult& result = fitter.result();
  if (std::isnan(rho)) {
    result.message = "Spearman's rho of the data is not defined: a column is constant";
    return result;
  }
  try {
    fitter.set_theta(family.parameters.empty() ? Theta{} : theta_from_rho(family, dim, rho));
  } catch (const std::domain_error& error) {
    result.message = error.what();
    return result;
  }
  result.status = FitStatus::converged;
  result.objective = std::abs(spearman_rho(*family.make(2, result.theta)) - rho);
  fitter.add_likelihood(u, weights);
  return result;
}

FitResult fit_least_squares(const FamilyInfo& family, const CellTable& cells, const FitOptions& options) {
  require_cells(cells);
  Fitter fitter(family, FitMethod::least_squares, static_cast<int>(cells.u.cols()), options);
  const CellTable some = sample_cells(cells, kCellsPerStartRow * options.start_rows);
  const std::vector<double> start =
      fitter.best_of_lattice([&](const Copula& copula) { return cell_objective(copula, some, fitter.chunking()); });
  fitter.search([&](const Copula& copula) { return cell_objective(copula, cells, fitter.chunking()); }, start,
                0.5 * fitter.scale().spacing());
  FitResult& result = fitter.result();
  const CopulaPtr copula = fitter.copula(result.theta);
  result.log_likelihood = log_likelihood(*copula, cells.u, cells.mass, fitter.chunking()).or_nothing();
  return result;
}

FitResult fit(const FamilyInfo& family, FitMethod method, const PointsRef& u, const ColumnRef& weights,
              const FitOptions& options) {
  if (method == FitMethod::maximum_likelihood) return fit_maximum_likelihood(family, u, weights, options);
  if (method == FitMethod::tau_inversion) return fit_tau_inversion(family, u, weights, options);
  if (method == FitMethod::rho_inversion) return fit_rho_inversion(family, u, weights, options);
  require_sample("fit_least_squares", u, weights);
  const FitResult by_cells = fit_least_squares(family, count_cells(u, weights, options.bins), options);
  Fitter fitter(family, FitMethod::least_squares, static_cast<int>(u.cols()), options);
  fitter.result() = by_cells;
  fitter.add_likelihood(u, weights);
  return fitter.result();
}

}  // namespace sklar
