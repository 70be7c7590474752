#pragma once
/// Limits of what depends on a generator's argument as that grows: what coordinates mean that are exactly 0.

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "copula/first_answer.hpp"
#include "copula/generator.hpp"
#include "copula/numerics.hpp"

namespace sklar::symbolic {

/// A generator whose inverse is `far` at 0.
template <class G, class T>
class ZerosAt {
 public:
  ZerosAt(const G& generator, const T& far) : generator_(generator), far_(far) {}

  template <class S>
  [[nodiscard]] S log_psi(const S& t) const {
    return generator_.log_psi(t);
  }
  template <class S>
  [[nodiscard]] S log_abs_dpsi(int k, const S& t) const {
    return generator_.log_abs_dpsi(k, t);
  }
  template <class S>
  [[nodiscard]] S psi_inv(const S& u) const {
    if constexpr (std::is_same_v<S, T>) {
      if (is_zero(u)) return far_;
    }
    return generator_.psi_inv(u);
  }
  template <class S>
  [[nodiscard]] std::pair<S, S> margin(const S& u) const {
    if (is_zero(u)) return {psi_inv(u), log_abs_dpsi(1, psi_inv(u))};
    return generator_.margin(u);
  }

 private:
  const G& generator_;
  T far_;
};

/// Where a function tends that does not settle, from its values at x, 2x, 4x and 8x: 1 to infinity, -1 to -infinity,
/// else 0. Steps of what grows like log x or faster do not shrink, nor do their ratios.
template <class T>
[[nodiscard]] int divergence(std::span<const T, 4> values) {
  std::array<T, 3> steps;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i] = values[i + 1] - values[i];
    const bool known = abs(steps[i]).value > steps[i].error;
    if (!known || (steps[i].value > 0) != (steps[0].value > 0)) return 0;
  }
  const T before = steps[1] / steps[0], ratio = steps[2] / steps[1];
  if (ratio < T(0.9) || ratio < T(0.99) * before) return 0;
  return steps[0].value > 0 ? 1 : -1;
}

/// The limit of f(t) as t -> inf, from t / start = 2^x at x = 6, 12, 24, .. as far as T and f go. A limit that is
/// reached like t^-q has the last step as its error, which is above what is left; one whose values do not settle up to
/// x = 3000 is infinite, or 0 where its logarithm is. For q < 1e-5 that is not told from a limit.
/// @param f T -> T. @param start where f is about to settle.
/// @return with an infinite error bound where f does not show it.
template <class T, class Function>
[[nodiscard]] T limit_at_infinity(const Function& f, const T& start) {
  using Real = std::remove_cvref_t<decltype(T().value)>;
  using std::isfinite;
  constexpr std::size_t kMost = 12, kEnough = 10;  // x = 3072
  constexpr double kCoarse = 1e-3, kInfinity = std::numeric_limits<double>::infinity();
  T limit(std::numeric_limits<Real>::quiet_NaN(), T::unknown());
  std::vector<T> values, logs;
  for (Real factor(64); values.size() < kMost && isfinite(factor); factor = factor * factor) {
    const T next = f(T(Real(start.value * factor), Real(0)));
    if (!isfinite(next.value) || !(next.error >= 0) || !is_within(kCoarse, next)) break;
    values.push_back(next);
    logs.push_back(log(abs(next)));
    if (values.size() < 3) continue;
    const T& last = values[values.size() - 2];
    const T step = abs(next - last), before = abs(last - values[values.size() - 3]);
    const bool at_rest = step.value <= step.error && before.value <= before.error;
    const Real error = next.error + step.value;
    if ((at_rest || step.value < before.value / 4) && error < limit.error) limit = T(next.value, error);
    if (at_rest) return limit;
  }
  if (values.size() < kEnough) return limit;
  if (divergence(std::span<const T>(logs).template last<4>()) < 0) return T(0);
  const int sign = divergence(std::span<const T>(values).template last<4>());
  return sign == 0 ? limit : T(sign * kInfinity);
}

}  // namespace sklar::symbolic
