#pragma once
/// Joe copula.
///   psi(t) = 1 - (1 - e^-t)^(1/theta),  psi^-1(u) = -log(1 - (1-u)^theta)
///   theta >= 1 in any dimension (theta = 1: independence)
///   tau = 2 (theta-1)/theta sum_{n>=1} n / ((n+1)(n+2)(n + 2/theta));  lambda_L = 0, lambda_U = 2 - 2^(1/theta)
/// Nelsen (2006), eq. 4.2.6; Hofert, Maechler and McNeil (2012), JMVA 110 (derivatives).
///
/// With q_i = (1-u_i)^theta, P = prod (1 - q_i) = e^-t, w = 1 - P, a = 1/theta and R_n of
/// copula/scaled_polynomials.hpp:
///   |psi^(n)| = a w^(a-1) P R_n(P/w)
///   log c = (d-1) log theta + (theta-1) sum log(1-u_i) - (1-a) log w + log R_d(P/w)
/// w is taken relative to the largest q: with m the smallest u, r = w / q_m = 1 + (1-q_m) sum_{i != m} (q_i/q_m) prod
/// of the 1 - q before i, all terms positive. Where w is small, R_d goes like w^-(d-1) and
///   log c = (d-1) (log theta - log(1-u_m) + log P) + (theta-1) sum log((1-u_i)/(1-u_m)) - (d-a) log r + log(R_d
///   y^-(d-1)).
/// tau: psi(2) - psi(1+x) of the digamma function as a series, so that nothing cancels at theta = 1 and 2.

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <limits>

#include "copula/archimedean.hpp"
#include "copula/family.hpp"
#include "copula/frailty.hpp"
#include "copula/scaled_polynomials.hpp"
#include "families/independence.hpp"

namespace sklar::families::joe {

/// What depends on theta alone.
template <class T>
struct Constants {
  explicit Constants(double parameter)
      : theta(parameter), excess(theta - T(1)), rest(excess / theta), log_theta(log(theta)) {}

  T theta;
  T excess;  // theta - 1
  T rest;    // 1 - 1/theta
  T log_theta;
};

/// Vector kernels, or null for theta without. @param polynomials R_n at n, to R_d in dimension d.
[[nodiscard]] std::shared_ptr<const Kernels> kernels(double theta, std::vector<Coefficients> polynomials);

class Joe {
 public:
  Joe(int dim, double theta)
      : constants_(std::make_shared<const PerPrecision<Constants>>(theta)),
        polynomials_(dim + 1, StirlingRule{theta}) {}

  template <class T>
  T log_psi(const T& t) const {
    return log_value(exp(-t), -t, log1mexp(t) / constants<T>().theta);
  }

  template <class T>
  T psi_inv(const T& u) const {
    return -Weight<T>(constants<T>().theta * log1p(-u)).log_value();
  }

  template <class T>
  T log_abs_dpsi(int k, const T& t) const {
    const Constants<T>& c = constants<T>();
    const bool exact = t.error == 0;
    if (exact && t.value == 0) return T(k == 0 ? 0 : kInfinity);
    if (exact && std::isinf(static_cast<double>(t.value))) return -t;
    if (k == 0) return log_psi(t);
    const T log_w = log1mexp(t);
    const auto r = polynomials_.split(k, exp(-t), -expm1(-t));
    const T leading = r.leads ? T(k - 1) * (r.log_scale - t - log_w) : T(0);
    return r.log_rest + leading - c.log_theta - t - c.rest * log_w;
  }

  // n zeros or ones: the limits follow from the formulas, except where all values are 1.
  template <class T>
  T log_density(std::span<const T> u) const {
    if (all_ones(u)) return T(kInfinity);
    const Constants<T>& c = constants<T>();
    const Accumulated<T> sums(c, u);
    const int d = static_cast<int>(u.size());
    const T n(d - 1);
    const auto r = polynomials_.split(d, sums.product, sums.complement);
    if (!r.leads) return n * c.log_theta + c.excess * sums.others - c.rest * sums.log_stretch + r.log_rest;
    const T log_product = sums.complement < T(0.5) ? log1p(-sums.complement) : log(sums.product);
    return n * (c.log_theta - sums.log_largest + log_product + r.log_scale) + c.excess * sums.log_ratios -
           (n + c.rest) * sums.log_stretch + r.log_rest;
  }

