#pragma once
/// The Archimedean view of a copula: what C(u) = psi(sum psi^-1(u_i)) offers beyond Copula.

#include <vector>

#include "copula/big_float.hpp"
#include "copula/copula.hpp"

namespace sklar {

/// What may be asked for to any number of digits; see the functions of Copula of these names.
enum class Quantity { log_pdf, log_cdf, h, h_upper, h_inv, h_inv_upper };

/// How points are drawn. conditional: Copula::sample. frailty: psi(E_i / V) with exponential E_i, one frailty V a
/// point, the fastest; positive dependence only. radial: psi(R S_i), S uniform on the simplex, any dependence (McNeil
/// and Neslehova 2009, Theorem 2).
enum class Route { conditional, frailty, radial };

class ArchimedeanCopula : public Copula {
 public:
  /// log |psi^(k)(t)|, psi decreasing from 1 to 0. @param order k, 0 <= k <= dim(). @param t n values >= 0 (at t = 0
  /// the limit, possibly inf). @return n values. @throws std::domain_error for another order or a negative t.
  [[nodiscard]] Column log_abs_dpsi(int order, const ColumnRef& t) const;

  /// Kendall distribution P(C(U) <= v) = sum_{k<d} phi(v)^k |psi^(k)(phi(v))| / k!, phi = psi^-1, and its complement
  /// without cancellation. Genest and Rivest (2001), Statist. Probab. Lett. 53, 391. @param v n values in [0,1].
  /// @throws std::domain_error for another v.
  [[nodiscard]] Column kendall_cdf(const ColumnRef& v) const;
  [[nodiscard]] Column kendall_survival(const ColumnRef& v) const;

  /// A quantity with so many significant decimal digits right. Doubles are taken as the exact numbers they are.
  /// @param u as for the function of that name. @param digits 1 to kMostDigits.
  /// @return n numbers of more bits than digits need; NaN for a row with NaN, and where 2240 digits more do not do (a
  /// value that is 0 by cancellation). @throws as the function of that name; std::invalid_argument for digits.
  [[nodiscard]] std::vector<BigFloat> exact(Quantity quantity, const PointsRef& u, int digits) const;

  /// log_abs_dpsi with so many digits.
  [[nodiscard]] std::vector<BigFloat> exact_log_abs_dpsi(int order, const ColumnRef& t, int digits) const;

  static constexpr int kMostDigits = 10'000;

  /// log_cdf of a rotated copula takes 2^m values of the cdf, m reflected coordinates.
  static constexpr int kMostReflected = 20;

  /// n points by a route. The routes draw different points of the same distribution. @param n >= 1.
  /// @throws std::domain_error for the frailty route where has_frailty() is false.
  [[nodiscard]] Points sample_by(Route route, Index n, Rng& rng) const;

  /// Whether the generator knows the distribution that it is the Laplace transform of.
  [[nodiscard]] virtual bool has_frailty() const = 0;

 protected:
  using Copula::Copula;

  /// @throws std::domain_error for a log_cdf with more than kMostReflected reflected coordinates.
  static void require_few(const Reflection& reflection);

 private:
  /// log V. Precondition: has_frailty().
  [[nodiscard]] virtual double log_frailty(Rng& rng) const = 0;
  /// psi(e^x).
  [[nodiscard]] virtual double psi_at_log(double x) const = 0;
  virtual void kendall_into(const ColumnRef& v, Tail tail, ColumnOut out) const = 0;
  /// log P(R > e^x), P(R > r) = sum_{k<d} r^k |psi^(k)(r)| / k!.
  [[nodiscard]] virtual double log_radial_survival(double x) const = 0;

  virtual void log_abs_dpsi_into(int order, const ColumnRef& t, ColumnOut out) const = 0;
  [[nodiscard]] virtual BigFloat exact_row(Quantity quantity, std::span<const double> u, int digits) const = 0;
  [[nodiscard]] virtual BigFloat exact_log_abs_dpsi_at(int order, double t, int digits) const = 0;

  void frailty_point(Rng& rng, std::span<double> u) const;
  void radial_point(Rng& rng, std::span<double> u) const;
  [[nodiscard]] Column kendall(const ColumnRef& v, Tail tail) const;
  void require_derivative(int order, const ColumnRef& t) const;
};

}  // namespace sklar
