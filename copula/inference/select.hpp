#pragma once
/// Choosing among families.

#include <span>
#include <vector>

#include "copula/inference/fit.hpp"

namespace sklar {

/// Fits every family and orders the results: lowest AIC first, those without an AIC after them, failed ones last. A
/// family that throws (a method it does not offer, a dimension it does not have) is a failed result with the reason.
/// @throws as fit does for unusable data.
[[nodiscard]] std::vector<FitResult> fit_all(std::span<const FamilyInfo* const> families, FitMethod method,
                                             const PointsRef& u, const ColumnRef& weights = Column(),
                                             const FitOptions& options = {});

}  // namespace sklar