  template <class T>
  T log_cdf(std::span<const T> u) const {
    if (all_ones(u)) return T(0);
    const Constants<T>& c = constants<T>();
    const Accumulated<T> sums(c, u);
    T log_product(0);
    if (sums.product < T(0.5)) {
      for (const T& value : u) log_product += Weight<T>(c.theta * log1p(-value)).log_value();
    }
    return log_value(sums.product, log_product, sums.log_largest + sums.log_stretch / c.theta);
  }

  // Given nothing but ones the next coordinate is 1.
  template <class T>
  T log_conditional(std::span<const T> u) const {
    const auto given = u.first(u.size() - 1);
    if (all_ones(given)) return T(-kInfinity);
    return -Conditional<T>(*this, given).decrease_at(u.back());
  }

  template <class T>
  T conditional_inverse(std::span<const T> given, const T& p) const {
    if (all_ones(given)) return T(0);
    const Conditional<T> conditional(*this, given);
    const auto rate = [&](const T& s) { return conditional.decrease(s); };
    const T target = -log(p);
    return conditional.minus_log_value(solve_increasing(rate, target, target / conditional.decrease(T(0)).second));
  }

  [[nodiscard]] std::shared_ptr<const Kernels> kernels(int dim) const {
    return joe::kernels(constants<Narrow>().theta.value, polynomials_.coefficients_to(dim));
  }

  [[nodiscard]] bool has_frailty() const { return true; }
  double log_frailty(Rng& rng) const { return frailty::log_sibuya(rng, 1 / constants<Narrow>().theta.value); }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  // q = (1-u)^theta and 1 - q from the logarithm of q.
  template <class T>
  struct Weight {
    explicit Weight(const T& logarithm) : log_q(logarithm) {
      if (log_q > T(-0.6931471805599453)) {
        p = -expm1(log_q);
        q = T(1) - p;
      } else {
        q = exp(log_q);
        p = T(1) - q;
      }
    }

    /// log(1 - q).
    [[nodiscard]] T log_value() const { return q < T(0.5) ? log1p(-q) : log(p); }

    T log_q, q, p;
  };

  template <class T>
  struct Accumulated {
    Accumulated(const Constants<T>& c, std::span<const T> u) {
      const T& smallest = smallest_of(u);
      log_largest = log1p(-smallest);
      const T largest = T(1) - smallest;
      T rest(0);
      Total<T> upper, ratios;
      for (const T& value : u) {
        if (&value == &smallest) continue;
        const T log_upper = log1p(-value);
        const T ratio = log_upper_ratio(value, smallest, largest, log_upper, log_largest);
        upper += log_upper;
        ratios += ratio;
        rest += product * exp(c.theta * ratio);
        product *= Weight<T>(c.theta * log_upper).p;
      }
      others = upper.value();
      log_ratios = ratios.value();
      const Weight<T> first(c.theta * log_largest);
      rest *= first.p;
      product *= first.p;
      log_stretch = log1p(rest);
      complement = first.q * (T(1) + rest);
    }

    T log_largest;  // log(1 - u_m), u_m = min u_i
    T others;       // sum over i != m of log(1 - u_i)
    T log_ratios;   // sum of log((1 - u_i) / (1 - u_m))
    T product{1};   // P
    T complement;   // w
    T log_stretch;  // log(w / q_m)
  };

  // log((1-u) / (1-m)), m <= u, by the difference of the two where they are near each other.
  template <class T>
  static T log_upper_ratio(const T& u, const T& m, const T& upper_m, const T& log_upper, const T& log_upper_m) {
    const T difference = (m - u) / upper_m;
    return difference > T(-0.5) ? log1p(difference) : log_upper - log_upper_m;
  }

