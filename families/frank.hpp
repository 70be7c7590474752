#pragma once
/// Frank copula.
///   psi(t) = -log(1 - (1 - e^-theta) e^-t) / theta,  psi^-1(u) = -log( (1 - e^(-theta u)) / (1 - e^-theta) )
///   theta > 0 in any dimension; d = 2: any theta; d >= 3: theta >= -log(1 - r), r the root of the Eulerian polynomial
///   A_(d-1) nearest 0 (|psi^(d)| changes sign there)
///   tau = 1 - 4 (1 - D_1(theta)) / theta;  no tail dependence
/// Nelsen (2006), eq. 4.2.5; Genest (1987), Biometrika 74(3) (tau); Hofert (2008), CSDA 52(12) (derivatives as
/// polylogs).
///
/// With q = 1 - e^-theta, a(u) = psi-weight e^(-psi^-1(u)), x = q prod a(u_i):
///   |psi^(k)| = Li_(1-k)(x) / theta,  Li_(1-k)(x) = x R_k(y) / (1-x),  y = x/(1-x), R_k of
///   copula/scaled_polynomials.hpp log c = (d-1) log(theta/q) + log R_d(y) - log(1-x) - theta sum u_i
/// a near 1 is carried as its complement delta = e^(-theta u)(1 - e^(-theta(1-u)))/q; 1 - x of theta > 0 relative to
/// its largest part, (1-x) e^(theta m) = 1 + expm1(theta m)(1 - prod_{i != m} a(u_i)), m = min u: all terms positive.
/// Given one to four values, h = p has a closed solution: one value, a linear equation; else
/// copula/polylogarithm_root.hpp.

#include <algorithm>
#include <limits>

#include "copula/archimedean.hpp"
#include "copula/family.hpp"
#include "copula/frailty.hpp"
#include "copula/polylogarithm_root.hpp"
#include "copula/scaled_polynomials.hpp"
#include "families/independence.hpp"

namespace sklar::families::frank {

/// What depends on theta alone.
template <class T>
struct Constants {
  explicit Constants(double parameter)
      : theta(parameter),
        q(-expm1(-theta)),
        inverse_q(T(1) / q),
        tail(exp(-theta)),
        upper_scale(expm1(theta)),
        growth(exp(theta)),
        log_theta_by_q(log(theta / q)) {}

  T theta, q, inverse_q;
  T tail;         // e^-theta
  T upper_scale;  // e^theta - 1
  T growth;       // e^theta
  T log_theta_by_q;
};

/// Vector kernels, or null for theta without. @param polynomials R_n at n, to R_d in dimension d.
[[nodiscard]] std::shared_ptr<const Kernels> kernels(double theta, std::vector<Coefficients> polynomials);

class Frank {
 public:
  Frank(int dim, double theta)
      : constants_(std::make_shared<const PerPrecision<Constants>>(theta)),
        polynomials_(dim + 1, StirlingRule{std::numeric_limits<double>::infinity()}),
        positive_(theta > 0) {}

  template <class T>
  T log_psi(const T& t) const {
    const T x = constants<T>().q * exp(-t);
    using std::abs;
    using Real = decltype(x.value);
    const auto resolution = std::numeric_limits<Real>::epsilon();
    if (abs(x.value) < resolution) {  // log(-log(1-x)/x) = x/2 + O(x^2)
      const T first_order = x / T(2) - t - constants<T>().log_theta_by_q;
      return {first_order.value, Real(first_order.error + resolution * abs(x.value))};
    }
    return -minus_log_value(exp(-t), -expm1(-t));
  }

  template <class T>
  T psi_inv(const T& u) const {
    return -weight(u).log_value();
  }

  template <class T>
  T log_abs_dpsi(int k, const T& t) const {
    if (k == 0) return log_psi(t);
    const Constants<T>& c = constants<T>();
    const T x = c.q * exp(-t);
    const T complement = positive_ ? -expm1(-t) + exp(-c.theta - t) : T(1) - x;
    return log_polynomial(k, x, complement) - t - c.log_theta_by_q - log(complement);
  }

  template <class T>
  T log_density(std::span<const T> u) const {
    const T& smallest = smallest_of(u);
    const Product<T> product = multiply(u, smallest);
    const Constants<T>& c = constants<T>();
    const int d = static_cast<int>(u.size());
    const T& log_complement = product.log_complement;
    Total<T> distance;  // sum (u_i - m) for theta > 0, sum u_i for theta < 0
    for (const T& value : u) distance += positive_ ? value - smallest : value;
    const T front = T(d - 1) * c.log_theta_by_q - c.theta * distance.value();
    if (d == 2) return front - T(2) * log_complement;  // R_2(y) = 1 / (1-x)
    if (!positive_) return front + log_polynomial(d, product.x, T(1) - product.x) - log_complement;
    const T shift = c.theta * smallest;
    const T complement = exp(log_complement - shift);
    const auto r = polynomials_.split(d, product.x, complement);
    if (!r.leads) return front - T(d - 1) * shift + r.log_rest - log_complement;
    const T log_x = complement < T(0.5) ? log1p(-complement) : log(product.x);
    return front + T(d - 1) * (r.log_scale + log_x) + r.log_rest - T(d) * log_complement;
  }

