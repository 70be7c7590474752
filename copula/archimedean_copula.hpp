#pragma once
/// The Archimedean view of a copula: what C(u) = psi(sum psi^-1(u_i)) offers beyond Copula.

#include <vector>

#include "copula/copula.hpp"

namespace sklar {

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

  /// log_abs_dpsi with so many digits, as Copula::exact.
  [[nodiscard]] std::vector<BigFloat> exact_log_abs_dpsi(int order, const ColumnRef& t, int digits) const;

  /// log_cdf of a rotated copula takes 2^m values of the cdf, m reflected coordinates.
  static constexpr int kMostReflected = 20;

 protected:
  using Copula::Copula;

  /// @throws std::domain_error for a log_cdf with more than kMostReflected reflected coordinates.
  static void require_few(const Reflection& reflection);

 private:
  /// log V. Precondition: has_frailty().
  [[nodiscard]] virtual double log_frailty(Rng& rng) const = 0;
  /// psi(e^x), or 1 minus that.
  [[nodiscard]] virtual double psi_at_log(double x, Tail tail) const = 0;
  virtual void kendall_into(const ColumnRef& v, Tail tail, ColumnOut out) const = 0;
  /// log P(R > e^x), P(R > r) = sum_{k<d} r^k |psi^(k)(r)| / k!.
  [[nodiscard]] virtual double log_radial_survival(double x) const = 0;

  virtual void log_abs_dpsi_into(int order, const ColumnRef& t, ColumnOut out) const = 0;
  [[nodiscard]] virtual BigFloat exact_log_abs_dpsi_at(int order, double t, int digits) const = 0;

  void draw(Route route, const Reflection& reflection, Rng& rng, std::span<double> u) const final;
  void frailty_point(const Reflection& reflection, Rng& rng, std::span<double> u) const;
  void radial_point(const Reflection& reflection, Rng& rng, std::span<double> u) const;
  [[nodiscard]] double coordinate(double log_t, bool reflected) const;
  [[nodiscard]] Column kendall(const ColumnRef& v, Tail tail) const;
  void require_derivative(int order, const ColumnRef& t) const;
};

}  // namespace sklar
