#pragma once
/// Ali-Mikhail-Haq copula.
///   psi(t) = (1-theta) / (e^t - theta),  psi^-1(u) = log((1 - theta (1-u)) / u)
///   0 <= theta < 1 in any dimension (theta = 0: independence); theta >= the root of the Eulerian polynomial A_d
///   nearest 0 in dimension d, -1 for d = 2 (|psi^(d)| changes sign there) tau = 1 - 2 (theta + (1-theta)^2
///   log(1-theta)) / (3 theta^2), within [-0.1817.., 1/3);  no tail dependence
/// Nelsen (2006), eq. 4.2.3 and p. 172 (tau); Hofert, Maechler and McNeil (2012), JMVA 110 (derivatives).
///
/// With D(u) = 1 - theta (1-u), a(u) = u / D(u) = e^(-psi^-1(u)), x = theta prod a(u_i), w = 1 - x and R_n of
/// copula/scaled_polynomials.hpp:
///   |psi^(n)(t)| = (1-theta) e^-t R_(n+1)(x/w) / w
///   log c = (d+1) log(1-theta) - 2 sum log D(u_i) - log w + log R_(d+1)(x/w)
/// For x near 1, w = (1-theta) (1 + theta Delta), Delta = sum of (1-u_i) / D(u_i) times the a before it, all terms
/// positive. Where w is small, R_(d+1) goes like w^-d and the powers of 1 - theta cancel exactly.
/// Given one to three values, h = p has a closed solution: copula/polylogarithm_root.hpp.

#include <algorithm>
#include <limits>

#include "copula/archimedean.hpp"
#include "copula/family.hpp"
#include "copula/frailty.hpp"
#include "copula/polylogarithm_root.hpp"
#include "copula/scaled_polynomials.hpp"
#include "families/independence.hpp"

namespace sklar::families::amh {

/// What depends on theta alone.
template <class T>
struct Constants {
  explicit Constants(double parameter) : theta(parameter), rest(T(1) - theta), log_rest(log1p(-theta)) {}

  T theta;
  T rest;      // 1 - theta
  T log_rest;  // log(1 - theta)
};

/// Vector kernels, or null for theta without. @param polynomials R_n at n, to R_(d+1) in dimension d.
[[nodiscard]] std::shared_ptr<const Kernels> kernels(double theta, std::vector<Coefficients> polynomials);

/// The generator; see the comment of the file.
class AliMikhailHaq {
 public:
  AliMikhailHaq(int dim, double theta)
      : constants_(std::make_shared<const PerPrecision<Constants>>(theta)),
        polynomials_(dim + 2, StirlingRule{std::numeric_limits<double>::infinity()}),
        positive_(theta > 0) {}

  template <class T>
  T log_psi(const T& t) const {
    return log_value(exp(-t), -t, -expm1(-t));
  }

  template <class T>
  T psi_inv(const T& u) const {
    const T divisor = scaling(u), delta = constants<T>().rest * (T(1) - u) / divisor;
    return delta < T(0.5) ? -log1p(-delta) : log(divisor) - log(u);
  }

  template <class T>
  T log_abs_dpsi(int k, const T& t) const {
    if (k == 0) return log_psi(t);
    const Constants<T>& c = constants<T>();
    const T a = exp(-t), w = without<T>(a, -expm1(-t));
    return c.log_rest - t - log(w) + polynomials_.log_value(k + 1, c.theta * a, w);
  }

  template <class T>
  T log_density(std::span<const T> u) const {
    const Constants<T>& c = constants<T>();
    const Accumulated<T> sums(*this, u);
    const int d = static_cast<int>(u.size());
    const auto r = polynomials_.split(d + 1, sums.x, sums.w);
    const T scalings = T(2) * sums.log_scalings;
    const T log_stretch = log_stretched(sums);
    if (!r.leads) return T(d) * c.log_rest - scalings - log_stretch + r.log_rest;
    const T log_x = sums.w < T(0.5) ? log1p(-sums.w) : log(sums.x);
    return T(d) * (r.log_scale + log_x) - scalings - T(d + 1) * log_stretch + r.log_rest;
  }

