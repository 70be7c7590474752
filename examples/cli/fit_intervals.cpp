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
  auto* confidence =
      command.add_option("--confidence", settings.confidence,
                         "adds confidence intervals of theta, tau and, with --json, margins, in (0,1) as in 0.95");
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

ConfidenceIntervals intervals_of(const FamilyInfo& family, const JointFit& fit, const Sample& sample,
                                 const IntervalSettings& settings, const RankOptions& ranking) {
  IntervalOptions options = settings.intervals;
  options.confidence = *settings.confidence;
  options.ranking = ranking;
  options.bootstrap.seed = ranking.seed;
  if (options.method == IntervalMethod::bootstrap) options.bootstrap.progress = progress_bar(family.name);
  return joint_intervals(family, fit, sample.x, sample.weights, options);
}

std::string interval_header() {
  return ",theta_low,theta_high,tau_low,tau_high,interval_se,interval_message";
}

std::string interval_fields(const ConfidenceIntervals& intervals) {
  return ',' + digits(lowest_ends(intervals)) + ',' + digits(highest_ends(intervals)) + ',' +
         digits(intervals.tau.lowest) + ',' + digits(intervals.tau.highest) + ',' + digits(intervals.standard_error) +
         ',' + csv_field(intervals.message);
}

nlohmann::ordered_json interval_json(const ConfidenceIntervals& intervals, const JointFit& fit,
                                     const std::vector<std::string>& columns) {
  nlohmann::ordered_json json{{"theta_low", json_numbers(lowest_ends(intervals))},
                              {"theta_high", json_numbers(highest_ends(intervals))},
                              {"tau_low", json_number(intervals.tau.lowest)},
                              {"tau_high", json_number(intervals.tau.highest)},
                              {"se", json_numbers(intervals.standard_error)},
                              {"failed", intervals.failed},
                              {"message", intervals.message}};
  for (std::size_t i = 0; i < intervals.margins.size(); ++i) {
    const auto names = parameter_names(fit.margins[i].spec.kind);
    const MarginIntervals& margin = intervals.margins[i];
    if (names.empty()) continue;
    nlohmann::ordered_json entry{{"column", columns[i]}};
    for (std::size_t a = 0; a < names.size(); ++a) {
      const std::string name(names[a]);
      entry["low"][name] = json_number(margin.parameters[a].lowest);
      entry["high"][name] = json_number(margin.parameters[a].highest);
      entry["se"][name] = json_number(margin.standard_error[a]);
    }
    json["margins"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace sklar::cli
