#pragma once
/// Confidence intervals for the parameters of a family, Kendall's tau and the parameters of margins.

#include <string>
#include <string_view>
#include <vector>

#include "copula/inference/bootstrap.hpp"
#include "copula/inference/joint_fit.hpp"

namespace sklar {

/// Where margins are estimated, as by ranks, all three allow for what that adds to the spread of the estimate.
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
  bool ranks = true;         ///< confidence_intervals: u are pseudo-observations, not points of known margins
  RankOptions ranking = {};  ///< joint_intervals: of empirical margins, as fitted
  BootstrapOptions bootstrap = {.replicates = 999};
  FitOptions fit = {};  ///< of the replicates
};

/// Of the parameters of one margin, in the order of parameter_names.
struct MarginIntervals {
  std::vector<Interval> parameters;
  std::vector<double> standard_error;
};

/// Every number that a method does not give is NaN.
struct ConfidenceIntervals {
  std::vector<Interval> theta;  ///< one a parameter
  Interval tau;
  std::vector<double> standard_error;         ///< of theta; bootstrap: the standard deviation of the estimates
  int failed = 0;                             ///< replicates that could not be fitted
  std::string message = {};                   ///< why there are none of theta, else empty
  std::vector<MarginIntervals> margins = {};  ///< joint_intervals but profile: one a margin
};

/// Of a copula alone. @param result of fitting the family to u; wald and profile: by maximum likelihood, converged,
/// else there are none.
/// @param u       n x d strictly in (0,1).
/// @param weights n whole numbers >= 0, counts of equal rows, or none for one each: how estimates spread under other
/// weights, as of a sample with unequal chances, the weights do not tell.
/// @throws std::invalid_argument for options out of range, for fewer replicates than the confidence needs, and as fit
/// does; std::domain_error for a weight.
[[nodiscard]] ConfidenceIntervals confidence_intervals(const FamilyInfo& family, const FitResult& result,
                                                       const PointsRef& u, const ColumnRef& weights = Column(),
                                                       const IntervalOptions& options = {});

/// Of a copula and its margins. All allow for what estimating the margins adds to the spread.
///   in two steps   wald and profile as of a copula alone, with the margins in likelihood_spread; of a margin by the
///                  sandwich of its own scores, wald alone.
///   fit_together   wald by JointFit::covariance, the inverse of the observed information of all parameters.
///   both           bootstrap by samples of the joint distribution, fitted in the same way.
/// The wald interval of a mean is mean +- q s, that of a positive parameter the same of its logarithm.
/// @param fit of x and weights; of no margins, x are points of known ones. @throws as confidence_intervals and
/// uniforms_of; std::invalid_argument for a kernel margin: its bandwidth shifts the estimates by more than they spread.
[[nodiscard]] ConfidenceIntervals joint_intervals(const FamilyInfo& family, const JointFit& fit, const PointsRef& x,
                                                  const ColumnRef& weights = Column(),
                                                  const IntervalOptions& options = {});

}  // namespace sklar
