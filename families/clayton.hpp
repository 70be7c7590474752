#pragma once
/// Clayton copula.
///   psi(t) = (1 + theta t)_+^(-1/theta),  psi^-1(u) = (u^-theta - 1) / theta
///   theta > 0 in any dimension; theta >= -1/(d-1) in dimension d (at the bound the mass lies on a surface)
///   tau = theta / (theta + 2);  lambda_L = 2^(-1/theta) for theta > 0, else 0;  lambda_U = 0
/// Nelsen (2006), An Introduction to Copulas, eq. 4.2.1; McNeil and Neslehova (2009), example 1 (domain).
///
/// With x_i = -theta log u_i, S = 1 + sum expm1(x_i):
///   log c = sum_{k<d} log(1 + k theta) + (1 + theta)/theta sum x_i - (d + 1/theta) log S
/// For large x_i everything is taken relative to the smallest u, m: S = e^(x_m) (1 + sum_{i != m} e^(x_i - x_m)(1 -
/// e^-x_i)), all terms positive. As theta -> 0 the terms of order 1 cancel, which costs eps sum |log u_i|, absolute.

#include <algorithm>
#include <limits>

#include "copula/archimedean.hpp"
#include "copula/family.hpp"
#include "copula/frailty.hpp"
#include "families/independence.hpp"

namespace sklar::families::clayton {

/// k theta, exactly -1 where it is.
template <class T>
T multiple(const T& k, double theta) {
  return std::fma(static_cast<double>(k.value), theta, 1.0) == 0 ? T(-1) : k * T(theta);
}

/// What depends on theta and the dimension alone.
template <class T>
struct Constants {
  Constants(int dim, double parameter)
      : theta(parameter),
        log_rising(cumulative<T>(dim + 2, [&](const auto& k) { return log1p(multiple(k, parameter)); })) {}

  T theta;
  std::vector<T> log_rising;  // entry k: sum_{i<k} log(1 + i theta)
};

/// Vector kernels, or null for theta without. @param log_rising sum_{i<k} log(1 + i theta) for k = 0 .. d.
[[nodiscard]] std::shared_ptr<const Kernels> kernels(double theta, std::vector<double> log_rising);

class Clayton {
 public:
  Clayton(int dim, double theta)
      : theta_(theta), constants_(std::make_shared<const PerPrecision<Constants>>(dim, theta)) {}

  template <class T>
  T log_psi(const T& t) const {
    const T base = T(theta_) * t;
    if (not_positive(T(1) + base)) return T(-kInfinity);
    return -log1p(base) / T(theta_);
  }

  template <class T>
  T psi_inv(const T& u) const {
    return expm1(scaled(u)) / T(theta_);
  }

  template <class T>
  T log_abs_dpsi(int k, const T& t) const {
    const T base = T(theta_) * t;
    if (not_positive(T(1) + base)) return T(-kInfinity);
    return constants<T>().log_rising[static_cast<std::size_t>(k)] -
           exponent<T>(static_cast<std::size_t>(k)) * log1p(base);
  }

  template <class T>
  T log_density(std::span<const T> u) const {
    const T& smallest = smallest_of(u);
    if (is_zero(smallest)) return log_density_at_zeros(u);
    const bool small = -theta_ * std::log(static_cast<double>(smallest.value)) < kSmall;
    return small ? log_density_direct(u) : log_density_scaled(u, smallest);
  }

  // -log(S) / theta, for theta > 0 relative to the smallest u.
  template <class T>
  T log_cdf(std::span<const T> u) const {
    if (theta_ < 0) {
      T s(0);  // S - 1
      for (const T& value : u) s += expm1(scaled(value));
      if (s > T(-0.5)) return -log1p(s) / T(theta_);
      const T total = sum(u);
      return not_positive(total) ? T(-kInfinity) : -log(total) / T(theta_);
    }
    const T& smallest = smallest_of(u);
    const T log_smallest = log(smallest);
    T unused(0);
    return log_smallest - log1p(scaled_rest(u, smallest, log_smallest, unused)) / T(theta_);
  }