  template <class T>
  const Constants<T>& constants() const {
    return constants_->template get<T>();
  }

  // log(1 - (1-p)^a) from p, log p and log(1-p)/theta; log p is used for small p alone.
  template <class T>
  T log_value(const T& p, const T& log_p, const T& log_upper) const {
    using Real = decltype(p.value);
    const Constants<T>& c = constants<T>();
    // 1 - (1-p)^a = a p (1 + f), 0 <= f <= p.
    if (p < T(Real(std::numeric_limits<Real>::epsilon() / 16), Real(0))) {
      return log_p - c.log_theta + T(Real(0), Real(p.value + p.error));
    }
    return p < T(0.5) ? log(-expm1(log1p(-p) / c.theta)) : log1mexp(-log_upper);
  }

  // -log h, j values given, P and w of those; z = y'/y = p / (1 + P q/w) for the next coordinate's p = 1 - q:
  //   -log p + (1-a) log(1 + P q/w) - log( R_j(y z) / R_j(y) ), all terms positive.
  template <class T>
  class Conditional {
   public:
    Conditional(const Joe& joe, std::span<const T> given)
        : joe_(joe),
          c_(joe.constants<T>()),
          order_(static_cast<int>(given.size())),
          sums_(c_, given),
          smallest_(smallest_of(given)) {}

    /// From the next coordinate v itself, Q = q/w.
    [[nodiscard]] T decrease_at(const T& v) const {
      const T log_upper = log1p(-v);
      const Weight<T> weight(c_.theta * log_upper);
      const T log_upper_ratio_v = v < smallest_
                                      ? -log_upper_ratio(smallest_, v, T(1) - v, sums_.log_largest, log_upper)
                                      : log_upper_ratio(v, smallest_, T(1) - smallest_, log_upper, sums_.log_largest);
      const T log_ratio_q = c_.theta * log_upper_ratio_v - sums_.log_stretch;
      const T& product = sums_.product;
      if (log_ratio_q < T(0)) {
        const T ratio = exp(log_ratio_q), growth = product * ratio, divisor = T(1) + growth;
        return total(-weight.log_value(), log1p(growth), weight.p / divisor, ratio / divisor).first;
      }
      const T inverse = exp(-log_ratio_q), divisor = inverse + product;
      return total(-weight.log_value(), log_ratio_q + log(divisor), weight.p * inverse / divisor, T(1) / divisor).first;
    }

    /// As a function of s = -log z, and its derivative.
    [[nodiscard]] std::pair<T, T> decrease(const T& s) const {
      const Moved at(*this, s);
      const auto [value, slope] = total(at.minus_log_p(), -at.log_divisor, at.z, at.distance);
      return {value, slope + (sums_.complement + c_.rest * at.z * sums_.product) / at.divisor};
    }

    /// -log v of the next coordinate.
    [[nodiscard]] T minus_log_value(const T& s) const {
      const Moved at(*this, s);
      const T log_upper = sums_.log_largest + (sums_.log_stretch + log(at.distance) - at.log_divisor) / c_.theta;
      return -joe_.log_value(at.p, -at.minus_log_p(), log_upper);
    }

   private:
    // With z: q/w = (1-z) / (w + z P), p = z / (w + z P).
    struct Moved {
      Moved(const Conditional& conditional, const T& minus_log_z) : s(minus_log_z), z(exp(-s)), distance(-expm1(-s)) {
        const Accumulated<T>& sums = conditional.sums_;
        const T lost = sums.product * distance;
        divisor = sums.complement + z * sums.product;
        log_divisor = lost < T(0.5) ? log1p(-lost) : log(divisor);
        p = z / divisor;
        q = distance * sums.complement / divisor;
      }

      [[nodiscard]] T minus_log_p() const { return q < T(0.5) ? -log1p(-q) : s + log_divisor; }

