#pragma once
/// The derivative of a log density by the parameters of its generator.

#include "copula/family.hpp"
#include "copula/symbolic/generator_formula.hpp"

namespace sklar::symbolic {

/// d log c(u; theta) / d theta of C(u) = psi(sum psi^-1(u_i)), or of such a copula rotated. With L_k = log|psi^(k)|,
/// t_i = psi^-1(u_i), t = sum t_i and dt_i/dtheta = -(d L_0/d theta) / (d L_0/d t) at t_i, from psi(t_i(theta); theta)
/// = u_i:
///   d log c / d theta = d L_d/d theta (t) + d L_d/d t (t) sum dt_i/dtheta
///                       - sum ( d L_1/d theta (t_i) + d L_1/d t (t_i) dt_i/dtheta ).
/// Safe to share between threads.
class LogDensityGradient {
 public:
  /// @param family its psi, parameter names and rotation. @param dim 2 to kMaxDimension. @throws std::invalid_argument
  /// otherwise.
  LogDensityGradient(const FamilyInfo& family, int dim);

  /// @param u n x dim in (0,1). @param theta where psi is defined: not where it is a limit, as Frank's theta = 0.
  /// @return n x theta.size(), each entry within 1e-10 of the larger of 1 and its size; NaN where no number type
  /// resolves it, as on the boundary of the cube or the support. @throws std::invalid_argument (columns, parameters).
  [[nodiscard]] Points operator()(const Theta& theta, const PointsRef& u) const;

 private:
  std::shared_ptr<const GeneratorFormula> psi_;
  SplitTape at_sum_;      ///< of t: the derivatives of L_d by t, then by each parameter
  SplitTape at_margins_;  ///< of t_i: those of L_1, then those of L_0
  int dim_;
  Reflection reflection_;
};

}  // namespace sklar::symbolic
