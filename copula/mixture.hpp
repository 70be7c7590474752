#pragma once
/// Finite mixtures of copulas.

#include <vector>

#include "copula/copula.hpp"

namespace sklar {

/// C(u) = sum_i w_i C_i(u). Conditionals mix those of the components by their shares w_i c_i(given) in the density of
/// the given coordinates; where all these densities are 0, or several infinite, by the weights (of those) alone. No sum
/// cancels: relative errors of probabilities are those of the components and of their densities of the given part,
/// 1e-13 (1 + |log c|) or less; of the inverse 1e-12 times the condition of the conditional there. Sampling inverts
/// conditionals: some ten evaluations of every component a coordinate. The routes of sample_by draw a component first,
/// and take no longer than it does.
class Mixture final : public Copula {
 public:
  /// @param components one or more, none null, of the same dimension. @param weights one a component, > 0, with sum 1
  /// (to 1e-12; divided by it). @throws std::invalid_argument (numbers, dimensions), std::domain_error
  /// (weights).
  Mixture(std::vector<CopulaPtr> components, std::vector<double> weights);

  /// What the constructor asks of the weights.
  static void require_weights(const std::vector<double>& weights, std::size_t components);

  [[nodiscard]] bool has_frailty() const override;

  [[nodiscard]] const std::vector<CopulaPtr>& components() const noexcept { return components_; }
  [[nodiscard]] const std::vector<double>& weights() const noexcept { return weights_; }  ///< as given

 private:
  class Conditional;
  class Exact;
  using LogQuantity = void (Copula::*)(const PointsRef&, const Reflection&, ColumnOut) const;

  void log_pdf_into(const PointsRef& u, const Reflection& reflection, ColumnOut out) const override;
  void log_cdf_into(const PointsRef& u, const Reflection& reflection, ColumnOut out) const override;
  void conditional_into(const PointsRef& u, const Reflection& reflection, Tail tail, ColumnOut out) const override;
  void conditional_inverse_into(const PointsRef& u, const Reflection& reflection, Tail tail,
                                ColumnOut out) const override;
  [[nodiscard]] BigFloat exact_row(Quantity quantity, std::span<const BigFloat> u, const Reflection& reflection,
                                   int digits) const override;
  void draw(Route route, const Reflection& reflection, Rng& rng, std::span<double> u) const override;

  void log_mix(LogQuantity quantity, const PointsRef& u, const Reflection& reflection, ColumnOut out) const;
  [[nodiscard]] Points shares(const PointsRef& given, const Reflection& reflection) const;

  std::vector<CopulaPtr> components_;
  std::vector<double> weights_;  ///< as given
  double total_weight_;
};

}  // namespace sklar
