#include "copula/numerics.hpp"

#include <boost/math/special_functions/bernoulli.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>

namespace sklar {

namespace {

// int_0^x t / (e^t - 1) dt for x >= 2 (A&S 27.1.2); terms fall like e^(-k x), below rounding from x = 50 on.
double debye_integral_from_above(double x) {
  double sum = std::numbers::pi * std::numbers::pi / 6;
  if (x > 50) return sum;
  for (int k = 1; k <= 24; ++k) sum -= std::exp(-k * x) * (x / k + 1.0 / (k * k));
  return sum;
}

}  // namespace

double invert_increasing(const std::function<double(double)>& f, double target, double lowest, double highest) {
  const auto excess = [&](double x) { return f(x) - target; };
  const double below = excess(lowest), above = excess(highest);
  if (below >= 0 || lowest == highest) return lowest;
  if (above <= 0) return highest;
  std::uintmax_t steps = 200;
  const auto [left, right] = boost::math::tools::toms748_solve(excess, lowest, highest, below, above,
                                                               boost::math::tools::eps_tolerance<double>(52), steps);
  return left + (right - left) / 2;
}

double debye_1_defect(double x) {
  if (x < 0) return -debye_1_defect(-x);
  if (x >= 2) return 0.25 - (1 - debye_integral_from_above(x) / x) / x;
  // A&S 27.1.1: D_1(x) = 1 - x/4 + sum_n B_2n x^2n / ((2n+1) (2n)!), |x| < 2 pi.
  double sum = 0, power = x / 2;
  for (int n = 1; n <= 20; ++n) {
    sum += boost::math::bernoulli_b2n<double>(n) * power / (2 * n + 1);
    power *= x * x / ((2 * n + 1.0) * (2 * n + 2.0));
  }
  return sum;
}

namespace {

// Newton for y = -2^n x, near 1, in A_n(x) / (1-x)^(n+1) = sum_{k>=1} k^n x^(k-1) = sum_{k>=1} (k / 2^(k-1))^n
// (-y)^(k-1): as |x| < 1 for n > 2, few terms.
long double find_eulerian_root(int n) {
  if (n == 2) return -1;
  constexpr int kMostSteps = 50;  // 5 are enough
  constexpr long double kResolution = std::numeric_limits<long double>::epsilon();
  long double y = 1;
  for (int step = 0; step < kMostSteps; ++step) {
    long double value = 1, slope = 0, last = 1;
    for (int k = 2; k < 64 && last > kResolution * kResolution; ++k) {
      last = std::pow(std::ldexp(static_cast<long double>(k), 1 - k), static_cast<long double>(n)) * std::pow(y, k - 1);
      const long double term = k % 2 == 0 ? -last : last;
      value += term;
      slope += (k - 1) * term / y;
    }
    const long double change = value / slope;
    y -= change;
    if (std::abs(change) <= kResolution * y) break;
  }
  return -std::ldexp(y, -n);
}

}  // namespace

long double eulerian_root(int n) {
  static std::mutex mutex;
  static std::map<int, long double> roots;  // each is asked for again and again
  const std::lock_guard lock(mutex);
  const auto known = roots.find(n);
  return known != roots.end() ? known->second : roots.emplace(n, find_eulerian_root(n)).first->second;
}

}  // namespace sklar
