#pragma once
/// Intervals by the likelihood around its maximum; internal to the library's sources.

#include <functional>

#include "copula/inference/intervals.hpp"
#include "copula/inference/likelihood_spread.hpp"

namespace sklar {

/// The spread of the estimate at an interior maximum z.
using SpreadAt = std::function<LikelihoodSpread(const ParameterScale& scale, const std::vector<double>& z)>;

/// Standard deviations from the mean within which a normal variable is with this probability.
[[nodiscard]] double normal_quantile(double confidence);

/// NaN throughout, with a message.
[[nodiscard]] ConfidenceIntervals no_intervals(const FitResult& result, std::string message);

/// wald or profile. @param u, weights as fitted. @param spread called once if the fit has an interior maximum.
[[nodiscard]] ConfidenceIntervals likelihood_intervals(const FamilyInfo& family, const FitResult& result,
                                                       const PointsRef& u, const ColumnRef& weights,
                                                       const SpreadAt& spread, const IntervalOptions& options);

}  // namespace sklar
