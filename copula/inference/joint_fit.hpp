#pragma once
/// Margins and copula from data: in two steps, margins first, or all parameters together by maximum likelihood.

#include <span>
#include <vector>

#include "copula/inference/dependence.hpp"
#include "copula/inference/fit.hpp"
#include "copula/inference/margin_fit.hpp"

namespace sklar {

/// fit_margin of every column. @param specs one a column of x.
/// @throws std::invalid_argument for another number of them; as fit_margin.
[[nodiscard]] std::vector<MarginFit> fit_margins(std::span<const MarginSpec> specs, const PointsRef& x,
                                                 const ColumnRef& weights = Column());

/// The data behind their margins, n x d: cdf of the margins, where empirical pseudo-observations of x itself.
/// @param margins of x and weights, one a column.
[[nodiscard]] Points uniforms_of(std::span<const MarginFit> margins, const PointsRef& x,
                                 const ColumnRef& weights = Column(), const RankOptions& options = {});

/// A copula with margins. The numbers of all of them together are NaN where a margin has no density.
struct JointFit {
  std::vector<MarginFit> margins = {};
  FitResult copula = {};
  double log_likelihood = FitResult::kNone;  ///< sum w_i log h(x_i), of margins and copula
  double aic = FitResult::kNone;             ///< of all parameters; a bandwidth is none
  double bic = FitResult::kNone;
  bool together = false;            ///< all parameters are those of fit_together
  Eigen::MatrixXd covariance = {};  ///< then that of the estimates in the coordinates of fit_together; else empty
};

/// The fit in two steps (inference functions for margins, Joe 2014, section 5.5): these margins, and a copula fitted to
/// uniforms_of them, whose standard errors take the margins as known. @param total_weight sum of the weights, or n.
[[nodiscard]] JointFit two_step_fit(std::vector<MarginFit> margins, FitResult copula, double total_weight);

/// Maximises the likelihood of margins and copula over all their parameters, from a fit in two steps on. Coordinates
/// are in units of the standard errors of that fit; standard errors are those of the joint observed information, by
/// second differences; NaN for parameters at a bound. JointFit::covariance, the inverse of that information, is of the
/// means of normal margins, the logarithms of other parameters of margins, and ParameterScale::z, in turn.
/// FitResult::objective is -log_likelihood of the whole, its evaluations are at most FitOptions::max_evaluations a
/// parameter; each costs the cdf and density of every margin at every row.
/// @param start    of x and weights. A copula that failed is returned as it is.
/// @throws std::invalid_argument unless every margin is parametric.
[[nodiscard]] JointFit fit_together(const FamilyInfo& family, const JointFit& start, const PointsRef& x,
                                    const ColumnRef& weights = Column(), const FitOptions& options = {});

}  // namespace sklar
