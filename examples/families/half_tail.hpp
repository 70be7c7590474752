#pragma once
/// Half-tail copula, a family in the form of those in families/.
///   psi(t) = (1-theta) e^-t + theta / (1+t),  the Laplace transform of a frailty that is 1, or exponential with
///   probability theta;  psi^-1 by Newton's method
///   0 < theta < 1 in any dimension;  tau = c theta - (c - 1/3) theta^2, c = 10 - 16 e E_1(1)
///   lambda_L = 1/2 for every theta;  lambda_U = 0
/// tau = 1 + 4 int t psi'(t) du at psi(t) = u (Nelsen 2006, Corollary 5.1.4).
///
/// Where psi is near 1 its logarithm is that of 1 - psi = (1-theta)(1 - e^-t) + theta t / (1+t), all terms positive.

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "copula/archimedean.hpp"
#include "copula/family.hpp"
#include "copula/numerics.hpp"

namespace sklar::families::half_tail {

class HalfTail {
 public:
  explicit HalfTail(double theta) : theta_(theta) {}

  template <class T>
  T log_psi(const T& t) const {
    const T lost = T(theta_) * t / (T(1) + t) - (T(1) - T(theta_)) * expm1(-t);
    return lost < T(0.5) ? log1p(-lost) : log_abs_dpsi(0, t);
  }

  template <class T>
  T psi_inv(const T& u) const {
    if (is_zero(u)) return T(std::numeric_limits<double>::infinity());
    const auto rate = [this](const T& t) {
      const T log_psi_t = log_psi(t);
      return std::pair<T, T>(-log_psi_t, exp(log_abs_dpsi(1, t) - log_psi_t));
    };
    return solve_increasing(rate, T(-log(u)), T(-log(u)));
  }

  template <class T>
  T log_abs_dpsi(int k, const T& t) const {
    T log_factorial(0);
    for (int i = 2; i <= k; ++i) log_factorial += log(T(i));
    return log_add_exp(log(T(1) - T(theta_)) - t, log(T(theta_)) + log_factorial - T(k + 1) * log1p(t));
  }

  [[nodiscard]] bool has_frailty() const { return true; }
  double log_frailty(Rng& rng) const { return uniform(rng) < theta_ ? std::log(-std::log(uniform(rng))) : 0; }

 private:
  double theta_;
};

/// 10 - 16 e E_1(1)
inline constexpr double kSlope = 0.4584422028288948;

inline HalfTail generator(int, const Theta& theta) {
  return HalfTail(theta[0]);
}

inline FamilyInfo info() {
  return {
      .name = "half_tail",
      .title = "Half-tail",
      .psi = "(1-theta)*exp(-t)+theta/(1+t)",
      .source = "examples/families/half_tail.hpp",
      .parameters = {{"theta",
                      [](int) {
                        return Interval{0, 1, false, false};
                      }}},
      .examples = {{0.01}, {0.5}, {0.99}},
      .make_unchecked = [](int dim, const Theta& theta) -> CopulaPtr {
        return std::make_shared<Archimedean<HalfTail>>(dim, generator(dim, theta));
      },
      .tau = [](const Theta& theta) { return theta[0] * (kSlope - (kSlope - 1.0 / 3) * theta[0]); },
      .theta_from_tau =
          [](double tau) {
            return Theta{2 * tau / (kSlope + std::sqrt(kSlope * kSlope - 4 * (kSlope - 1.0 / 3) * tau))};
          },
      .tails =
          [](const Theta&) {
            return TailDependence{0.5, 0.0};
          },
  };
}

}  // namespace sklar::families::half_tail
