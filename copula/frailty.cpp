#include "copula/frailty.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sklar::frailty {

namespace {

/// Marsaglia's polar method.
double normal(Rng& rng) {
  for (;;) {
    const double x = 2 * uniform(rng) - 1, y = 2 * uniform(rng) - 1;
    const double square = x * x + y * y;
    if (square < 1 && square > 0) return x * std::sqrt(-2 * std::log(square) / square);
  }
}

constexpr double kNegligible = 37;  // 1 + e^-37 = 1 to the last digit

/// log of the smallest integer >= e^x, or x itself where integers are no sparser than the doubles.
double log_ceil(double x) {
  return x < kNegligible ? std::log(std::ceil(std::exp(x))) : x;
}

}  // namespace

double exponential(Rng& rng) {
  return -std::log(uniform(rng));
}

double log_gamma(Rng& rng, double shape) {
  if (shape < 1) return log_gamma(rng, shape + 1) - exponential(rng) / shape;
  const double d = shape - 1.0 / 3, c = 1 / std::sqrt(9 * d);
  for (;;) {
    const double x = normal(rng);
    const double root = 1 + c * x;
    if (root <= 0) continue;
    const double log_v = 3 * std::log(root);
    if (std::log(uniform(rng)) < 0.5 * x * x + d * (1 - std::exp(log_v) + log_v)) return std::log(d) + log_v;
  }
}

double log_positive_stable(Rng& rng, double alpha) {
  const double w = uniform(rng), log_e = std::log(exponential(rng));
  if (alpha == 1) return 0;
  // sin(pi w) from the nearer end, where its argument is exact.
  const double sine = std::sin(std::numbers::pi * std::min(w, 1 - w));
  const double rest = (1 - alpha) * (std::log(std::sin(std::numbers::pi * (1 - alpha) * w)) - log_e);
  return std::log(std::sin(std::numbers::pi * alpha * w)) + (rest - std::log(sine)) / alpha;
}

// V is geometric with q = 1 - (1-p)^u.
double log_logarithmic(Rng& rng, double h) {
  const double log_e = std::log(exponential(rng)), x = h * uniform(rng);
  const double log_minus_log_q = x > kNegligible ? -x : std::log(-std::log(-std::expm1(-x)));
  return std::max(log_ceil(log_e - log_minus_log_q), 0.0);
}

// 1 - w = 1 / (1 + a/b) of the gamma variates of w.
double log_sibuya(Rng& rng, double alpha) {
  if (alpha == 1) return 0;
  const double log_a = log_gamma(rng, alpha), log_b = log_gamma(rng, 1 - alpha), log_e = std::log(exponential(rng));
  const double x = log_a - log_b;
  const double minus_log = x > 0 ? x + std::log1p(std::exp(-x)) : std::log1p(std::exp(x));  // -log(1 - w)
  return std::max(log_ceil(log_e - (x < -kNegligible ? x : std::log(minus_log))), 0.0);
}

double log_geometric(Rng& rng, double q) {
  const double log_e = std::log(exponential(rng));
  return q == 0 ? 0.0 : std::max(log_ceil(log_e - std::log(-std::log(q))), 0.0);
}

}  // namespace sklar::frailty
