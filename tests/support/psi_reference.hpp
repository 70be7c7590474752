#pragma once
/// The independent judge: every quantity of a copula from the textbook psi of FamilyInfo alone, differentiated
/// symbolically and evaluated in multiprecision, as wide as it takes for two widths to agree. Shares no formula with
/// families/.

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "copula/family.hpp"
#include "copula/symbolic/split_tape.hpp"
#include "tests/support/digits.hpp"

namespace sklar::test {

class PsiReference {
 public:
  /// @param theta admissible in the dimension of the questions asked.
  /// Every call throws std::runtime_error where no two widths agree.
  PsiReference(const FamilyInfo& family, Theta theta);

  /// log |psi^(k)(t)|.
  [[nodiscard]] Digits log_abs_dpsi(int k, double t) const;

  /// log c(u), all u_i in (0,1); -inf where the density is 0.
  [[nodiscard]] Digits log_density(std::span<const double> u) const;
  [[nodiscard]] Digits log_density(std::span<const Digits> u) const;

  /// log C(u).
  [[nodiscard]] Digits log_cdf(std::span<const double> u) const;

  /// Probability of the box between two corners, lower in [0,1)^d and upper in (0,1]^d.
  [[nodiscard]] Digits volume(std::span<const double> lower, std::span<const double> upper) const;
  [[nodiscard]] Digits volume(std::span<const Digits> lower, std::span<const Digits> upper) const;

  struct Conditional {
    Digits value;       ///< h = C(v | given)
    Digits complement;  ///< 1 - h
    Digits slope;       ///< dh/dv
  };
  /// Precondition: the density of the given values is not 0.
  [[nodiscard]] Conditional conditional(std::span<const double> given, const Digits& v) const;
  [[nodiscard]] Conditional conditional(std::span<const Digits> given, const Digits& v) const;

  struct Probability {
    Digits value, complement;
  };
  /// P(C(U) <= v) in dimension dim.
  [[nodiscard]] Probability kendall(int dim, double v) const;

  /// psi^-1(v) psi'(psi^-1(v)); Kendall's tau is 1 + 4 times its integral over (0,1).
  [[nodiscard]] Digits tau_integrand(double v) const;

 private:
  class Formulas;

  symbolic::SplitTape::Values<Digits> run(int which, const Digits& t) const;
  bool in_support(const Digits& t) const;

  /// psi^(order)(t), 0 beyond the support.
  Digits derivative(int order, const Digits& t) const;

  Digits log_abs_derivative(int order, const Digits& t) const;

  /// log t with log(-log psi(t)) = target, from a first guess.
  Digits log_inverse(const Digits& target, Digits guess) const;
  Digits inverse(const Digits& u) const;
  Digits sum_of_inverses(std::span<const Digits> u) const;

  Theta theta_;
  std::shared_ptr<Formulas> formulas_;
  mutable std::map<std::pair<int, long>, std::vector<Digits>> prepared_;  // by formula and bits
};

}  // namespace sklar::test
