#include "examples/cli/fit_intervals.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "examples/cli/material.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

std::vector<double> lowest_ends(const ConfidenceIntervals& intervals) {
  std::vector<double> ends;
  for (const Interval& theta : intervals.theta) ends.push_back(theta.lowest);
  return ends;
}

std::vector<double> highest_ends(const ConfidenceIntervals& intervals) {
  std::vector<double> ends;
  for (const Interval& theta : intervals.theta) ends.push_back(theta.highest);
  return ends;
}

}  // namespace

void add_interval_options(CLI::App& command, IntervalSettings& settings) {
  auto* confidence = command.add_option("--confidence", settings.confidence,
                                        "adds confidence intervals of theta and tau, in (0,1) as in 0.95");
  const std::map<std::string, IntervalMethod> methods = {
      {"wald", IntervalMethod::wald}, {"profile", IntervalMethod::profile}, {"bootstrap", IntervalMethod::bootstrap}};
  command
      .add_option("--interval", settings.intervals.method,
                  "by the standard error of atanh(tau), the profile likelihood, or percentiles of the bootstrap")
      ->transform(CLI::CheckedTransformer(methods))
      ->default_str("wald")
      ->needs(confidence);
  command.add_option("--replicates", settings.intervals.bootstrap.replicates, "samples of the bootstrap")
      ->capture_default_str()
      ->needs(confidence);
}

ConfidenceIntervals intervals_of(const FamilyInfo& family, const FitResult& result, const PointsRef& u, bool ranks,
                                 const IntervalSettings& settings, std::uint64_t seed) {
  IntervalOptions options = settings.intervals;
  options.confidence = *settings.confidence;
  options.ranks = ranks;
  options.bootstrap.seed = seed;
  if (options.method == IntervalMethod::bootstrap) options.bootstrap.progress = progress_bar(result.family);
  return confidence_intervals(family, result, u, options);
}

std::string interval_header() {
  return ",theta_low,theta_high,tau_low,tau_high,interval_se,interval_message";
}

std::string interval_fields(const ConfidenceIntervals& intervals) {
  return ',' + digits(lowest_ends(intervals)) + ',' + digits(highest_ends(intervals)) + ',' +
         digits(intervals.tau.lowest) + ',' + digits(intervals.tau.highest) + ',' + digits(intervals.standard_error) +
         ',' + csv_field(intervals.message);
}

nlohmann::ordered_json interval_json(const ConfidenceIntervals& intervals) {
  return {{"theta_low", json_numbers(lowest_ends(intervals))},
          {"theta_high", json_numbers(highest_ends(intervals))},
          {"tau_low", json_number(intervals.tau.lowest)},
          {"tau_high", json_number(intervals.tau.highest)},
          {"se", json_numbers(intervals.standard_error)},
          {"failed", intervals.failed},
          {"message", intervals.message}};
}

}  // namespace sklar::cli
