#pragma once
/// Truncated Taylor series: a value and its derivatives up to an order, in any real type.

#include <cstddef>
#include <vector>

namespace sklar::test {

/// f(t0 + x) = sum_k coefficient(k) x^k up to the order of the jet.
template <class Real>
class Jet {
 public:
  Jet(std::size_t order, const Real& value) : c_(order + 1, Real(0)) { c_[0] = value; }

  /// The independent variable at t0.
  static Jet variable(std::size_t order, const Real& t0) {
    Jet x(order, t0);
    if (order > 0) x.c_[1] = 1;
    return x;
  }

  [[nodiscard]] std::size_t order() const { return c_.size() - 1; }
  [[nodiscard]] const Real& coefficient(std::size_t k) const { return c_[k]; }

  friend Jet operator+(Jet a, const Jet& b) {
    for (std::size_t k = 0; k < a.c_.size(); ++k) a.c_[k] += b.c_[k];
    return a;
  }
  friend Jet operator-(Jet a, const Jet& b) {
    for (std::size_t k = 0; k < a.c_.size(); ++k) a.c_[k] -= b.c_[k];
    return a;
  }
  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet product(a.order(), Real(0));
    for (std::size_t k = 0; k < a.c_.size(); ++k) {
      for (std::size_t i = 0; i <= k; ++i) product.c_[k] += a.c_[i] * b.c_[k - i];
    }
    return product;
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    Jet ratio(a.order(), Real(0));
    for (std::size_t k = 0; k < a.c_.size(); ++k) {
      Real rest = a.c_[k];
      for (std::size_t i = 0; i < k; ++i) rest -= ratio.c_[i] * b.c_[k - i];
      ratio.c_[k] = rest / b.c_[0];
    }
    return ratio;
  }
  /// From e' = a' e.
  friend Jet exp(const Jet& a) {
    using std::exp;
    Jet e(a.order(), Real(exp(a.c_[0])));
    for (std::size_t k = 1; k < a.c_.size(); ++k) {
      for (std::size_t i = 1; i <= k; ++i) e.c_[k] += Real(i) * a.c_[i] * e.c_[k - i];
      e.c_[k] /= k;
    }
    return e;
  }
  /// From a l' = a'.
  friend Jet log(const Jet& a) {
    using std::log;
    Jet l(a.order(), Real(log(a.c_[0])));
    for (std::size_t k = 1; k < a.c_.size(); ++k) {
      Real rest = a.c_[k] * k;
      for (std::size_t i = 1; i < k; ++i) rest -= Real(i) * l.c_[i] * a.c_[k - i];
      l.c_[k] = rest / (a.c_[0] * k);
    }
    return l;
  }
  /// (a)_+^b: 0 where a <= 0.
  friend Jet pow(const Jet& a, const Jet& b) { return a.c_[0] > 0 ? exp(b * log(a)) : Jet(a.order(), Real(0)); }

 private:
  std::vector<Real> c_;
};

}  // namespace sklar::test
