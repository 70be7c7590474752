// The routes of ArchimedeanCopula::sample_by.

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

Points ArchimedeanCopula::sample_by(Route route, Index n, Rng& rng) const {
  if (route == Route::conditional) return sample(n, rng);
  if (n < 1) throw std::invalid_argument("sample: n must be 1 or more, got " + std::to_string(n));
  if (route == Route::frailty && !has_frailty()) {
    throw std::domain_error("sample: this copula has no frailty; routes are conditional and radial");
  }
  Points u(n, dim());
  std::vector<double> row(static_cast<std::size_t>(dim()));
  for (Index i = 0; i < n; ++i) {
    route == Route::frailty ? frailty_point(rng, row) : radial_point(rng, row);
    for (Index k = 0; k < dim(); ++k) u(i, k) = row[static_cast<std::size_t>(k)];
  }
  return u;
}

void ArchimedeanCopula::frailty_point(Rng& rng, std::span<double> u) const {
  const double log_v = log_frailty(rng);
  for (double& value : u) value = psi_at_log(std::log(frailty::exponential(rng)) - log_v);
}

void ArchimedeanCopula::radial_point(Rng& rng, std::span<double> u) const {
  const double log_survival = std::log(uniform(rng));
  const double log_r = find_crossing([&](double x) { return log_radial_survival(x) - log_survival; });
  double sum = 0;
  for (double& value : u) sum += value = frailty::exponential(rng);
  for (double& value : u) value = psi_at_log(log_r + std::log(value / sum));
}

}  // namespace sklar