  // For theta > 0, given a 0 the next coordinate is 0. For theta < 0, given values at the edge of the support or beyond
  // it is 1.
  template <class T>
  T log_conditional(std::span<const T> u) const {
    const auto given = u.first(u.size() - 1);
    if (theta_ > 0) {
      return count_zeros(given) > 0 ? T(0) : -exponent<T>(given.size()) * log1p_increment(given, u.back());
    }
    const T s = sum(given);
    if (not_positive(s)) return T(-kInfinity);
    const T ratio = expm1(scaled(u.back())) / s;
    return not_positive(T(1) + ratio) ? T(-kInfinity) : -exponent<T>(given.size()) * log1p(ratio);
  }

  // h = (1 + D/S)^-(j + 1/theta) with D = expm1(x_k), so D = S expm1(-log p / (j + 1/theta)) and -log v =
  // log1p(D)/theta.
  template <class T>
  T conditional_inverse(std::span<const T> given, const T& p) const {
    const T s = sum(given);
    if (not_positive(s)) return T(0);
    const T power = exponent<T>(given.size());
    const bool on_surface = is_zero(power);  // a single v, where D = -S
    const T y = on_surface ? T(-kInfinity) : -log(p) / power;
    const T growth = s * expm1(y);
    if (growth > T(-0.5)) return log1p(growth) / T(theta_);
    T missing(0);  // 1 - S
    for (const T& value : given) missing -= expm1(scaled(value));
    return log(missing + s * exp(y)) / T(theta_);
  }

  [[nodiscard]] std::shared_ptr<const Kernels> kernels(int dim) const {
    std::vector<double> log_rising;
    for (int k = 0; k <= dim; ++k)
      log_rising.push_back(static_cast<double>(constants<Extended>().log_rising[static_cast<std::size_t>(k)].value));
    return clayton::kernels(theta_, std::move(log_rising));
  }

  [[nodiscard]] bool has_frailty() const { return theta_ > 0; }
  double log_frailty(Rng& rng) const { return frailty::log_gamma(rng, 1 / theta_) + std::log(theta_); }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kSmall = 1.0;  // largest x_i of the direct form; beyond it S may overflow

  template <class T>
  T scaled(const T& u) const {
    return -T(theta_) * log(u);
  }

  // S = 1 + sum expm1(x_i), as e^(x_m) + sum_{i != m} expm1(x_i), m the smallest value: e^(x_m) may be far below 1
  // where all others are 1.
  template <class T>
  T sum(std::span<const T> u) const {
    const T& smallest = smallest_of(u);
    T s = exp(scaled(smallest));
    for (const T& value : u) {
      if (&value != &smallest) s += expm1(scaled(value));
    }
    return s;
  }

  template <class T>
  const Constants<T>& constants() const {
    return constants_->template get<T>();
  }

  // k + 1/theta = (1 + k theta) / theta
  template <class T>
  T exponent(std::size_t k) const {
    return (T(1) + multiple(T(static_cast<int>(k)), theta_)) / constants<T>().theta;
  }

  // log c = sum_{k<d} log1p(k theta) - (1 + theta) sum log u_i - (d + 1/theta) log1p(s), s = S - 1; also the form for
  // theta < 0, where the density is 0 once S <= 0.
  template <class T>
  T log_density_direct(std::span<const T> u) const {
    Total<T> excess, sum_of_logs;
    for (const T& value : u) {
      const T log_value = log(value);
      excess += expm1(-T(theta_) * log_value);
      sum_of_logs += log_value;
    }
    const T s = excess.value(), logs = sum_of_logs.value();
    if (not_positive(T(1) + s)) return T(-kInfinity);
    return constants<T>().log_rising[u.size()] - (T(1) + T(theta_)) * logs - exponent<T>(u.size()) * log1p(s);
  }