      T s, z, distance, divisor, log_divisor, p, q;
    };

    // -log h and the last term's derivative in -log z.
    [[nodiscard]] std::pair<T, T> total(const T& minus_log_p, const T& log_growth, const T& z,
                                        const T& distance) const {
      const auto [value, slope] = joe_.polynomials_.decrease(order_, sums_.product, sums_.complement, z, distance);
      return {minus_log_p + c_.rest * log_growth + value, slope};
    }

    const Joe& joe_;
    const Constants<T>& c_;
    int order_;
    Accumulated<T> sums_;
    T smallest_;
  };

  std::shared_ptr<const PerPrecision<Constants>> constants_;
  StirlingPolynomials polynomials_;
};

/// sum_{n>=1} n / ((n+1)(n+2)(n+x)), 0 <= x <= 2: terms below kFirst, then the Euler-Maclaurin formula (DLMF 2.10.1)
/// with the integral over 1/n.
inline double tau_series(double x) {
  constexpr int kFirst = 100;  // the next term of the formula is 0.024 / kFirst^7
  const auto term = [x](double n) { return n / ((n + 1) * (n + 2) * (n + x)); };
  const double n = kFirst;
  const double integral = boost::math::quadrature::gauss<double, 7>::integrate(
      [&](double v) { return n * n / ((n + v) * (n + 2 * v) * (n + x * v)); }, 0.0, 1.0);
  const auto powers = [&](int k) {  // derivatives of log term: n^-k - (n+1)^-k - (n+2)^-k - (n+x)^-k
    return std::pow(n, -k) - std::pow(n + 1, -k) - std::pow(n + 2, -k) - std::pow(n + x, -k);
  };
  const double g1 = powers(1), g2 = -powers(2), g3 = 2 * powers(3);
  double sum = integral + term(n) * (0.5 - g1 / 12 + (g1 * g1 * g1 + 3 * g1 * g2 + g3) / 720);
  for (int k = kFirst - 1; k > 0; --k) sum += term(k);
  return sum;
}

/// Kendall's tau of theta >= 1.
inline double tau(double theta) {
  return std::isinf(theta) ? 1 : 2 * (theta - 1) / theta * tau_series(2 / theta);
}

/// tau = e S(2-e), e = 2 (theta-1)/theta, S between pi^2/3 - 3 and 1/2; 1 - tau is between x/2 and x, x = 2/theta.
inline double theta_from_tau(double tau) {
  if (tau < 0.5) {
    const double e = invert_increasing([](double x) { return x * tau_series(2 - x); }, tau, 2 * tau, 4 * tau);
    return 2 / (2 - e);
  }
  const double x = -invert_increasing([](double y) { return (2 + y) * tau_series(-y); }, tau, -2 * (1 - tau), tau - 1);
  return 2 / x;
}

inline Joe generator(int dim, const Theta& theta) {
  return {dim, theta[0]};
}

inline FamilyInfo info() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {
      .name = "joe",
      .title = "Joe",
      .psi = "1-(1-exp(-t))^(1/theta)",
      .source = "Nelsen 2006, eq. 4.2.6",
      .parameters = {{"theta",
                      [](int) {
                        return Interval{1.0, kInfinity};
                      }}},
      .examples = {{1.0}, {1.001}, {1.5}, {3.0}, {20.0}, {60.0}},
      .make_unchecked = [](int dim, const Theta& theta) -> CopulaPtr {
        if (theta[0] == 1) return std::make_shared<independence::Independence>(dim);
        return std::make_shared<Archimedean<Joe>>(dim, generator(dim, theta));
      },
      .tau = [](const Theta& theta) { return tau(theta[0]); },
      .theta_from_tau = [](double tau) { return Theta{theta_from_tau(tau)}; },
      .tails =
          [](const Theta& theta) {
            return TailDependence{0.0, 2 - std::exp2(1 / theta[0])};
          },
  };
}

}  // namespace sklar::families::joe