  template <class T>
  T log_cdf(std::span<const T> u) const {
    T value(1), complement(0);  // of the product of all weights
    for (const T& factor : u) {
      const Weight<T> a = weight(factor);
      complement += value * a.complement;
      value *= a.value;
    }
    return -minus_log_value(value, complement);
  }

  // log h = log z + log(R_j(y z) / R_j(y)), j values given, y of those, z = a_k / (1 + y delta_k); for theta > 0 both
  // are negative. j = 1, either sign: h = z = a(1-x)/(1-xa), 1-h = delta/(1-xa).
  template <class T>
  T log_conditional(std::span<const T> u) const {
    const auto given = u.first(u.size() - 1);
    const Weight<T> last = weight(u.back());
    if (given.size() == 1) return log_conditional_pair(given[0], last);
    const Given<T> before(*this, given);
    const T growth = before.odds * last.complement, divisor = T(1) + growth;
    const T z = last.value / divisor, distance = (last.complement + growth) / divisor;
    return -decrease(given.size(), before, log1p(growth) - last.log_value(), z, distance).first;
  }

  template <class T>
  T conditional_inverse(std::span<const T> given, const T& p) const {
    if (given.size() == 1) {
      // a = p / (p + (1-p) e^(-theta u_1)), a linear equation.
      const T rest = (T(1) - p) * exp(-constants<T>().theta * given[0]);
      const T sum = p + rest;
      return minus_log_value(p / sum, rest / sum);
    }
    const Given<T> before(*this, given);
    const int order = static_cast<int>(given.size());
    if (order <= kLargestPolylogarithmRoot) {
      const auto [z, distance] = polylogarithm_root(order, before.x, before.complement, p);
      return minus_log_value_at(before, z, distance);
    }
    const auto rate = [&](const T& s) { return decrease(given.size(), before, s, exp(-s), -expm1(-s)); };
    const T target = -log(p);
    const T s = solve_increasing(rate, target, target / rate(T(0)).second);
    return minus_log_value_at(before, exp(-s), -expm1(-s));
  }

  [[nodiscard]] std::shared_ptr<const Kernels> kernels(int dim) const {
    return frank::kernels(constants<Narrow>().theta.value, polynomials_.coefficients_to(dim));
  }

  [[nodiscard]] bool has_frailty() const { return positive_; }
  double log_frailty(Rng& rng) const { return frailty::log_logarithmic(rng, constants<Narrow>().theta.value); }

 private:
  template <class T>
  struct Weight {
    T value;       // a(u)
    T complement;  // 1 - a(u)

    [[nodiscard]] T log_value() const { return complement < T(0.5) ? log1p(-complement) : log(value); }
  };

  template <class T>
  struct Product {
    T x;               // q prod a(u_i)
    T log_complement;  // log(1-x) + theta m for theta > 0, log(1-x) for theta < 0
  };

  template <class T>
  const Constants<T>& constants() const {
    return constants_->template get<T>();
  }

  // The smaller of q a and q (1 - a) by expm1, the larger as what is left of q.
  template <class T>
  Weight<T> weight(const T& u) const {
    const Constants<T>& c = constants<T>();
    const auto small = [&](const T& part) { return abs(part) <= T(0.5) * abs(c.q); };
    const T exponent = -(c.theta * u);
    if (u < T(0.5)) {
      const T lower = -expm1(exponent);
      if (small(lower)) return {lower * c.inverse_q, (c.q - lower) * c.inverse_q};
    }
    const T upper = -exp(exponent) * expm1(-c.theta * (T(1) - u));
    const T lower = small(upper) ? c.q - upper : -expm1(exponent);
    return {lower * c.inverse_q, upper * c.inverse_q};
  }

  // -log u from a = a(u) and delta = 1 - a: u = -log(1 - q a)/theta with 1 - q a = e^-theta + q delta,
  // 1 - u = log(1 + expm1(theta) delta)/theta, the argument being a + e^theta delta.
  template <class T>
  T minus_log_value(const T& a, const T& delta) const {
    const Constants<T>& c = constants<T>();
    const T excess = c.upper_scale * delta;
    const T upper = (excess > T(-0.5) ? log1p(excess) : log(a + c.growth * delta)) / c.theta;
    if (upper < T(0.5)) return -log1p(-upper);
    const T x = c.q * a;
    return -log(-(x < T(0.5) ? log1p(-x) : log(c.tail + c.q * delta)) / c.theta);
  }

