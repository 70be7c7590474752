#pragma once
/// Fitting the parameters of a family: weighted maximum likelihood (paper Eq. 16), weighted least squares on cell
/// masses (paper Eq. 17), inversion of Kendall's tau or Spearman's rho. The margins come first (pseudo_observations,
/// EmpiricalMarginal, cell_table), the dependence parameters second.

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "copula/family.hpp"
#include "copula/inference/cells.hpp"

namespace sklar {

/// See the functions fit_maximum_likelihood, fit_least_squares, ..
enum class FitMethod { maximum_likelihood, least_squares, tau_inversion, rho_inversion };

/// How a search ended.
enum class FitStatus {
  converged,
  at_bound,         ///< the best parameter is at an end of the domain, or of the range searched towards infinity
  max_evaluations,  ///< the best point seen within FitOptions::max_evaluations
  failed            ///< no parameter tried gives every row a finite density; message says why
};

[[nodiscard]] std::string_view to_text(FitMethod method);  ///< "ml", "ls", "tau", "rho"
[[nodiscard]] std::string_view to_text(FitStatus status);  ///< "converged", "at_bound", ...

/// How long and how to search.
struct FitOptions {
  double tolerance = 1e-7;      ///< of the search scale z = atanh(tau); its sampling error is about 0.7/sqrt(n)
  int max_evaluations = 300;    ///< of the objective over all rows
  Index start_rows = 2000;      ///< the search starts from a fixed subset of this many rows (cells: ten times as many)
  Index bins = 16;              ///< bins an axis of fit() by least squares, which counts the rows into bins^d cells
  bool standard_errors = true;  ///< they cost a few evaluations of the likelihood
  bool parallel = true;         ///< over chunks of rows; the result does not depend on it
};

/// Every number that a method does not give is NaN. Weights count as multiplicity: a row of weight 2 is two rows. Their
/// scale does not move theta; it scales log_likelihood and the information behind standard_error and aic.
struct FitResult {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string family;  ///< FamilyInfo::name
  FitMethod method = FitMethod::maximum_likelihood;
  Theta theta = {};    ///< the best seen, admissible in the dimension of the data
  double tau = kNone;  ///< FamilyInfo::tau at theta
  double objective =
      kNone;  ///< what was minimised: -log_likelihood, the sum of squares, |tau - tau of data|, the same of rho
  double log_likelihood = kNone;            ///< sum w_i log c(u_i; theta); -inf if nonfinite > 0
  double aic = kNone;                       ///< 2k - 2 log_likelihood
  double bic = kNone;                       ///< k log(sum w_i) - 2 log_likelihood
  std::vector<double> standard_error = {};  ///< one a parameter, from the observed information; see standard_errors
  FitStatus status = FitStatus::failed;
  int evaluations = 0;       ///< of the objective over all rows
  Index nonfinite = 0;       ///< rows of positive weight whose density at theta is 0 or not finite
  std::string message = {};  ///< empty if converged
};

/// Maximises sum w_i log c(u_i; theta) (paper Eq. 16; its unknown n is sum w_i). One parameter: from the inverse of
/// Kendall's tau, O(n d) an evaluation, about ten evaluations. Memory beside u and weights does not grow with n but for
/// one sum a chunk of 8192 rows: 1e7 rows of two columns take 1 to 2.5 s on one thread and less than 1 MB.
/// @param u        n x d strictly in (0,1), n >= 2, d >= 2. @param weights n values >= 0, or none for one each.
/// @return         standard_error is NaN at a bound and where the likelihood has no curvature.
/// @throws std::invalid_argument (shapes, all weights zero), std::domain_error naming the entry of u or weights.
[[nodiscard]] FitResult fit_maximum_likelihood(const FamilyInfo& family, const PointsRef& u,
                                               const ColumnRef& weights = Column(), const FitOptions& options = {});

/// theta with the (weighted) Kendall's tau of the data, the mean over pairs for d > 2. A tau outside the attainable
/// range gives the nearest end and status at_bound. A family without parameters has nothing to invert and converges.
/// @throws as fit_maximum_likelihood; std::invalid_argument also for a family without theta_from_tau.
[[nodiscard]] FitResult fit_tau_inversion(const FamilyInfo& family, const PointsRef& u,
                                          const ColumnRef& weights = Column(), const FitOptions& options = {});

/// theta with the (weighted) Spearman's rho of the data, the mean over pairs for d > 2, by theta_from_rho: about 1e6
/// values of the copula's cdf. A rho outside the attainable range is a failed result that names its end.
/// @throws as fit_maximum_likelihood; std::invalid_argument also for a family of several parameters.
[[nodiscard]] FitResult fit_rho_inversion(const FamilyInfo& family, const PointsRef& u,
                                          const ColumnRef& weights = Column(), const FitOptions& options = {});

/// Minimises sum w_i (b_i - c(u_i; theta) g_i)^2 over cells (paper Eq. 17). The sum may have several minima: a lattice
/// of parameters is compared on a subset of the cells first. log_likelihood is sum b_i log c(u_i; theta), of one
/// observation: the number of observations is unknown, so there is no aic, bic or standard error.
/// @throws std::invalid_argument, std::domain_error for a table that cell_table would not make.
[[nodiscard]] FitResult fit_least_squares(const FamilyInfo& family, const CellTable& cells,
                                          const FitOptions& options = {});

/// Any method on points. Least squares counts them into cells (count_cells) and adds the likelihood of the points.
/// Eq. 17 takes the density at a cell's centre for the mean over the cell: on points of a density with a peak in a
/// corner least squares is biased (16 bins, lower tail dependence 0.7, d = 2: tau 0.43 for 0.5), likelihood is not.
[[nodiscard]] FitResult fit(const FamilyInfo& family, FitMethod method, const PointsRef& u,
                            const ColumnRef& weights = Column(), const FitOptions& options = {});

}  // namespace sklar
