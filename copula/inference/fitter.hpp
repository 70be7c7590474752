#pragma once
/// The search common to the methods of fit.hpp; internal to them.

#include <functional>
#include <string>
#include <vector>

#include "copula/inference/fit.hpp"
#include "copula/inference/information.hpp"
#include "copula/inference/minimise.hpp"
#include "copula/inference/objective.hpp"
#include "copula/inference/parameter_scale.hpp"

namespace sklar {

/// What is minimised, as a function of the copula.
using CopulaObjective = std::function<Evaluation(const Copula&)>;

/// Sum of the weights; no weights means one each.
[[nodiscard]] double total_weight(const ColumnRef& weights, Index rows);

/// Searches the parameters of one family in one dimension and writes down what it finds. Keeps a reference to the
/// family.
class Fitter {
 public:
  /// @throws std::invalid_argument for options out of range.
  Fitter(const FamilyInfo& family, FitMethod method, int dim, const FitOptions& options);

  [[nodiscard]] const ParameterScale& scale() const { return scale_; }
  [[nodiscard]] Chunking chunking() const { return {.parallel = options_.parallel}; }
  [[nodiscard]] FitResult& result() { return result_; }

  /// Precondition: theta admissible.
  [[nodiscard]] CopulaPtr copula(const Theta& theta) const { return family_.make_unchecked(dim_, theta); }

  /// The best of ParameterScale::lattice(); for no parameters the empty z.
  [[nodiscard]] std::vector<double> best_of_lattice(const CopulaObjective& objective) const;

  /// Minimises from start and records parameters, objective, status, evaluations and message.
  /// @param score of the sample, where -objective is its log likelihood and there are several parameters.
  void search(const CopulaObjective& objective, const std::vector<double>& start, double step, const Score& score = {});

  void set_theta(Theta theta);

  /// Records the likelihood at the parameters found and the criteria that follow from it.
  void add_likelihood(const PointsRef& u, const ColumnRef& weights);
  void set_likelihood(double log_likelihood, double total_weight);

  /// Records the standard error of a converged search for the maximum of the likelihood in one parameter, from second
  /// differences of its negative logarithm. Precondition: scale().by_tau().
  void add_standard_error(const CopulaObjective& objective, double total_weight);

  /// Records the standard errors of a converged search for the maximum of the likelihood.
  void add_standard_errors(const Score& score);

 private:
  [[nodiscard]] std::vector<double> best_of_lattice(const Objective& objective) const;
  void judge(const Minimum& minimum);
  void fail(std::string message);
  [[nodiscard]] std::vector<double> theta_steps(double z_step) const;

  const FamilyInfo& family_;
  int dim_;
  FitOptions options_;
  ParameterScale scale_;
  FitResult result_;
  std::vector<double> z_;
};

}  // namespace sklar
