#pragma once
/// The likelihood of rows that a fit has not seen: one part held out, or each of several in turn (cross-validation).

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "copula/inference/fit.hpp"
#include "copula/inference/margin_fit.hpp"

namespace sklar {

/// How the rows are divided.
struct HeldOutOptions {
  int folds = 5;           ///< equal parts of the rows, 2 to n, drawn without regard to weights
  bool every_fold = true;  ///< each is held out in turn; else one of them alone
  bool together = false;   ///< margins and copula are fitted by fit_together, else in two steps
  std::uint64_t seed = 1;  ///< of the parts; the result does not depend on the number of threads
};

/// The log likelihood of held-out rows by weight: of margins and copula, of the copula alone where a margin is
/// empirical or none is given.
struct HeldOut {
  double mean = FitResult::kNone;            ///< sum w_i l_i / sum w_i; -inf where a row has no finite log density
  double standard_error = FitResult::kNone;  ///< of the mean: sqrt(sum w_i (l_i - mean)^2 / (N - 1) / N), N = sum w_i
  std::string message{};                     ///< why there is no mean
};

/// Fits margins and copula anew to the rows outside each part and evaluates them on the part. Ranks are those of the
/// training rows alone: a held-out value becomes EmpiricalMarginal::pseudo_observation of its column's training values,
/// which is strictly inside (0,1).
/// @param specs    one a column, or none for x in (0,1) already. @param weights n frequencies, or none for one each:
/// the k rows behind a weight k are never parted.
/// @return one a family, in their order; a family that fails on a part has no mean.
/// @throws std::invalid_argument for options out of range, else as fit_margins, and as fit does for unusable data.
[[nodiscard]] std::vector<HeldOut> held_out_likelihood(std::span<const FamilyInfo* const> families, FitMethod method,
                                                       std::span<const MarginSpec> specs, const PointsRef& x,
                                                       const ColumnRef& weights = Column(),
                                                       const HeldOutOptions& options = {});

}  // namespace sklar
