#pragma once
/// Gumbel (Gumbel-Hougaard) copula.
///   psi(t) = exp(-t^(1/theta)),  psi^-1(u) = (-log u)^theta
///   theta >= 1 in any dimension (theta = 1: independence)
///   tau = 1 - 1/theta;  lambda_L = 0, lambda_U = 2 - 2^(1/theta)
/// Nelsen (2006), eq. 4.2.4; Hofert, Maechler and McNeil (2012), JMVA 110 (derivatives).
///
/// With s = t^(1/theta): |psi^(d)| = e^-s (s / (theta t))^d R_d(1/s), R_n with positive coefficients r(n,k), r(n,0) = 1
/// (the usual alternating Stirling sums lose every digit for moderate d). With x_i = -log u_i:
///   log c = (theta-1) sum log(x_i/s) + (sum x_i - s) + log R_d(1/s)
/// s is taken relative to the largest x, so that sum x_i - s and log(x_i/s) do not cancel.
/// Given one value, h = p is solved by Lambert's W: copula/lambert_w.hpp.

#include <algorithm>
#include <limits>

#include "copula/archimedean.hpp"
#include "copula/family.hpp"
#include "copula/frailty.hpp"
#include "copula/lambert_w.hpp"
#include "copula/scaled_polynomials.hpp"
#include "families/independence.hpp"

namespace sklar::families::gumbel {

/// The coefficients of R_n: r(n+1,k) = r(n,k) + (theta n - (n+1-k)) r(n,k-1), the factor as (k-1) + n (theta-1).
struct Rule {
  double theta;

  [[nodiscard]] int exponent(int n) const { return (n < 4 ? 0 : std::ilogb(n) - 1) + std::ilogb(theta); }

  template <class T>
  [[nodiscard]] T same(int, int) const {
    return T(1);
  }

  template <class T>
  [[nodiscard]] T left(int n, int k) const {
    return T(k - 1) + T(n - 1) * (T(theta) - T(1));
  }
};

/// Vector kernels, or null for theta without. @param polynomials R_n at n, to R_d in dimension d.
[[nodiscard]] std::shared_ptr<const Kernels> kernels(double theta, std::vector<Coefficients> polynomials);

class Gumbel {
 public:
  Gumbel(int dim, double theta) : theta_(theta), polynomials_(dim + 1, Rule{theta}) {}

  template <class T>
  T log_psi(const T& t) const {
    return -root(t);
  }

  template <class T>
  T psi_inv(const T& u) const {
    return exp(T(theta_) * log(-log(u)));
  }

  template <class T>
  T log_abs_dpsi(int k, const T& t) const {
    const T s = root(t);
    if (k == 0) return -s;
    if (t.value == 0 && t.error == 0) return T(std::numeric_limits<double>::infinity());
    if (std::isinf(static_cast<double>(t.value)) && t.error == 0) return -t;
    return -s + T(k) * (log(s) - log(t) - log(T(theta_))) + polynomials_.log_value(k, T(1), s);
  }

  template <class T>
  T log_density(std::span<const T> u) const {
    if (on_boundary(u)) return T(log_density_on_boundary(u));
    const Accumulated<T> sums = accumulate(u);
    const int d = static_cast<int>(u.size());
    const T log_ratios = sums.log_ratios - T(d) * sums.log_stretch;
    const T gap = sums.others - sums.largest * sums.stretch;
    return (T(theta_) - T(1)) * log_ratios + gap + polynomials_.log_value(d, T(1), sums.s());
  }

  template <class T>
  T log_cdf(std::span<const T> u) const {
    return all_ones(u) ? T(0) : -accumulate(u).s();
  }

  // Given a 0 the next coordinate is 0; given nothing but ones it is 1.
  template <class T>
  T log_conditional(std::span<const T> u) const {
    const auto given = u.first(u.size() - 1);
    if (count_zeros(given) > 0) return T(0);
    if (all_ones(given)) return T(-std::numeric_limits<double>::infinity());
    const Conditional<T> conditional(*this, given);
    return -conditional.decrease(conditional.log_growth(u.back())).first;
  }

  template <class T>
  T conditional_inverse(std::span<const T> given, const T& p) const {
    if (count_zeros(given) > 0) return T(std::numeric_limits<double>::infinity());
    if (all_ones(given)) return T(0);
    if (given.size() == 1) return conditional_inverse_pair(given[0], p);
    const Conditional<T> conditional(*this, given);
    const auto rate = [&](const T& log_growth) { return conditional.decrease(log_growth); };
    const T target = -log(p);
    return conditional.value(solve_increasing(rate, target, target / conditional.slope_at_0()));
  }

  [[nodiscard]] std::shared_ptr<const Kernels> kernels(int dim) const {
    return gumbel::kernels(theta_, polynomials_.coefficients_to(dim));
  }

  [[nodiscard]] bool has_frailty() const { return true; }
  double log_frailty(Rng& rng) const { return frailty::log_positive_stable(rng, 1 / theta_); }

 private:
  template <class T>
  struct Accumulated {
    T largest;      // x_m = max x_i
    T others;       // sum of the other x_i
    T log_ratios;   // sum log(x_i / x_m)
    T log_powers;   // log sum (x_i / x_m)^theta
    T log_stretch;  // log(s / x_m)
    T stretch;      // s / x_m - 1

    [[nodiscard]] T s() const { return largest * (T(1) + stretch); }
  };

  template <class T>
  static bool on_boundary(std::span<const T> u) {
    return std::ranges::any_of(u, [](const T& value) { return is_zero(value) || is_one(value); });
  }

