#pragma once
/// The Archimedean view of a copula: what C(u) = psi(sum psi^-1(u_i)) offers beyond Copula.

#include <vector>

#include "copula/big_float.hpp"
#include "copula/copula.hpp"

namespace sklar {

/// What may be asked for to any number of digits; see the functions of Copula of these names.
enum class Quantity { log_pdf, log_cdf, h, h_upper, h_inv, h_inv_upper };

class ArchimedeanCopula : public Copula {
 public:
  /// log |psi^(k)(t)|, psi decreasing from 1 to 0. @param order k, 0 <= k <= dim(). @param t n values >= 0 (at t = 0
  /// the limit, possibly inf). @return n values. @throws std::domain_error for another order or a negative t.
  [[nodiscard]] Column log_abs_dpsi(int order, const ColumnRef& t) const;

  /// A quantity with so many significant decimal digits right. Doubles are taken as the exact numbers they are.
  /// @param u as for the function of that name. @param digits 1 to kMostDigits.
  /// @return n numbers of more bits than digits need; NaN for a row with NaN, and where 2240 digits more do not do (a
  /// value that is 0 by cancellation). @throws as the function of that name; std::invalid_argument for digits.
  [[nodiscard]] std::vector<BigFloat> exact(Quantity quantity, const PointsRef& u, int digits) const;

  /// log_abs_dpsi with so many digits.
  [[nodiscard]] std::vector<BigFloat> exact_log_abs_dpsi(int order, const ColumnRef& t, int digits) const;

  static constexpr int kMostDigits = 10'000;

 protected:
  using Copula::Copula;

 private:
  virtual void log_abs_dpsi_into(int order, const ColumnRef& t, ColumnOut out) const = 0;
  [[nodiscard]] virtual BigFloat exact_row(Quantity quantity, std::span<const double> u, int digits) const = 0;
  [[nodiscard]] virtual BigFloat exact_log_abs_dpsi_at(int order, double t, int digits) const = 0;

  void require_derivative(int order, const ColumnRef& t) const;
};

}  // namespace sklar
