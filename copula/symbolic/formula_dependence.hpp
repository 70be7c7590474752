#pragma once
/// Kendall's tau and tail dependence of a generator, from psi alone.

#include <functional>
#include <optional>

#include "copula/family.hpp"
#include "copula/symbolic/symbolic_generator.hpp"

namespace sklar::symbolic {

/// tau = 1 + 4 int_0^1 t psi'(t) du at psi(t) = u, absolute error about 1e-11, 0 if below that; NaN where psi is not
/// resolved.
/// Nelsen (2006), corollary 5.1.4.
[[nodiscard]] double kendall_tau(const SymbolicGenerator& generator);

/// lim psi(2t)/psi(t) for t to infinity, and 2 - lim (1 - psi(2t)) / (1 - psi(t)) for t to 0, each at the most extreme
/// t that is resolved, up to 2^(2^40); below 1e-9 they are 0. Nelsen (2006), corollary 5.4.3.
[[nodiscard]] TailDependence tail_dependence(const SymbolicGenerator& generator);

/// tau as a function of one parameter, from end to end of its domain.
class TauScale {
 public:
  using Tau = std::function<double(double theta)>;

  /// @param tau may give NaN where theta is too close to an end.
  TauScale(Interval domain, Tau tau);

  /// Whether tau only rises or only falls.
  [[nodiscard]] bool monotone() const { return monotone_; }

  /// tau at theta; at an end outside the domain the limit, to 9 decimals.
  [[nodiscard]] double tau(double theta) const;

  /// The theta with this tau, else the one with the nearest. Precondition: monotone().
  [[nodiscard]] double theta(double tau) const;

 private:
  [[nodiscard]] double theta_at(double x) const;

  Interval domain_;
  Tau tau_;
  std::vector<double> x_, at_x_;  ///< lattice on the scale of theta_at, and tau there
  bool monotone_ = false;
};

}  // namespace sklar::symbolic
