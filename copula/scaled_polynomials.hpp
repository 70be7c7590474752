#pragma once
/// Polynomials R_n(y) = sum_{k<n} c(n,k) y^k with c(n,k) >= 0 from a two-term recurrence, for arguments and
/// coefficients far outside the range of double: every derivative of the generators of Frank, Gumbel, Joe and
/// Ali-Mikhail-Haq is written in one such family. Hofert, Maechler and McNeil (2012), JMVA 110, sec. 2.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "copula/coefficients.hpp"
#include "copula/numerics.hpp"

namespace sklar {

/// R_1 .. R_N at y = p/w, p and w >= 0, either of which may be far below the other. Rule has
///   same<T>(n, k), left<T>(n, k)  the factors of c(n-1,k) and c(n-1,k-1) in c(n,k), not negative; c(1,0) = 1
///   exponent(n)                   e: 2^e is near (c(n,0) / c(n,n-1))^(1/(n-1)); the table holds c(n,k) 2^(-k e)
template <class Rule>
class ScaledPolynomials {
 public:
  ScaledPolynomials(int largest, Rule rule) : table_(std::make_shared<const Table>(largest + 1, Scaled{rule})) {}

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
    Point<T> at(*this, n, p, w);
    const auto relative = at.take_error();
    Sums<T> sums;
    if (at.leads) {
      add_reversed(at, z, sums);
    } else {
      add(at, z, sums);
    }
    const T loss = sums.difference * distance / sums.here;
    T value = loss < T(0.5) ? -log1p(-loss) : -log(sums.there / sums.here);
    const T slope = sums.slope / sums.there;
    if (relative > 0) value.error += moved_by(relative, n, distance, sums.rise / sums.here - slope);
    return {value, slope};
  }

  /// R_0 (empty), R_1 .. R_n in double for vector kernels.
  [[nodiscard]] std::vector<Coefficients> coefficients_to(int n) const {
    std::vector<Coefficients> all(1);
    for (int i = 1; i <= n; ++i) all.push_back(coefficients(i));
    return all;
  }

  /// R_n in double.
  [[nodiscard]] Coefficients coefficients(int n) const {
    Coefficients result{.c = {}, .scale = std::ldexp(1.0, table_->rule().rule.exponent(n))};
    for (const Narrow& c : table_->template row<Narrow>(n)) {
      result.c.push_back(c.value);
      result.relative_error = std::max(result.relative_error, c.error / c.value);
    }
    return result;
  }

 private:
  struct Scaled {
    Rule rule;

    template <class T>
    [[nodiscard]] T entry(int n, int k, const T& same, const T& left) const {
      const T factor = T(std::ldexp(1.0, -rule.exponent(n))) * rule.template left<T>(n, k);
      const int growth = rule.exponent(n) - rule.exponent(n - 1);
      if (growth == 0) return rule.template same<T>(n, k) * same + factor * left;
      return T(std::ldexp(1.0, -k * growth)) * rule.template same<T>(n, k) * same +
             T(std::ldexp(1.0, -(k - 1) * growth)) * factor * left;
    }
  };
  using Table = Triangle<Scaled>;

  // The largest scaled argument, up to y = 1, at which R_n stays far within double: 2^(3.5 n) is above R_n at 1.
  [[nodiscard]] double reach(int n) const {
    constexpr double kRange = 1000, kGrowth = 3.5;
    const int most = std::max(0, static_cast<int>((kRange - kGrowth * n) / n));
    return std::ldexp(1.0, std::min(most, table_->rule().rule.exponent(n)));
  }

  // By how much an error of log y moves log( R_n(z y) / R_n(y) ), whose derivative is the difference of the mean
  // exponents k < n of the two and whose second derivative, that of their variances, is below (n-1)^2/4 and
  // (n-1)^3 (1-z)/2 or (n-1)^3 |log z| / 10.
  template <class T, class Real>
  static Real moved_by(const Real& relative, int n, const T& distance, const T& mean_difference) {
    using std::abs, std::min;
    const Real first = abs(mean_difference.value) + mean_difference.error;
    const Real span = n - 1;
    const Real second = span * span / 4 * min(Real(1), Real(span * (distance.value + distance.error)));
    return relative * (first + relative * second);
  }

  // The argument scaled as the coefficients are, or its reciprocal.
  template <class T>
  struct Point {
    Point(const ScaledPolynomials& polynomials, int n, const T& p, const T& w)
        : row(polynomials.table_->template row<T>(n)),
          scale(std::ldexp(1.0, polynomials.table_->rule().rule.exponent(n))) {
      const T scaled = p * scale;
      leads = scaled > w * T(polynomials.reach(n));
      x = leads ? w / scaled : scaled / w;
    }

    /// Makes x exact and gives the relative error it had; 0 and no change where that is not small or x not positive.
    auto take_error() {
      using Real = decltype(x.value);
      constexpr double kLargest = 1e-11;
      if (!(x.error <= kLargest * x.value)) return Real(0);
      const Real relative = x.error / x.value * Real(1 + 2 * kLargest);
      x.error = 0;
      return relative;
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
    T rise{0}, slope{0};  // their derivatives in log y
  };

  template <class T>
  static void add(const Point<T>& at, const T& z, Sums<T>& sums) {
    const T moved = z * at.x;
    for (std::size_t k = at.row.size(); k-- > 0;) {
      sums.difference = sums.difference * moved + sums.here;
      sums.slope = sums.slope * moved + sums.there;
      sums.rise = sums.rise * at.x + sums.here;
      sums.here = sums.here * at.x + at.row[k];
      sums.there = sums.there * moved + at.row[k];
    }
    sums.difference *= at.x;
    sums.slope *= moved;
    sums.rise *= at.x;
  }

  // All divided by the leading power of y.
  template <class T>
  static void add_reversed(const Point<T>& at, const T& z, Sums<T>& sums) {
    T power(1), geometric(0);  // z^k and (1 - z^k) / (1 - z)
    for (std::size_t k = 0; k < at.row.size(); ++k) {
      const T term = at.row[k] * power;
      sums.here = sums.here * at.x + at.row[k];
      sums.there = sums.there * at.x + term;
      sums.rise = sums.rise * at.x + T(static_cast<int>(k)) * at.row[k];
      sums.slope = sums.slope * at.x + T(static_cast<int>(k)) * term;
      sums.difference = sums.difference * at.x + at.row[k] * geometric;
      geometric = geometric * z + T(1);
      power *= z;
    }
  }

  std::shared_ptr<const Table> table_;
};

/// c(n,k) = S(n,k+1) (1-a)(2-a)..(k-a), S: Stirling numbers of the second kind (DLMF 26.8), 0 <= a < 1:
///   c(n+1,k) = (k+1) c(n,k) + (k-a) c(n,k-1)
/// For a = 0, Li_(1-n)(x) = y R_n(y) with y = x/(1-x). The scaled coefficients are between 1e-30 and 1e210 for n <=
/// 200, the c(n,k) reach 1e405.
struct StirlingRule {
  double theta;  ///< 1/a, > 1; inf for a = 0

  [[nodiscard]] int exponent(int n) const { return n < 4 ? 0 : std::ilogb(n) - 1; }

  template <class T>
  [[nodiscard]] T same(int, int k) const {
    return T(k + 1);
  }

  template <class T>
  [[nodiscard]] T left(int, int k) const {
    return std::isinf(theta) ? T(k) : T(k - 1) + (T(theta) - T(1)) / T(theta);
  }
};

/// The polynomials of Frank's and Ali-Mikhail-Haq's generators.
using StirlingPolynomials = ScaledPolynomials<StirlingRule>;

}  // namespace sklar
