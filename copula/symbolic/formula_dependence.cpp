#include "copula/symbolic/formula_dependence.hpp"

#include <algorithm>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>

#include "copula/first_answer.hpp"

namespace sklar::symbolic {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kTauTolerance = 1e-11;
constexpr double kTailTolerance = 1e-9;
constexpr double kLatticeTolerance = 1e-9;  // differences of tau that say nothing about its direction

/// -t psi'(t) at psi(t) = u, which tends to 0 at both ends.
double minus_t_slope(const SymbolicGenerator& generator, double u) {
  if (!(u > 0 && u < 1)) return 0;
  const auto value = first_answer(
      [&]<class T>() {
        const T t = generator.psi_inv(T(u));
        return if_within(kTauTolerance, t * exp(generator.log_abs_dpsi(1, t)));
      },
      kFirstDigits);
  return value.value_or(kNaN);
}

/// 2^exponent, as exact.
Widest power_of_two(double exponent) {
  return {exp(Widest(exponent) * log(Widest(2))).value, BigFloat(0)};
}

/// limit(t) at the most extreme t = 2^(sign e) that is resolved.
template <class Limit>
double at_extreme(double sign, const Limit& limit) {
  const WorkingPrecision precision(kFirstDigits);
  for (const double exponent : {0x1p40, 0x1p20, 2000.0, 200.0, 60.0, 30.0}) {
    const auto found = if_within(kTailTolerance, limit(power_of_two(sign * exponent)));
    if (found) return std::abs(*found) < kTailTolerance ? 0 : *found;
  }
  return kNaN;
}

double rounded(double tau) {
  return std::round(tau * 1e9) / 1e9;
}

}  // namespace

double kendall_tau(const SymbolicGenerator& generator) {
  // Not shared: threads that ask it for more nodes at once read them half made (Boost 1.74, extend_refinements).
  boost::math::quadrature::tanh_sinh<double> quadrature;
  bool known = true;
  const auto integrand = [&](double u) {
    const double value = known ? minus_t_slope(generator, u) : 0;  // one that is not resolved settles it
    known = known && !std::isnan(value);
    return std::isnan(value) ? 0.0 : value;
  };
  const double integral = quadrature.integrate(integrand, 0.0, 1.0, kTauTolerance);
  const double tau = 1 - 4 * integral;
  return !known ? kNaN : std::abs(tau) < kTauTolerance ? 0 : tau;
}

TailDependence tail_dependence(const SymbolicGenerator& generator) {
  const auto lower = [&](const Widest& t) {
    const Widest log_psi = generator.log_psi(t);
    if (log_psi.value == -kInfinity) return Widest(0);  // beyond the support
    return exp(generator.log_psi(Widest(2) * t) - log_psi);
  };
  const auto upper = [&](const Widest& t) {
    return Widest(2) - expm1(generator.log_psi(Widest(2) * t)) / expm1(generator.log_psi(t));
  };
  return {at_extreme(1, lower), at_extreme(-1, upper)};
}

TauScale::TauScale(Interval domain, Tau tau) : domain_(domain), tau_(std::move(tau)) {
  constexpr int kFarthest = 30;  // e^30 = 1e13
  constexpr int kStep = 3;
  for (int x = -kFarthest; x <= kFarthest; x += kStep) {
    const double value = tau_(theta_at(x));
    if (std::isnan(value)) continue;
    x_.push_back(x);
    at_x_.push_back(value);
  }
  if (x_.empty() || at_x_.front() == at_x_.back()) return;
  const double direction = at_x_.back() > at_x_.front() ? 1 : -1;
  const auto turns = [&](double a, double b) { return (b - a) * direction < -kLatticeTolerance; };
  monotone_ = std::adjacent_find(at_x_.begin(), at_x_.end(), turns) == at_x_.end();
}

double TauScale::theta_at(double x) const {
  const double lowest = domain_.lowest, highest = domain_.highest;
  if (std::isfinite(lowest) && std::isfinite(highest)) return lowest + (highest - lowest) / (1 + std::exp(-x));
  if (std::isfinite(lowest)) return lowest + std::exp(x);
  return std::isfinite(highest) ? highest - std::exp(-x) : std::sinh(x);
}

double TauScale::tau(double theta) const {
  const double value = domain_.contains(theta) ? tau_(theta) : kNaN;
  if (!std::isnan(value)) return value;
  if (x_.empty()) return kNaN;
  if (theta == domain_.lowest) return rounded(at_x_.front());
  return theta == domain_.highest ? rounded(at_x_.back()) : kNaN;
}

double TauScale::theta(double tau) const {
  const bool rises = at_x_.back() > at_x_.front();
  const auto above = [&](double value) { return rises ? value >= tau : value <= tau; };
  const auto next = static_cast<std::size_t>(std::find_if(at_x_.begin(), at_x_.end(), above) - at_x_.begin());
  if (next == 0) return domain_.contains(domain_.lowest) ? domain_.lowest : theta_at(x_.front());
  if (next == x_.size()) return domain_.contains(domain_.highest) ? domain_.highest : theta_at(x_.back());
  const auto off = [&](double x) { return tau_(theta_at(x)) - tau; };
  if (at_x_[next] == tau) return theta_at(x_[next]);
  std::uintmax_t steps = 100;
  const auto close = [](double a, double b) { return std::abs(b - a) <= 1e-14 * (1 + std::abs(a)); };
  const auto [left, right] = boost::math::tools::toms748_solve(off, x_[next - 1], x_[next], at_x_[next - 1] - tau,
                                                               at_x_[next] - tau, close, steps);
  return theta_at(left + (right - left) / 2);
}

}  // namespace sklar::symbolic