  // log R_n(x/w), w = 1 - x; R_2 = 1/w.
  template <class T>
  T log_polynomial(int n, const T& x, const T& w) const {
    return n == 2 ? -log(w) : polynomials_.log_value(n, x, w);
  }

  template <class T>
  Product<T> multiply(std::span<const T> u, const T& smallest) const {
    const Constants<T>& c = constants<T>();
    T others(1), complement(0);  // of the product over i != m
    for (const T& value : u) {
      if (&value == &smallest) continue;
      const Weight<T> a = weight(value);
      complement += others * a.complement;
      others *= a.value;
    }
    const T x = c.q * weight(smallest).value * others;
    if (!positive_) return {x, log1p(-x)};
    return {x, log1p(expm1(c.theta * smallest) * complement)};
  }

  template <class T>
  T log_conditional_pair(const T& given, const Weight<T>& a) const {
    const Constants<T>& c = constants<T>();
    const T rest = exp(-c.theta * given);  // 1 - x
    const T x = -expm1(-c.theta * given);
    const T sum = positive_ ? rest + x * a.complement : T(1) - x * a.value;
    const T upper = a.complement / sum;
    return upper < T(0.5) ? log1p(-upper) : log(a.value * rest / sum);
  }

  // x, 1 - x and x/(1-x) of the given coordinates.
  template <class T>
  struct Given {
    Given(const Frank& frank, std::span<const T> given) {
      const T& smallest = smallest_of(given);
      const Product<T> product = frank.multiply(given, smallest);
      const T shift = frank.positive_ ? frank.constants<T>().theta * smallest : T(0);
      x = product.x;
      complement = exp(product.log_complement - shift);
      odds = x * exp(shift - product.log_complement);
    }

    T x, complement, odds;
  };

  // -log h at z with s = -log z, and its derivative in s.
  template <class T>
  std::pair<T, T> decrease(std::size_t order, const Given<T>& given, const T& s, const T& z, const T& distance) const {
    const auto [value, slope] = polynomials_.decrease(static_cast<int>(order), given.x, given.complement, z, distance);
    return {s + value, T(1) + slope};
  }

  // -log v of the next coordinate from z and 1 - z: a(v) = z / (1 - x + x z).
  template <class T>
  T minus_log_value_at(const Given<T>& given, const T& z, const T& distance) const {
    const T divisor = positive_ ? given.complement + given.x * z : T(1) - given.x * distance;
    return minus_log_value(z / divisor, distance * given.complement / divisor);
  }

  std::shared_ptr<const PerPrecision<Constants>> constants_;
  StirlingPolynomials polynomials_;
  bool positive_;
};

/// The theta of a tau in (-1, 1).
inline double theta_from_tau(double tau) {
  // tau(theta) = 4 debye_1_defect(theta) is odd, increasing and concave for theta > 0, so Newton from 0 cannot
  // overshoot.
  const double target = std::abs(tau);
  double theta = 9 * target;
  for (int step = 0; step < 100; ++step) {
    const double scale = 1e-6 * (1 + theta);
    const double slope = 4 * (debye_1_defect(theta + scale) - debye_1_defect(theta - scale)) / (2 * scale);
    const double change = (target - 4 * debye_1_defect(theta)) / slope;
    theta += change;
    if (std::abs(change) <= 1e-15 * theta) break;
  }
  return std::copysign(theta, tau);
}

/// -log(1 - r), the first double that is not below it.
inline double lowest_theta(int dim) {
  if (dim == 2) return -std::numeric_limits<double>::infinity();
  const long double bound = -std::log1p(-eulerian_root(dim - 1));
  const auto nearest = static_cast<double>(bound);
  return nearest < bound ? std::nextafter(nearest, 0.0) : nearest;
}

inline Frank generator(int dim, const Theta& theta) {
  return {dim, theta[0]};
}

inline FamilyInfo info() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {
      .name = "frank",
      .title = "Frank",
      .psi = "-log(1-(1-exp(-theta))*exp(-t))/theta",
      .source = "Nelsen 2006, eq. 4.2.5",
      .parameters = {{"theta",
                      [](int dim) {
                        return Interval{lowest_theta(dim), kInfinity};
                      }}},
      .examples = {{1e-3}, {1.0}, {5.0}, {30.0}, {300.0}, {-0.03}, {-0.6}, {-8.0}, {-100.0}},
      .make_unchecked = [](int dim, const Theta& theta) -> CopulaPtr {
        if (theta[0] == 0) return std::make_shared<independence::Independence>(dim);
        return std::make_shared<Archimedean<Frank>>(dim, generator(dim, theta));
      },
      .tau = [](const Theta& theta) { return 4 * debye_1_defect(theta[0]); },
      .theta_from_tau = [](double tau) { return Theta{theta_from_tau(tau)}; },
      .tails =
          [](const Theta&) {
            return TailDependence{0.0, 0.0};
          },
  };
}

}  // namespace sklar::families::frank