  // n zeros replaced by eps: for theta > 0 the density behaves like eps^(theta (d - n) - (n - 1)); for theta < 0 only
  // one zero among ones is at the edge of the support, and the density like eps^(theta (d - 1)).
  template <class T>
  T log_density_at_zeros(std::span<const T> u) const {
    const int zeros = count_zeros(u);
    const int d = static_cast<int>(u.size());
    if (theta_ < 0) {
      const bool at_edge = zeros == 1 && count_ones(u) == d - 1;
      const bool has_density = constants<T>().log_rising[u.size()].value > -kInfinity;
      return T(at_edge && has_density ? kInfinity : -kInfinity);
    }
    const double power = theta_ * (d - zeros) - (zeros - 1);
    if (power != 0) return T(power > 0 ? -kInfinity : kInfinity);
    T log_c = constants<T>().log_rising[u.size()] - exponent<T>(u.size()) * log(T(zeros));
    for (const T& value : u) {
      if (!is_zero(value)) log_c -= (T(1) + constants<T>().theta) * log(value);
    }
    return log_c;
  }

  template <class T>
  T log_density_scaled(std::span<const T> u, const T& smallest) const {
    T log_ratios(0);
    const T log_smallest = log(smallest);
    const T rest = scaled_rest(u, smallest, log_smallest, log_ratios);
    const Constants<T>& c = constants<T>();
    return c.log_rising[u.size()] - (T(1) + c.theta) * log_ratios - T(static_cast<int>(u.size()) - 1) * log_smallest -
           exponent<T>(u.size()) * log1p(rest);
  }

  // S e^(-x_m) - 1 >= 0, theta > 0, m the smallest value, an entry of u; log_ratios becomes sum log(u_i / m).
  template <class T>
  T scaled_rest(std::span<const T> u, const T& smallest, const T& log_smallest, T& log_ratios) const {
    Total<T> rest, ratios;
    for (const T& value : u) {
      if (&value == &smallest) continue;
      const T log_value = log(value);
      const T ratio = log_ratio(value, smallest, log_value, log_smallest);
      ratios += ratio;
      rest += -(exp(-T(theta_) * ratio) * expm1(T(theta_) * log_value));
    }
    log_ratios = ratios.value();
    return rest.value();
  }

  // log(1 + D/S), D = expm1(x_k) from the last value v: the growth of S by one more coordinate, theta > 0.
  template <class T>
  T log1p_increment(std::span<const T> given, const T& v) const {
    const T& smallest = smallest_of(given);
    const T log_smallest = log(smallest);
    T unused(0);
    const T shift = -T(theta_) * log_ratio(v, smallest, log(v), log_smallest);
    const T weight = -expm1(-scaled(v)) / (T(1) + scaled_rest(given, smallest, log_smallest, unused));
    // D/S = weight e^shift; for shift > 1 weight is of order 1 and the exponential may be huge.
    return shift > T(1) ? shift + log(weight + exp(-shift)) : log1p(weight * exp(shift));
  }

  double theta_;
  std::shared_ptr<const PerPrecision<Constants>> constants_;
};

/// -1/(d-1), rounded into the domain.
inline double lowest_theta(int dim) {
  const double lowest = -1.0 / (dim - 1);
  return std::fma(lowest, dim - 1, 1.0) < 0 ? std::nextafter(lowest, 0.0) : lowest;
}

inline Clayton generator(int dim, const Theta& theta) {
  return {dim, theta[0]};
}

inline FamilyInfo info() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {
      .name = "clayton",
      .title = "Clayton",
      .psi = "(1+theta*t)^(-1/theta)",
      .source = "Nelsen 2006, eq. 4.2.1",
      .parameters = {{"theta",
                      [](int dim) {
                        return Interval{lowest_theta(dim), kInfinity};
                      }}},
      .examples = {{1e-3}, {0.5}, {2.0}, {20.0}, {200.0}, {-0.05}, {-0.3}, {-0.8}},
      .make_unchecked = [](int dim, const Theta& theta) -> CopulaPtr {
        if (theta[0] == 0) return std::make_shared<independence::Independence>(dim);
        return std::make_shared<Archimedean<Clayton>>(dim, generator(dim, theta));
      },
      .tau = [](const Theta& theta) { return 1 / (1 + 2 / theta[0]); },
      .theta_from_tau = [](double tau) { return Theta{2 * tau / (1 - tau)}; },
      .tails =
          [](const Theta& theta) {
            return TailDependence{theta[0] > 0 ? std::exp2(-1 / theta[0]) : 0.0, 0.0};
          },
  };
}

}  // namespace sklar::families::clayton