  template <class T>
  T log_cdf(std::span<const T> u) const {
    const Accumulated<T> sums(*this, u);
    const T upper = constants<T>().rest * sums.delta / sums.w;
    if (upper < T(0.5)) return log1p(-upper);
    T log_c = constants<T>().log_rest - sums.log_scalings - log(sums.w);
    for (const T& value : u) log_c += log(value);
    return log_c;
  }

  // h = z R_(j+1)(y z) / R_(j+1)(y), j values given, y = x/w of those, z = a w / (1 - x a); for theta > 0 both
  // factors are below 1.
  template <class T>
  T log_conditional(std::span<const T> u) const {
    const auto given = u.first(u.size() - 1);
    const Accumulated<T> sums(*this, given);
    const T &v = u.back(), divisor = scaling(v);
    const T a = v / divisor, delta = (T(1) - v) / divisor;  // 1 - a(v) = (1-theta) delta
    const Constants<T>& c = constants<T>();
    const T stretch = positive_ ? T(1) + c.theta * sums.delta : sums.w / c.rest;
    const T scale = positive_ ? stretch + sums.x * delta : (T(1) - sums.x * a) / c.rest;
    const T z = a * stretch / scale, distance = delta / scale;
    return -decrease(given.size(), sums, distance < T(0.5) ? -log1p(-distance) : -log(z), z, distance).first;
  }

  template <class T>
  T conditional_inverse(std::span<const T> given, const T& p) const {
    const Accumulated<T> sums(*this, given);
    const int order = static_cast<int>(given.size()) + 1;
    if (order <= kLargestPolylogarithmRoot) {
      const auto [z, distance] = polylogarithm_root(order, sums.x, sums.w, p);
      return -log_value_at(sums, z, distance);
    }
    const auto rate = [&](const T& s) { return decrease(given.size(), sums, s, exp(-s), -expm1(-s)); };
    const T target = -log(p);
    const T s = solve_increasing(rate, target, target / rate(T(0)).second);
    return -log_value_at(sums, exp(-s), -expm1(-s));
  }

  [[nodiscard]] std::shared_ptr<const Kernels> kernels(int dim) const {
    return amh::kernels(constants<Narrow>().theta.value, polynomials_.coefficients_to(dim + 1));
  }

  [[nodiscard]] bool has_frailty() const { return positive_; }
  double log_frailty(Rng& rng) const { return frailty::log_geometric(rng, constants<Narrow>().theta.value); }

 private:
  template <class T>
  const Constants<T>& constants() const {
    return constants_->template get<T>();
  }

  // D(u)
  template <class T>
  T scaling(const T& u) const {
    const Constants<T>& c = constants<T>();
    return positive_ ? c.rest + c.theta * u : T(1) - c.theta * (T(1) - u);
  }

  // 1 - theta a from a and 1 - a.
  template <class T>
  T without(const T& a, const T& delta) const {
    const Constants<T>& c = constants<T>();
    return positive_ ? c.rest + c.theta * delta : T(1) - c.theta * a;
  }

  // log u from a(u), its logarithm and 1 - a(u): u = (1-theta) a / (1 - theta a), 1 - u = (1-a) / (1 - theta a).
  template <class T>
  T log_value(const T& a, const T& log_a, const T& delta) const {
    const T divisor = without(a, delta), upper = delta / divisor;
    return upper < T(0.5) ? log1p(-upper) : log_a + constants<T>().log_rest - log(divisor);
  }

  template <class T>
  struct Accumulated {
    Accumulated(const AliMikhailHaq& copula, std::span<const T> u) {
      const Constants<T>& c = copula.constants<T>();
      T product(1), scalings(1), lost(0);  // of a; of D; 1 - D before the last logarithm
      for (const T& value : u) {
        const T divisor = copula.scaling(value), upper = T(1) - value;
        delta += product * upper / divisor;
        product *= value / divisor;
        lost += scalings * (c.theta * upper);
        scalings *= divisor;
        if (scalings < T(kSmall)) {
          log_scalings += log(scalings);
          scalings = T(1);
          lost = T(0);
        }
      }
      log_scalings += lost < T(0.5) ? log1p(-lost) : log(scalings);
      x = c.theta * product;
      near_one = x > T(0.5);
      w = near_one ? c.rest * (T(1) + c.theta * delta) : T(1) - x;
    }

