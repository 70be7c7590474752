#include "copula/inference/select.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "copula/inference/checks.hpp"

namespace sklar {
namespace {

FitResult fit_or_reason(const FamilyInfo& family, FitMethod method, const PointsRef& u, const ColumnRef& weights,
                        const FitOptions& options) {
  try {
    return fit(family, method, u, weights, options);
  } catch (const std::exception& error) {
    return {.family = family.name, .method = method, .status = FitStatus::failed, .message = error.what()};
  }
}

bool precedes(const FitResult& a, const FitResult& b) {
  const auto rank = [](const FitResult& result) {
    return std::tuple(result.status == FitStatus::failed, std::isnan(result.aic));
  };
  if (rank(a) != rank(b)) return rank(a) < rank(b);
  return a.aic < b.aic;
}

}  // namespace

std::vector<FitResult> fit_all(std::span<const FamilyInfo* const> families, FitMethod method, const PointsRef& u,
                               const ColumnRef& weights, const FitOptions& options) {
  require_sample("fit_all", u, weights);
  std::vector<FitResult> results;
  for (const FamilyInfo* family : families) results.push_back(fit_or_reason(*family, method, u, weights, options));
  std::stable_sort(results.begin(), results.end(), precedes);
  return results;
}

}  // namespace sklar
