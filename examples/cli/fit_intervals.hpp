#pragma once
/// Confidence intervals in what `copula fit` writes, only where --confidence asks for them.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "copula/inference/intervals.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/copula_data.hpp"

namespace sklar::cli {

struct IntervalSettings {
  std::optional<double> confidence = {};
  IntervalOptions intervals = {};  ///< but for confidence, ranking and the seed
};

/// Adds --confidence, --interval and --replicates.
void add_interval_options(CLI::App& command, IntervalSettings& settings);

/// Of one fit to a sample. Precondition: settings.confidence. @param ranking of the margins, with the seed of the
/// command.
[[nodiscard]] ConfidenceIntervals intervals_of(const FamilyInfo& family, const JointFit& fit, const Sample& sample,
                                               const IntervalSettings& settings, const RankOptions& ranking);

/// Further fields of a line of CSV, each with a comma before it.
[[nodiscard]] std::string interval_header();
[[nodiscard]] std::string interval_fields(const ConfidenceIntervals& intervals);

/// @param fit whose margins they are of. @param columns names.
[[nodiscard]] nlohmann::ordered_json interval_json(const ConfidenceIntervals& intervals, const JointFit& fit,
                                                   const std::vector<std::string>& columns);

}  // namespace sklar::cli
