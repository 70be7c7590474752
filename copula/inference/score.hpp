#pragma once
/// The derivative of the log likelihood of a sample by the parameters of a family.

#include <functional>

#include "copula/inference/objective.hpp"
#include "copula/symbolic/log_density_gradient.hpp"

namespace sklar {

/// sum w_i d log c(u_i; theta) / d theta. Symbolic where the family has a generator and the dimension is at most
/// symbolic::kMaxDimension, else by central differences of the log likelihood (error about 1e-10 of it).
/// Keeps references to the family, u and weights.
class SampleScore {
 public:
  SampleScore(const FamilyInfo& family, const PointsRef& u, const ColumnRef& weights, const Chunking& chunking);

  [[nodiscard]] bool symbolic() const noexcept { return gradient_.has_value(); }

  /// @param theta inside the domain. @return NaN where a row of positive weight has no derivative.
  [[nodiscard]] std::vector<double> operator()(const Theta& theta) const;

 private:
  [[nodiscard]] std::vector<double> by_differences(const Theta& theta) const;

  const FamilyInfo& family_;
  PointsRef u_;
  ColumnRef weights_;
  Chunking chunking_;
  std::optional<symbolic::LogDensityGradient> gradient_;
};

}  // namespace sklar
