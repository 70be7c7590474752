#pragma once
/// Rotated and survival copulas.

#include <vector>

#include "copula/copula.hpp"

namespace sklar {

/// The copula of U with some coordinates replaced by 1 - U_i: with all of them the survival copula, in dimension 2 with
/// one or both the rotations by 90, 180 and 270 degrees. Nelsen (2006), sec. 2.6 and exercise 2.6. 1 - u is taken to
/// all its digits, so that every quantity is as exact near 0 and 1 as that of the base. log_cdf and cdf of an
/// Archimedean base take 2^m values of its cdf, m reflected coordinates, and throw std::domain_error for m > 20.
class Rotated final : public Copula {
 public:
  /// @param base not null. @param reflected one entry a coordinate: whether it is replaced.
  /// @throws std::invalid_argument for another number of entries or no base.
  Rotated(CopulaPtr base, std::vector<bool> reflected);

  [[nodiscard]] bool has_frailty() const override { return base_->has_frailty(); }

  [[nodiscard]] const CopulaPtr& base() const noexcept { return base_; }
  [[nodiscard]] bool reflects(int coordinate) const { return reflection_[static_cast<std::size_t>(coordinate)]; }

 private:
  void log_pdf_into(const PointsRef& u, const Reflection& reflection, ColumnOut out) const override;
  void log_cdf_into(const PointsRef& u, const Reflection& reflection, ColumnOut out) const override;
  void conditional_into(const PointsRef& u, const Reflection& reflection, Tail tail, ColumnOut out) const override;
  void conditional_inverse_into(const PointsRef& u, const Reflection& reflection, Tail tail,
                                ColumnOut out) const override;

  [[nodiscard]] BigFloat exact_row(Quantity quantity, std::span<const BigFloat> u, const Reflection& reflection,
                                   int digits) const override;
  void draw(Route route, const Reflection& reflection, Rng& rng, std::span<double> u) const override;

  CopulaPtr base_;
  Reflection reflection_;
};

/// The copula of 1 - U. @param base not null. @throws std::invalid_argument for no base.
[[nodiscard]] CopulaPtr survival_copula(CopulaPtr base);

}  // namespace sklar
