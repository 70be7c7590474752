#pragma once
/// Independence copula: C(u) = prod u_i, psi(t) = exp(-t), no parameter, any dimension, tau = 0, no tail dependence.
/// Nelsen, An Introduction to Copulas (2006), eq. 2.2.7 and p. 116.

#include <cmath>

#include "copula/archimedean_copula.hpp"
#include "copula/family.hpp"
#include "copula/generator.hpp"

namespace sklar::families::independence {

class Independence final : public ArchimedeanCopula {
 public:
  explicit Independence(int dim) : ArchimedeanCopula(dim) {}

 private:
  // Rotated, it is the same.
  void log_pdf_into(const PointsRef& u, const Reflection&, ColumnOut out) const override {
    out = u.rowwise().sum() * 0.0;
  }
  // Column by column with std::log: Eigen's own log depends on a row's place in the batch.
  void log_cdf_into(const PointsRef& u, const Reflection&, ColumnOut out) const override {
    out.setZero();
    for (const auto& column : u.colwise()) out += column.unaryExpr([](double value) { return std::log(value); });
  }
  void conditional_into(const PointsRef& u, const Reflection&, Tail tail, ColumnOut out) const override {
    last_column(u, tail, out);
  }
  void conditional_inverse_into(const PointsRef& u, const Reflection&, Tail tail, ColumnOut out) const override {
    last_column(u, tail, out);
  }

  void log_abs_dpsi_into(int, const ColumnRef& t, ColumnOut out) const override { out = -t; }

  [[nodiscard]] bool has_frailty() const override { return true; }
  double log_frailty(Rng&) const override { return 0; }
  double psi_at_log(double x, Tail tail) const override {
    return tail == Tail::lower ? std::exp(-std::exp(x)) : -std::expm1(-std::exp(x));
  }
  void kendall_into(const ColumnRef& v, Tail tail, ColumnOut out) const override {
    for (Index i = 0; i < v.size(); ++i) {
      double sum = 0, term = v(i);  // r^k e^-r / k!, r = -log v; the complement is the rest of the series
      const double r = -std::log(v(i));
      for (int k = 1; k <= dim(); term *= r / k++) sum += term;
      if (tail == Tail::upper) {
        sum = 0;
        int k = dim();
        while (term > sum * 1e-17) {
          sum += term;
          term *= r / ++k;
        }
      }
      out(i) = v(i) == 0 || v(i) == 1 ? (tail == Tail::lower ? v(i) : 1 - v(i)) : sum;
    }
  }
  double log_radial_survival(double x) const override {
    double sum = 1, term = 1;
    for (int k = 1; k < dim(); ++k) sum += term *= std::exp(x) / k;
    return std::log(sum) - std::exp(x);
  }

  BigFloat exact_row(Quantity quantity, std::span<const BigFloat> u, const Reflection&, int digits) const override {
    const WorkingPrecision precision(digits + 20);
    if (quantity == Quantity::log_pdf) return 0;
    if (quantity == Quantity::log_cdf) {
      BigFloat sum = 0;
      for (const BigFloat& value : u) sum += log(value);
      return sum;
    }
    const bool upper = quantity == Quantity::h_upper || quantity == Quantity::h_inv_upper;
    return upper ? 1 - u.back() : u.back();
  }
  BigFloat exact_log_abs_dpsi_at(int, double t, int) const override { return -t; }

  // A NaN among the given coordinates reaches the answer.
  static void last_column(const PointsRef& u, Tail tail, ColumnOut out) {
    const auto last = u.col(u.cols() - 1);
    out = u.rowwise().sum() * 0.0 + (tail == Tail::lower ? Column(last) : Column(1.0 - last));
  }
};

/// psi(t) = exp(-t) for the generic routes; Independence itself needs none.
class Exponential {
 public:
  template <class T>
  T log_psi(const T& t) const {
    return -t;
  }

  template <class T>
  T psi_inv(const T& u) const {
    return -log(u);
  }

  template <class T>
  T log_abs_dpsi(int, const T& t) const {
    return -t;
  }
};

inline Exponential generator(int, const Theta&) {
  return {};
}

inline FamilyInfo info() {
  return {
      .name = "independence",
      .title = "Independence",
      .psi = "exp(-t)",
      .source = "Nelsen 2006, eq. 2.2.7",
      .parameters = {},
      .examples = {Theta{}},
      .make_unchecked = [](int dim, const Theta&) -> CopulaPtr { return std::make_shared<Independence>(dim); },
      .tau = [](const Theta&) { return 0.0; },
      .theta_from_tau = {},
      .tails =
          [](const Theta&) {
            return TailDependence{0.0, 0.0};
          },
  };
}

}  // namespace sklar::families::independence
