#pragma once
/// The polynomials in which every derivative of the generators of Joe, Frank and Ali-Mikhail-Haq is written.
///   R_n(y) = sum_{k<n} S(n,k+1) (1-a)(2-a)..(k-a) y^k,  S: Stirling numbers of the second kind (DLMF 26.8), 0 <= a < 1
/// For a = 0, Li_(1-n)(x) = y R_n(y) with y = x/(1-x). No coefficient is negative. Hofert, Maechler and McNeil (2012),
/// JMVA 110, sec. 2.

#include <cmath>
#include <memory>
#include <span>

#include "copula/numerics.hpp"

namespace sklar {

/// Coefficients of R_n in y 2^e(n): c(n,k) 2^(-k e(n)), c(n+1,k) = (k+1) c(n,k) + (k-a) c(n,k-1). The power of two near
/// n/3 keeps them between 1e-30 and 1e210 for n <= 200, while the c(n,k) themselves reach 1e405.
struct StirlingRule {
  double theta;  ///< 1/a; inf for a = 0

  [[nodiscard]] static int exponent(int n) { return n < 4 ? 0 : std::ilogb(n) - 1; }

  template <class T>
  [[nodiscard]] T entry(int n, int k, const T& same, const T& left) const {
    const int growth = exponent(n) - exponent(n - 1);
    const T rest = std::isinf(theta) ? T(1) : (T(theta) - T(1)) / T(theta);  // 1 - a
    return T(std::ldexp(k + 1.0, -k * growth)) * same +
           (T(k - 1) + rest) * T(std::ldexp(1.0, -(k - 1) * growth - exponent(n))) * left;
  }
};

/// R_1 .. R_N at y = p/w, p and w >= 0, either of which may be far below the other.
class StirlingPolynomials {
 public:
  /// @param theta 1/a, > 1; inf for a = 0.
  StirlingPolynomials(int largest, double theta)
      : table_(std::make_shared<const Triangle<StirlingRule>>(largest + 1, StirlingRule{theta})) {}

  /// log R_n(p/w) = log_rest + (leads ? (n-1) (log_scale + log(p/w)) : 0): the leading power is apart where the last
  /// term may be the largest.
  template <class T>
  struct Split {
    bool leads;
    T log_rest;
    T log_scale;
  };

  template <class T>
  [[nodiscard]] Split<T> split(int n, const T& p, const T& w) const {
    const Point<T> at(*this, n, p, w);
    const T sum = at.leads ? reversed_polynomial(at.row, at.x) : polynomial(at.row, at.x);
    return {at.leads, not_positive(sum) ? T(-std::numeric_limits<double>::infinity()) : log(sum), log(at.scale)};
  }

  /// log R_n(p/w), w > 0; p < 0 only where the sum is not negative.
  template <class T>
  [[nodiscard]] T log_value(int n, const T& p, const T& w) const {
    const Split<T> parts = split(n, p, w);
    return parts.leads ? parts.log_rest + T(n - 1) * (parts.log_scale + log(p) - log(w)) : parts.log_rest;
  }

  /// -log( R_n(z p/w) / R_n(p/w) ) for 0 <= z <= 1, accurate in the relative sense, and its derivative in -log z.
  /// @param distance 1 - z.
  template <class T>
  [[nodiscard]] std::pair<T, T> decrease(int n, const T& p, const T& w, const T& z, const T& distance) const {
    const Point<T> at(*this, n, p, w);
    Sums<T> sums;
    if (at.leads) {
      add_reversed(at, z, sums);
    } else {
      add(at, z, sums);
    }
    const T loss = sums.difference * distance / sums.here;
    return {loss < T(0.5) ? -log1p(-loss) : -log(sums.there / sums.here), sums.slope / sums.there};
  }

 private:
  // The argument scaled as the coefficients are, or its reciprocal, whichever is not above 1.
  template <class T>
  struct Point {
    Point(const StirlingPolynomials& polynomials, int n, const T& p, const T& w)
        : row(polynomials.table_->template row<T>(n)), scale(std::ldexp(1.0, StirlingRule::exponent(n))) {
      const T scaled = p * scale;
      leads = scaled > w;
      x = leads ? w / scaled : scaled / w;
    }

    std::span<const T> row;
    T scale;
    bool leads;
    T x;
  };

  template <class T>
  struct Sums {
    T here{0}, there{0};  // at y and at z y
    T difference{0};      // (here - there) / (1 - z)
    T slope{0};           // z d/dz of there
  };

  template <class T>
  static void add(const Point<T>& at, const T& z, Sums<T>& sums) {
    const T moved = z * at.x;
    for (std::size_t k = at.row.size(); k-- > 0;) {
      sums.difference = sums.difference * moved + sums.here;
      sums.slope = sums.slope * moved + sums.there;
      sums.here = sums.here * at.x + at.row[k];
      sums.there = sums.there * moved + at.row[k];
    }
    sums.difference *= at.x;
    sums.slope *= moved;
  }

  // All divided by the leading power of y.
  template <class T>
  static void add_reversed(const Point<T>& at, const T& z, Sums<T>& sums) {
    T power(1), geometric(0);  // z^k and (1 - z^k) / (1 - z)
    for (std::size_t k = 0; k < at.row.size(); ++k) {
      const T term = at.row[k] * power;
      sums.here = sums.here * at.x + at.row[k];
      sums.there = sums.there * at.x + term;
      sums.slope = sums.slope * at.x + T(static_cast<int>(k)) * term;
      sums.difference = sums.difference * at.x + at.row[k] * geometric;
      geometric = geometric * z + T(1);
      power *= z;
    }
  }

  std::shared_ptr<const Triangle<StirlingRule>> table_;
};

}  // namespace sklar
