#pragma once
/// Confidence intervals for the parameters of a family and Kendall's tau.

#include <string>
#include <string_view>
#include <vector>

#include "copula/inference/bootstrap.hpp"
#include "copula/inference/fit.hpp"

namespace sklar {

/// Where u are pseudo-observations, all three allow for what the ranks add to the spread of the estimate.
///   wald       z +- q s, z = atanh(tau) or another coordinate of ParameterScale, s of likelihood_spread, q the normal
///              quantile; cut at the ends of the domain. tau of several parameters: by the delta method on atanh(tau).
///   profile    where 2 (l_max - l_profile) <= q^2 f, f the variance of z over that from the observed information, 1
///              for known margins; its ends are exact to 1e-8 in z. tau: for one parameter.
///   bootstrap  percentiles of the estimates from samples of the fitted copula (Davison and Hinkley 1997, sec. 5.3.1):
///              order statistics (N + 1) p, in between linear.
enum class IntervalMethod { wald, profile, bootstrap };

[[nodiscard]] std::string_view to_text(IntervalMethod method);  ///< "wald", "profile", "bootstrap"

/// Level and kind of an interval.
struct IntervalOptions {
  IntervalMethod method = IntervalMethod::wald;
  double confidence = 0.95;  ///< in (0,1)
  bool ranks = true;         ///< u are pseudo-observations, not points of known margins
  BootstrapOptions bootstrap = {.replicates = 999};
  FitOptions fit = {};  ///< of the replicates
};

/// Every number that a method does not give is NaN.
struct ConfidenceIntervals {
  std::vector<Interval> theta;  ///< one a parameter
  Interval tau;
  std::vector<double> standard_error;  ///< of theta; bootstrap: the standard deviation of the estimates
  int failed = 0;                      ///< replicates that could not be fitted
  std::string message = {};            ///< why there are none, else empty
};

/// @param result of fitting the family to u; wald and profile: by maximum likelihood, converged, else there are none.
/// @param u      n x d strictly in (0,1), without weights.
/// @throws std::invalid_argument for options out of range, for fewer replicates than the confidence needs, and as fit
/// does.
[[nodiscard]] ConfidenceIntervals confidence_intervals(const FamilyInfo& family, const FitResult& result,
                                                       const PointsRef& u, const IntervalOptions& options = {});

}  // namespace sklar
