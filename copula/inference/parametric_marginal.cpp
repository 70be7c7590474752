#include "copula/inference/parametric_marginal.hpp"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "copula/error.hpp"

namespace sklar {
namespace {

using Real = long double;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Real kRootHalf = 0.707106781186547524400844362104849L;
constexpr Real kLogRootTwoPi = 0.918938533204672741780329736405618L;

/// Values beyond the range of numbers are 0 or infinite.
using Quiet = boost::math::policies::policy<boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
                                            boost::math::policies::underflow_error<boost::math::policies::ignore_error>,
                                            boost::math::policies::denorm_error<boost::math::policies::ignore_error>>;
constexpr Quiet kQuiet;

void require(bool valid, const char* margin, const char* parameter, const char* allowed, double value) {
  if (valid) return;
  throw std::domain_error(std::string(margin) + " margin: " + parameter + " must be " + allowed + ", got " +
                          to_text(value));
}

void require_positive(const char* margin, const char* parameter, double value) {
  require(value > 0 && std::isfinite(value), margin, parameter, "finite and above 0", value);
}

struct Miss {
  Real value;  ///< log of a tail over the mass it should have, with the sign by which it rises in t
  Real slope;
};

/// The t where miss(t).value is 0, by Newton's method within a bracket. The logarithm of a tail is concave in the
/// logarithm of the distance from the end of the support, which makes the steps safe.
template <class MissAt>
Real root_of(const MissAt& miss, Real t) {
  constexpr int kMostSteps = 200;
  constexpr Real kLastStep = 1e-15L;  // relative; what is left is its square
  Real low = -11000, high = 11000;    // of log x, beyond the range of double
  for (int step = 0; step < kMostSteps; ++step) {
    const Miss at = miss(t);
    (at.value < 0 ? low : high) = t;
    Real next = t - at.value / at.slope;
    if (!(next >= low && next <= high)) next = 0.5L * (low + high);
    const bool done = std::abs(next - t) <= kLastStep * std::max(Real(1), std::abs(t));
    t = next;
    if (done) break;
  }
  return t;
}

/// slope * log(x), the limit 0 for slope 0.
Real times_log(Real slope, Real x) {
  return slope == 0 ? 0 : slope * std::log(x);
}

}  // namespace

NormalMarginal::NormalMarginal(double mean, double sd) : mean_(mean), sd_(sd) {
  require(std::isfinite(mean), "normal", "mean", "finite", mean);
  require_positive("normal", "sd", sd);
}

double NormalMarginal::cdf(double x) const {
  const Real z = (Real(x) - mean_) / sd_;
  return static_cast<double>(0.5L * std::erfc(-z * kRootHalf));
}

double NormalMarginal::quantile(double p) const {
  if (std::isnan(p)) return p;
  assert(p >= 0 && p <= 1);
  if (p == 0 || p == 1) return p == 0 ? -kInfinity : kInfinity;
  // 1 - p is exact from 1/2 on.
  const Real z =
      (p < 0.5 ? -boost::math::erfc_inv(2 * Real(p), kQuiet) : boost::math::erfc_inv(2 * (1 - Real(p)), kQuiet)) /
      kRootHalf;
  return static_cast<double>(mean_ + sd_ * z);
}

double NormalMarginal::log_pdf(double x) const {
  const Real z = (Real(x) - mean_) / sd_;
  return static_cast<double>(-0.5L * z * z - std::log(Real(sd_)) - kLogRootTwoPi);
}

GammaMarginal::GammaMarginal(double shape, double scale) : shape_(shape), scale_(scale) {
  require_positive("gamma", "shape", shape);
  require_positive("gamma", "scale", scale);
  log_constant_ = -boost::math::lgamma(Real(shape), kQuiet) - std::log(Real(scale));
}

double GammaMarginal::cdf(double x) const {
  if (std::isnan(x)) return x;
  if (x <= 0) return 0;
  if (x == kInfinity) return 1;
  return static_cast<double>(boost::math::gamma_p(Real(shape_), Real(x) / scale_, kQuiet));
}

double GammaMarginal::quantile(double p) const {
  if (std::isnan(p)) return p;
  assert(p >= 0 && p <= 1);
  if (p == 0 || p == 1) return p == 0 ? 0 : kInfinity;
  const bool upper = p > 0.5;
  const Real mass = upper ? 1 - Real(p) : Real(p), shape = shape_, log_gamma = boost::math::lgamma(shape, kQuiet);
  const auto miss = [&](Real t) {
    const Real x = std::exp(t);
    const Real tail = upper ? boost::math::gamma_q(shape, x, kQuiet) : boost::math::gamma_p(shape, x, kQuiet);
    const Real slope = std::exp(shape * t - x - log_gamma) / tail;
    return Miss{upper ? std::log(mass / tail) : std::log(tail / mass), slope};
  };
  return static_cast<double>(scale_ * std::exp(root_of(miss, std::log(shape))));
}

double GammaMarginal::log_pdf(double x) const {
  if (std::isnan(x)) return x;
  if (x < 0 || x == kInfinity) return -kInfinity;
  const Real t = Real(x) / scale_;
  return static_cast<double>(times_log(Real(shape_) - 1, t) - t + log_constant_);
}

BetaMarginal::BetaMarginal(double a, double b, double lowest, double highest)
    : a_(a), b_(b), lowest_(lowest), highest_(highest), width_(Real(highest) - lowest) {
  require_positive("beta", "a", a);
  require_positive("beta", "b", b);
  require(std::isfinite(lowest), "beta", "the lower end", "finite", lowest);
  require(std::isfinite(highest) && highest > lowest, "beta", "the upper end", "finite and above the lower", highest);
  log_constant_ = boost::math::lgamma(Real(a) + b, kQuiet) - boost::math::lgamma(Real(a), kQuiet) -
                  boost::math::lgamma(Real(b), kQuiet) - std::log(width_);
}

double BetaMarginal::cdf(double x) const {
  if (std::isnan(x)) return x;
  if (x <= lowest_) return 0;
  if (x >= highest_) return 1;
  // From the nearer end, whose distance is exact.
  const Real y = (Real(x) - lowest_) / width_, rest = (Real(highest_) - x) / width_;
  return static_cast<double>(y < rest ? boost::math::ibeta(Real(a_), Real(b_), y, kQuiet)
                                      : boost::math::ibetac(Real(b_), Real(a_), rest, kQuiet));
}

double BetaMarginal::quantile(double p) const {
  if (std::isnan(p)) return p;
  assert(p >= 0 && p <= 1);
  if (p == 0 || p == 1) return p == 0 ? lowest_ : highest_;
  const bool upper = p > 0.5;
  const Real mass = upper ? 1 - Real(p) : Real(p), a = a_, b = b_, log_beta = -log_constant_ - std::log(width_);
  // t = log(y / (1 - y)).
  const auto miss = [&](Real t) {
    const Real y = 1 / (1 + std::exp(-t)), rest = 1 / (1 + std::exp(t));
    const bool by_y = t < 0;
    const Real tail = upper == by_y ? boost::math::ibetac(by_y ? a : b, by_y ? b : a, by_y ? y : rest, kQuiet)
                                    : boost::math::ibeta(by_y ? a : b, by_y ? b : a, by_y ? y : rest, kQuiet);
    const Real slope = std::exp(a * std::log(y) + b * std::log(rest) - log_beta) / tail;
    return Miss{upper ? std::log(mass / tail) : std::log(tail / mass), slope};
  };
  const Real t = root_of(miss, std::log(a / b));
  return static_cast<double>(t < 0 ? lowest_ + width_ / (1 + std::exp(-t)) : highest_ - width_ / (1 + std::exp(t)));
}

double BetaMarginal::log_pdf(double x) const {
  if (std::isnan(x)) return x;
  if (x < lowest_ || x > highest_) return -kInfinity;
  const Real y = (Real(x) - lowest_) / width_, rest = (Real(highest_) - x) / width_;
  return static_cast<double>(times_log(Real(a_) - 1, y) + times_log(Real(b_) - 1, rest) + log_constant_);
}

}  // namespace sklar
