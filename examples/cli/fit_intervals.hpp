#pragma once
/// Confidence intervals in what `copula fit` writes, only where --confidence asks for them.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "copula/inference/intervals.hpp"
#include "examples/cli/command.hpp"

namespace sklar::cli {

struct IntervalSettings {
  std::optional<double> confidence = {};
  IntervalOptions intervals = {};  ///< but for confidence and ranks
};

/// Adds --confidence, --interval and --replicates.
void add_interval_options(CLI::App& command, IntervalSettings& settings);

/// Of one fit. Precondition: settings.confidence. @param u as fitted. @param ranks whether u are pseudo-observations.
[[nodiscard]] ConfidenceIntervals intervals_of(const FamilyInfo& family, const FitResult& result, const PointsRef& u,
                                               bool ranks, const IntervalSettings& settings, std::uint64_t seed);

/// Further fields of a line of CSV, each with a comma before it.
[[nodiscard]] std::string interval_header();
[[nodiscard]] std::string interval_fields(const ConfidenceIntervals& intervals);

[[nodiscard]] nlohmann::ordered_json interval_json(const ConfidenceIntervals& intervals);

}  // namespace sklar::cli