  // n zeros replaced by eps, m ones by 1 - eps: the density behaves like eps^(m (theta-1) - n + n^(1/theta)), n >= 2;
  // like 0 for n = 1 and for n = 0 unless all are ones.
  template <class T>
  double log_density_on_boundary(std::span<const T> u) const {
    const double zeros = count_zeros(u), ones = count_ones(u);
    const bool infinite =
        zeros == 0 ? all_ones(u) : zeros > 1 && zeros - std::pow(zeros, 1 / theta_) > ones * (theta_ - 1);
    return infinite ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  }

  // t^(1/theta)
  template <class T>
  T root(const T& t) const {
    return exp(log(t) / T(theta_));
  }

  template <class T>
  Accumulated<T> accumulate(std::span<const T> u) const {
    const T& smallest = smallest_of(u);
    const T log_smallest = log(smallest);
    const T largest = -log_smallest;
    Total<T> others, log_ratios, powers;
    for (const T& value : u) {
      if (&value == &smallest) continue;
      const T log_value = log(value);
      const T ratio = log_of_ratio(value, smallest, log_value, log_smallest);
      others += -log_value;
      log_ratios += ratio;
      powers += exp(T(theta_) * ratio);
    }
    const T log_powers = log1p(powers.value());
    const T log_stretch = log_powers / T(theta_);
    return {largest, others.value(), log_ratios.value(), log_powers, log_stretch, expm1(log_stretch)};
  }

  // l = log(s_2/s_1), x_1 (e^l - 1) + (theta-1) l = -log p, in closed form. The left side is convex and 0 at 0, so l is
  // relatively no farther from the root than the value there from -log p.
  template <class T>
  T conditional_inverse_pair(const T& given, const T& p) const {
    const T x = -log(given), theta(theta_), excess = theta - T(1), target = -log(p);
    T l(log_lambert(x.value, excess.value, target.value), 0);
    const T level = x * expm1(l) + excess * l;
    l.error = largest_magnitude((level - target) / level * l);
    return x * exp(log_expm1(theta * l) / theta);
  }

  // log(x / x_m) from u and m, by the difference of the two where they are near each other.
  template <class T>
  static T log_of_ratio(const T& u, const T& m, const T& log_u, const T& log_m) {
    const T difference = log_ratio(u, m, log_u, log_m) / -log_m;
    return difference < T(0.5) ? log1p(-difference) : log(log_u / log_m);
  }

  // -log h as a function of l = log(s_k / s_j), j values given:
  //   s_j expm1(l) + j (theta-1) l - log( R_j(e^-l / s_j) / R_j(1 / s_j) ), all terms positive.
  template <class T>
  class Conditional {
   public:
    Conditional(const Gumbel& gumbel, std::span<const T> given)
        : gumbel_(gumbel), order_(static_cast<int>(given.size())), smallest_(smallest_of(given)) {
      const Accumulated<T> sums = gumbel.accumulate(given);
      log_smallest_ = -sums.largest;
      log_powers_ = sums.log_powers;
      s_ = sums.s();
      log_s_ = log(sums.largest) + sums.log_stretch;
    }

    /// log(s_k / s_j) = log(1 + (x_k/s_j)^theta) / theta for the next coordinate v.
    [[nodiscard]] T log_growth(const T& v) const {
      const T theta(gumbel_.theta_);
      const T z = theta * log_of_ratio(v, smallest_, log(v), log_smallest_) - log_powers_;
      return (z > T(0) ? z + log1p(exp(-z)) : log1p(exp(z))) / theta;
    }

    /// The x_k that gives this growth.
    [[nodiscard]] T value(const T& growth) const {
      const T theta(gumbel_.theta_);
      return exp(log_s_ + log_expm1(theta * growth) / theta);
    }

    [[nodiscard]] std::pair<T, T> decrease(const T& l) const {
      const auto [value, slope] = gumbel_.polynomials_.decrease(order_, T(1), s_, exp(-l), -expm1(-l));
      const T constant = T(order_) * (T(gumbel_.theta_) - T(1));
      const T growth = expm1(l);
      return {s_ * growth + constant * l + value, s_ * (T(1) + growth) + constant + slope};
    }

    [[nodiscard]] T slope_at_0() const { return decrease(T(0)).second; }

   private:
    const Gumbel& gumbel_;
    int order_;
    T smallest_;
    T log_smallest_, log_powers_, s_, log_s_;
  };

  double theta_;
  ScaledPolynomials<Rule> polynomials_;
};

inline Gumbel generator(int dim, const Theta& theta) {
  return {dim, theta[0]};
}

inline FamilyInfo info() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {
      .name = "gumbel",
      .title = "Gumbel",
      .psi = "exp(-t^(1/theta))",
      .source = "Nelsen 2006, eq. 4.2.4",
      .parameters = {{"theta",
                      [](int) {
                        return Interval{1.0, kInfinity};
                      }}},
      .examples = {{1.0}, {1.001}, {1.5}, {3.0}, {20.0}, {200.0}},
      .make_unchecked = [](int dim, const Theta& theta) -> CopulaPtr {
        if (theta[0] == 1) return std::make_shared<independence::Independence>(dim);
        return std::make_shared<Archimedean<Gumbel>>(dim, generator(dim, theta));
      },
      .tau = [](const Theta& theta) { return 1 - 1 / theta[0]; },
      .theta_from_tau = [](double tau) { return Theta{1 / (1 - tau)}; },
      .tails =
          [](const Theta& theta) {
            return TailDependence{0.0, 2 - std::exp2(1 / theta[0])};
          },
  };
}

}  // namespace sklar::families::gumbel
