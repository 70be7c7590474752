#include "copula/inference/intervals.hpp"

#include <algorithm>
#include <cmath>

#include "copula/error.hpp"
#include "copula/inference/checks.hpp"
#include "copula/inference/dependence.hpp"
#include "copula/inference/likelihood_intervals.hpp"

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

ConfidenceIntervals by_bootstrap(const FamilyInfo& family, const FitResult& result, const PointsRef& u,
                                 const IntervalOptions& options) {
  require_replicates(static_cast<std::size_t>(std::max(options.bootstrap.replicates, 0)), options.confidence);
  if (result.status == FitStatus::failed) return no_intervals(result, result.message);
  FitOptions fit_options = options.fit;
  fit_options.standard_errors = false;
  std::vector<FitResult> fits(static_cast<std::size_t>(options.bootstrap.replicates));
  for_each_replicate(*family.make(static_cast<int>(u.cols()), result.theta), u.rows(), options.bootstrap,
                     [&](int replicate, const Points& drawn) {
                       const Points sample = options.ranks ? pseudo_observations(drawn) : drawn;
                       fits[static_cast<std::size_t>(replicate)] =
                           fit(family, result.method, sample, Column(), fit_options);
                     });
  std::erase_if(fits, [](const FitResult& one) { return one.status == FitStatus::failed; });
  require_replicates(fits.size(), options.confidence);
  const auto over = [&fits](const auto& value) {
    std::vector<double> values(fits.size());
    std::transform(fits.begin(), fits.end(), values.begin(), value);
    return values;
  };
  ConfidenceIntervals intervals = no_intervals(result, "");
  intervals.failed = options.bootstrap.replicates - static_cast<int>(fits.size());
  for (std::size_t a = 0; a < result.theta.size(); ++a) {
    const std::vector<double> values = over([a](const FitResult& one) { return one.theta[a]; });
    intervals.theta[a] = percentiles(values, options.confidence);
    intervals.standard_error[a] = standard_deviation(values);
  }
  intervals.tau = percentiles(over([](const FitResult& one) { return one.tau; }), options.confidence);
  return intervals;
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
                                         const IntervalOptions& options) {
  if (!(options.confidence > 0 && options.confidence < 1)) {
    throw std::invalid_argument("confidence_intervals: confidence must be in (0,1), got " +
                                to_text(options.confidence));
  }
  require_sample("confidence_intervals", u, Column());
  if (options.method == IntervalMethod::bootstrap) return by_bootstrap(family, result, u, options);
  const auto spread = [&](const ParameterScale& scale, const std::vector<double>& z) {
    return likelihood_spread(family, scale, z, u, options.ranks);
  };
  return likelihood_intervals(family, result, u, spread, options);
}

}  // namespace sklar
