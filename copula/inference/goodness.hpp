#pragma once
/// Tests of goodness of fit: does a family describe the dependence in the data?
/// GRB: Genest, Remillard and Beaudoin (2009), "Goodness-of-fit tests for copulas: a review and a power study",
/// Insurance: Mathematics and Economics 44, 199.

#include <limits>
#include <string_view>

#include "copula/inference/bootstrap.hpp"
#include "copula/inference/fit.hpp"

namespace sklar {

/// S_n = sum_i (C_n(u_i) - C(u_i))^2, C_n(v) = #{j: u_j <= v in every coordinate} / n: the distance of the empirical
/// copula from C, S_n of GRB. Where C is right it stays bounded as n grows. O(n^2 d / 64) beside n values of C.
/// @param u n x d in [0,1], n >= 1, usually pseudo_observations.
/// @throws std::invalid_argument (shape), std::domain_error (u).
[[nodiscard]] double cramer_von_mises(const Copula& copula, const PointsRef& u);

/// S_n^(B) = n int (D_n(w) - w_1 .. w_d)^2 dw over the unit cube, D_n the empirical distribution of the Rosenblatt
/// transforms of u, which are independent and uniform where C is right: S_n^(B) of GRB, in closed form. It depends on
/// the order of the columns. O(n^2 d). @param u as for cramer_von_mises. @return NaN where a transform is not defined.
/// @throws as cramer_von_mises.
[[nodiscard]] double rosenblatt_distance(const Copula& copula, const PointsRef& u);

/// What measures the distance between data and a copula.
enum class GoodnessStatistic { cramer_von_mises, rosenblatt };

[[nodiscard]] std::string_view to_text(GoodnessStatistic statistic);  ///< "cvm", "rosenblatt"

/// The statistic and its bootstrap.
struct GoodnessOptions {
  GoodnessStatistic statistic = GoodnessStatistic::cramer_von_mises;
  FitMethod method = FitMethod::maximum_likelihood;  ///< of the data and of every replicate
  bool ranks = true;  ///< the data and every sample are replaced by their pseudo-observations
  BootstrapOptions bootstrap = {};
  FitOptions fit = {};
};

/// What is not known is NaN.
struct GoodnessResult {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  FitResult fit;
  double statistic = kNone;
  double p_value = kNone;
  double p_error = kNone;  ///< standard error of p_value as an estimate, from the number of replicates
  int replicates = 0;      ///< those that count
  int failed = 0;          ///< those left out: not fitted, or without a statistic
  Index tied = 0;          ///< values of the data that another one in their column equals
};

/// Fits the family and judges it by the parametric bootstrap (GRB, appendix): samples of the fitted copula are
/// ranked, fitted and measured as the data are, T*_1 .. T*_N, and
///   p = (1 + #{T*_k >= T}) / (N + 1)   (Davison and Hinkley 1997, sec. 4.2.3),
/// never 0; where the family is right, p is asymptotically uniform on its N + 1 values. The standard error is
/// sqrt(p (1 - p) / N). Ties do not occur in the samples: data with many have p-values that are too small or too large
/// (Kojadinovic 2017, Comput. Statist. Data Anal. 112, 24).
/// @param x n x d, n, d >= 2: finite values of any margins, or without ranks points of the copula in
/// (0,1). @return without statistic and p_value where the fit fails.
/// @throws std::invalid_argument, std::domain_error as fit does, and for replicates below 1.
[[nodiscard]] GoodnessResult test_goodness(const FamilyInfo& family, const PointsRef& x,
                                           const GoodnessOptions& options = {});

}  // namespace sklar