    static constexpr double kSmall = 1e-100;  // no product of two such numbers underflows
    T delta{0};                               // (1 - prod a) / (1-theta)
    T log_scalings{0};                        // sum log D(u_i)
    T x, w;
    bool near_one;  // x is
  };

  // log(w / (1-theta))
  template <class T>
  T log_stretched(const Accumulated<T>& sums) const {
    const Constants<T>& c = constants<T>();
    return sums.near_one ? log1p(c.theta * sums.delta) : log1p(-sums.x) - c.log_rest;
  }

  // -log h at z with s = -log z, and its derivative in s.
  template <class T>
  std::pair<T, T> decrease(std::size_t given, const Accumulated<T>& sums, const T& s, const T& z,
                           const T& distance) const {
    const auto [value, slope] = polynomials_.decrease(static_cast<int>(given) + 1, sums.x, sums.w, z, distance);
    return {s + value, T(1) + slope};
  }

  // log v of the next coordinate from z and 1 - z: a(v) = z / (w + x z).
  template <class T>
  T log_value_at(const Accumulated<T>& sums, const T& z, const T& distance) const {
    const T divisor = positive_ ? sums.w + sums.x * z : T(1) - sums.x * distance;
    const T a = z / divisor;
    return log_value(a, log(a), distance * sums.w / divisor);
  }

  std::shared_ptr<const PerPrecision<Constants>> constants_;
  StirlingPolynomials polynomials_;
  bool positive_;
};

/// 4/3 sum_{m>=1} theta^m / (m (m+1) (m+2)), in closed form where that does not cancel.
inline double tau(double theta) {
  if (theta == 1) return 1.0 / 3;
  constexpr double kSmall = 0.5;  // the closed form loses two bits here
  if (std::abs(theta) > kSmall) {
    return 1 - 2 * (theta + (1 - theta) * (1 - theta) * std::log1p(-theta)) / (3 * theta * theta);
  }
  double sum = 0;
  for (int m = 50; m > 0; --m) sum = theta * (sum + 1.0 / (m * (m + 1.0) * (m + 2.0)));
  return 4 * sum / 3;
}

/// tau / theta is between 0.1817 and 1/3.
inline double theta_from_tau(double value) {
  const double near = 3 * value, far = 5.6 * value;
  return invert_increasing(tau, value, std::max(std::min(near, far), -1.0),
                           std::min(std::max(near, far), std::nextafter(1.0, 0.0)));
}

/// The root of A_d nearest 0, the first double that is not below it.
inline double lowest_theta(int dim) {
  const long double bound = eulerian_root(dim);
  const auto nearest = static_cast<double>(bound);
  return nearest < bound ? std::nextafter(nearest, 0.0) : nearest;
}

inline AliMikhailHaq generator(int dim, const Theta& theta) {
  return {dim, theta[0]};
}

inline FamilyInfo info() {
  return {
      .name = "amh",
      .title = "Ali-Mikhail-Haq",
      .psi = "(1-theta)/(exp(t)-theta)",
      .source = "Nelsen 2006, eq. 4.2.3",
      .parameters = {{"theta",
                      [](int dim) {
                        return Interval{lowest_theta(dim), 1.0, true, false};
                      }}},
      .examples = {{1e-3}, {0.6}, {0.9}, {0.999999}, {-1e-3}, {-0.03}, {-0.25}, {-0.9}},
      .make_unchecked = [](int dim, const Theta& theta) -> CopulaPtr {
        if (theta[0] == 0) return std::make_shared<independence::Independence>(dim);
        return std::make_shared<Archimedean<AliMikhailHaq>>(dim, generator(dim, theta));
      },
      .tau = [](const Theta& theta) { return tau(theta[0]); },
      .theta_from_tau = [](double tau) { return Theta{theta_from_tau(tau)}; },
      .tails =
          [](const Theta&) {
            return TailDependence{0.0, 0.0};
          },
  };
}

}  // namespace sklar::families::amh
