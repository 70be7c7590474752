#include "copula/numerics.hpp"

#include <boost/math/special_functions/bernoulli.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>
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

long double find_eulerian_root(int n) {
  // Newton from 0, right of every root, rises monotonically to the largest one. The polynomial is divided by n!.
  const Triangle<EulerianRule> table(n + 1, {});
  const auto coefficients = table.row<Extended>(n);
  long double x = 0;
  for (int step = 0; step < 200; ++step) {
    long double value = 0, slope = 0;
    for (std::size_t k = coefficients.size(); k-- > 0;) {
      slope = slope * x + value;
      value = value * x + coefficients[k].value;
    }
    const long double next = x - value / slope;
    if (!(next < x)) break;
    x = next;
  }
  return x;
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
