// The routes of an Archimedean copula.

#include <boost/math/tools/roots.hpp>
#include <cmath>

#include "copula/archimedean_copula.hpp"
#include "copula/error.hpp"
#include "copula/frailty.hpp"

namespace sklar {

namespace {

/// The x where a decreasing function crosses 0, or jumps over it. Infinite values stand for large ones.
template <class F>
double find_crossing(const F& decreasing) {
  constexpr double kLarge = 1e300;
  const auto f = [&](double x) { return std::clamp(decreasing(x), -kLarge, kLarge); };
  double low = 0, high = 0, step = 1;
  double at_low = f(0), at_high = at_low;
  for (; at_low < 0; step *= 2) at_low = f(low -= step);
  for (step = 1; at_high > 0; step *= 2) at_high = f(high += step);
  if (at_low == 0 || at_high == 0) return at_low == 0 ? low : high;
  std::uintmax_t most_steps = 200;
  const boost::math::tools::eps_tolerance<double> done(48);
  const auto [left, right] = boost::math::tools::toms748_solve(f, low, high, at_low, at_high, done, most_steps);
  return 0.5 * (left + right);
}

}  // namespace

void ArchimedeanCopula::draw(Route route, const Reflection& reflection, Rng& rng, std::span<double> u) const {
  route == Route::frailty ? frailty_point(reflection, rng, u) : radial_point(reflection, rng, u);
}

/// psi(t), or where reflected 1 - psi(t).
double ArchimedeanCopula::coordinate(double log_t, bool reflected) const {
  return psi_at_log(log_t, reflected ? Tail::upper : Tail::lower);
}

void ArchimedeanCopula::frailty_point(const Reflection& reflection, Rng& rng, std::span<double> u) const {
  const double log_v = log_frailty(rng);
  for (std::size_t k = 0; k < u.size(); ++k) {
    u[k] = coordinate(std::log(frailty::exponential(rng)) - log_v, reflection[k]);
  }
}

void ArchimedeanCopula::radial_point(const Reflection& reflection, Rng& rng, std::span<double> u) const {
  const double log_survival = std::log(uniform(rng));
  const double log_r = find_crossing([&](double x) { return log_radial_survival(x) - log_survival; });
  double sum = 0;
  for (double& value : u) sum += value = frailty::exponential(rng);
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = coordinate(log_r + std::log(u[k] / sum), reflection[k]);
}

}  // namespace sklar
