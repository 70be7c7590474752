#include "copula/inference/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "copula/error.hpp"
#include "copula/inference/checks.hpp"
#include "copula/inference/dependence.hpp"
#include "copula/inference/fitter.hpp"
#include "copula/inference/likelihood_intervals.hpp"
#include "copula/inference/row_weights.hpp"

namespace sklar {
namespace {

constexpr double kNone = FitResult::kNone;

/// The order statistic (N + 1) p of sorted values. Precondition: it is between the first and the last.
double percentile(const std::vector<double>& sorted, double p) {
  const double position = p * static_cast<double>(sorted.size() + 1) - 1;
  const auto below = std::min(static_cast<std::size_t>(position), sorted.size() - 1);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Interval percentiles(std::vector<double> values, double confidence) {
  if (values.empty() || std::ranges::any_of(values, [](double x) { return std::isnan(x); })) return {kNone, kNone};
  std::ranges::sort(values);
  const double outside = 0.5 * (1 - confidence);
  return {percentile(values, outside), percentile(values, 1 - outside)};
}

double standard_deviation(const std::vector<double>& values) {
  const Eigen::Map<const Column> x(values.data(), static_cast<Index>(values.size()));
  return values.size() < 2 ? kNone : std::sqrt((x - x.mean()).square().sum() / static_cast<double>(x.size() - 1));
}

void require_replicates(std::size_t replicates, double confidence) {
  const double needed = std::ceil(2 / (1 - confidence) * (1 - 1e-12)) - 1;
  if (static_cast<double>(replicates) >= needed) return;
  throw std::invalid_argument("confidence_intervals: percentiles of confidence " + to_text(confidence) + " need " +
                              to_text(needed) + " fitted replicates or more, got " + std::to_string(replicates));
}

/// Fits a sample of the copula, behind its margins if there are any.
using Refit = std::function<JointFit(const Points& u)>;

/// The estimates of one sample.
struct Replicate {
  FitResult copula;
  std::vector<std::vector<double>> margins;
};

Replicate estimates_of(JointFit fit) {
  Replicate replicate{std::move(fit.copula), {}};
  for (MarginFit& margin : fit.margins) replicate.margins.push_back(std::move(margin.parameters));
  return replicate;
}

/// Fitted replicates, and the intervals that are percentiles of them.
ConfidenceIntervals by_bootstrap(const FamilyInfo& family, const JointFit& fit, Index rows, int dim, const Refit& refit,
                                 const IntervalOptions& options) {
  const FitResult& result = fit.copula;
  require_replicates(static_cast<std::size_t>(std::max(options.bootstrap.replicates, 0)), options.confidence);
  if (result.status == FitStatus::failed) return no_intervals(result, result.message);
  std::vector<Replicate> fits(static_cast<std::size_t>(options.bootstrap.replicates));
  for_each_replicate(*family.make(dim, result.theta), rows, options.bootstrap, [&](int replicate, const Points& drawn) {
    fits[static_cast<std::size_t>(replicate)] = estimates_of(refit(drawn));
  });
  std::erase_if(fits, [](const Replicate& one) { return one.copula.status == FitStatus::failed; });
  require_replicates(fits.size(), options.confidence);
  const auto over = [&fits](const auto& value) {
    std::vector<double> values(fits.size());
    std::transform(fits.begin(), fits.end(), values.begin(), value);
    return values;
  };
  ConfidenceIntervals intervals = no_intervals(result, "");
  intervals.failed = options.bootstrap.replicates - static_cast<int>(fits.size());
  for (std::size_t a = 0; a < result.theta.size(); ++a) {
    const std::vector<double> values = over([a](const Replicate& one) { return one.copula.theta[a]; });
    intervals.theta[a] = percentiles(values, options.confidence);
    intervals.standard_error[a] = standard_deviation(values);
  }
  intervals.tau = percentiles(over([](const Replicate& one) { return one.copula.tau; }), options.confidence);
  for (std::size_t i = 0; i < fit.margins.size(); ++i) {
    MarginIntervals& margin = intervals.margins.emplace_back();
    for (std::size_t a = 0; a < fit.margins[i].parameters.size(); ++a) {
      const std::vector<double> values = over([i, a](const Replicate& one) { return one.margins[i][a]; });
      margin.parameters.push_back(percentiles(values, options.confidence));
      margin.standard_error.push_back(standard_deviation(values));
    }
  }
  return intervals;
}

FitOptions of_replicates(const IntervalOptions& options) {
  FitOptions fit_options = options.fit;
  fit_options.standard_errors = false;
  return fit_options;
}

void require_confidence(double confidence) {
  if (confidence > 0 && confidence < 1) return;
  throw std::invalid_argument("confidence_intervals: confidence must be in (0,1), got " + to_text(confidence));
}

/// Points of the copula behind the margins; of ranks any will do.
Points behind(const std::vector<MarginFit>& margins, const Points& u) {
  Points x = u;
  for (Index i = 0; i < u.cols(); ++i) {
    const MarginFit& margin = margins[static_cast<std::size_t>(i)];
    if (is_parametric(margin.spec.kind)) x.col(i) = share(margin.margin)->quantile(u.col(i));
  }
  return x;
}

/// The same kind of fit to a sample of the copula.
JointFit refitted(const FamilyInfo& family, const JointFit& fit, const Points& u, const FitOptions& options) {
  if (fit.margins.empty()) return {.copula = sklar::fit(family, fit.copula.method, u, Column(), options)};
  const Points x = behind(fit.margins, u);
  std::vector<MarginSpec> specs;
  for (const MarginFit& margin : fit.margins) specs.push_back(margin.spec);
  std::vector<MarginFit> margins = fit_margins(specs, x);
  FitResult copula = sklar::fit(family, fit.copula.method, uniforms_of(margins, x), Column(), options);
  const JointFit start = two_step_fit(std::move(margins), std::move(copula), static_cast<double>(x.rows()));
  return fit.together ? fit_together(family, start, x, Column(), options) : start;
}

/// Of parameters whose coordinates, means and logarithms, have these variances.
MarginIntervals wald_margin(const MarginFit& margin, const Eigen::VectorXd& variances, double quantile) {
  MarginIntervals intervals;
  for (std::size_t a = 0; a < margin.parameters.size(); ++a) {
    const double value = margin.parameters[a], error = std::sqrt(variances[static_cast<Index>(a)]);
    const double reach = quantile * error;
    const bool location = is_location(margin.spec.kind, a);
    intervals.parameters.push_back(location ? Interval{value - reach, value + reach}
                                            : Interval{value * std::exp(-reach), value * std::exp(reach)});
    intervals.standard_error.push_back(location ? error : value * error);
  }
  return intervals;
}

/// wald or profile of a fit in two steps.
ConfidenceIntervals by_influence(const FamilyInfo& family, const JointFit& fit, const PointsRef& x,
                                 const ColumnRef& weights, const IntervalOptions& options) {
  std::vector<MarginInfluence> influences;
  for (const MarginFit& margin : fit.margins) {
    influences.push_back(margin_influence(margin, x.col(static_cast<Index>(influences.size())), weights));
  }
  const Points u = influences.empty() ? Points(x) : uniforms_of(fit.margins, x, weights, options.ranking);
  require_sample("joint_intervals", u, weights);
  const auto spread = [&](const ParameterScale& scale, const std::vector<double>& z) {
    return likelihood_spread(family, scale, z, u, weights, influences);
  };
  ConfidenceIntervals intervals = likelihood_intervals(family, fit.copula, u, weights, spread, options);
  if (options.method != IntervalMethod::wald) return intervals;
  const RowWeights rows(weights, x.rows());
  for (std::size_t i = 0; i < influences.size(); ++i) {
    const Eigen::VectorXd variances = rows.scatter(influences[i].influence).diagonal();
    intervals.margins.push_back(wald_margin(fit.margins[i], variances, normal_quantile(options.confidence)));
  }
  return intervals;
}

/// wald of a fit of all parameters together.
ConfidenceIntervals by_joint_information(const FamilyInfo& family, const JointFit& fit, const PointsRef& x,
                                         const ColumnRef& weights, const IntervalOptions& options) {
  if (options.method != IntervalMethod::wald) {
    return no_intervals(fit.copula, "a joint fit has wald and bootstrap intervals");
  }
  const auto spread = [&](const ParameterScale& scale, const std::vector<double>&) -> LikelihoodSpread {
    const auto k = static_cast<Index>(scale.size());
    const Eigen::MatrixXd of_copula = fit.covariance.bottomRightCorner(k, k);
    return {of_copula, of_copula};
  };
  const Points u = uniforms_of(fit.margins, x);
  ConfidenceIntervals intervals = likelihood_intervals(family, fit.copula, u, weights, spread, options);
  Index next = 0;
  for (const MarginFit& margin : fit.margins) {
    const auto count = static_cast<Index>(margin.parameters.size());
    const Eigen::VectorXd variances = fit.covariance.diagonal().segment(next, count);
    intervals.margins.push_back(wald_margin(margin, variances, normal_quantile(options.confidence)));
    next += count;
  }
  return intervals;
}

void require_counts(const ColumnRef& weights) {
  for (Index row = 0; row < weights.size(); ++row) {
    if (weights[row] == std::floor(weights[row])) continue;
    throw std::domain_error("confidence_intervals: weights must be whole numbers, counts of equal rows, got weights(" +
                            std::to_string(row) + ") = " + to_text(weights[row]) +
                            "; how estimates spread under others the weights do not tell");
  }
}

void require_margins(const JointFit& fit) {
  for (const MarginFit& margin : fit.margins) {
    if (margin.spec.kind != MarginKind::kernel) continue;
    throw std::invalid_argument(
        "joint_intervals: no intervals with kernel margins: the bandwidth shifts the estimates by more than they "
        "spread");
  }
  if (fit.together && fit.covariance.size() == 0) {
    throw std::invalid_argument("joint_intervals: a joint fit needs FitOptions::standard_errors");
  }
}

Index count_of(const ColumnRef& weights, Index rows) {
  return static_cast<Index>(total_weight(weights, rows));
}

}  // namespace

std::string_view to_text(IntervalMethod method) {
  switch (method) {
    case IntervalMethod::wald:
      return "wald";
    case IntervalMethod::profile:
      return "profile";
    case IntervalMethod::bootstrap:
      return "bootstrap";
  }
  return "";
}

ConfidenceIntervals confidence_intervals(const FamilyInfo& family, const FitResult& result, const PointsRef& u,
                                         const ColumnRef& weights, const IntervalOptions& options) {
  require_confidence(options.confidence);
  require_sample("confidence_intervals", u, weights);
  require_counts(weights);
  if (options.method == IntervalMethod::bootstrap) {
    const auto refit = [&](const Points& drawn) {
      const Points sample = options.ranks ? pseudo_observations(drawn) : drawn;
      return JointFit{.copula = fit(family, result.method, sample, Column(), of_replicates(options))};
    };
    const Index rows = count_of(weights, u.rows());
    return by_bootstrap(family, {.copula = result}, rows, static_cast<int>(u.cols()), refit, options);
  }
  const std::vector<MarginInfluence> margins(options.ranks ? static_cast<std::size_t>(u.cols()) : 0, {.ranks = true});
  const auto spread = [&](const ParameterScale& scale, const std::vector<double>& z) {
    return likelihood_spread(family, scale, z, u, weights, margins);
  };
  return likelihood_intervals(family, result, u, weights, spread, options);
}

ConfidenceIntervals joint_intervals(const FamilyInfo& family, const JointFit& fit, const PointsRef& x,
                                    const ColumnRef& weights, const IntervalOptions& options) {
  require_confidence(options.confidence);
  require_weights("joint_intervals", weights, x.rows());
  require_counts(weights);
  require_margins(fit);
  if (options.method == IntervalMethod::bootstrap) {
    const auto refit = [&](const Points& u) { return refitted(family, fit, u, of_replicates(options)); };
    return by_bootstrap(family, fit, count_of(weights, x.rows()), static_cast<int>(x.cols()), refit, options);
  }
  return fit.together ? by_joint_information(family, fit, x, weights, options)
                      : by_influence(family, fit, x, weights, options);
}

}  // namespace sklar
