#include "copula/inference/spearman.hpp"

#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "copula/error.hpp"
#include "copula/inference/parameter_scale.hpp"

namespace sklar {
namespace {

constexpr double kNothing = 1e-30;   // a probability that adds nothing to an integral
constexpr double kTolerance = 1e-7;  // of the last halving of the steps, which squares the error

/// Nodes and weights of the double exponential rule on (0,1), Takahasi and Mori (1974), x = 1/(1 + exp(-pi sinh t)),
/// for |t| < 3.1, beyond which weights are below 1e-15.
struct Rule {
  explicit Rule(int steps_a_unit) {
    const auto half = static_cast<Index>(3.1 * steps_a_unit);
    const Column t = Column::LinSpaced(2 * half + 1, -double(half), double(half)) / steps_a_unit;
    x = 1 / (1 + (-std::numbers::pi * t.sinh()).exp());
    weight = std::numbers::pi / steps_a_unit * t.cosh() * x / (1 + (std::numbers::pi * t.sinh()).exp());
  }
  Column x, weight;
};

Points point(const Copula& copula, double u, double v) {
  Points result = Points::Ones(1, copula.dim());
  result.leftCols(2) << u, v;
  return result;
}

/// The end t of the part of a curve (u(t), v(t)), rising from t = 0, on which C is 0. Precondition: it is not 0 at
/// high.
double end_of_zeros(const Copula& copula, double high, const std::function<Points(double)>& curve) {
  const auto is_zero = [&](double t) { return std::isinf(copula.log_cdf(curve(t))(0)); };
  if (!is_zero(kNothing)) return 0;
  for (double low = 0;;) {
    const double middle = 0.5 * (low + high);
    if (high - low < 1e-9) return middle;  // C rises by less than t
    (is_zero(middle) ? low : high) = middle;
  }
}

/// int C(u,v) dv over lowest < v < u, split at v = 1 - u.
double integral_over_v(const Rule& rule, const Copula& copula, double u, double lowest) {
  const Index n = rule.x.size();
  const double split = std::min(u, 1 - u);
  Points points = point(copula, u, u).replicate(split < u ? 2 * n : n, 1);
  points.col(1).head(n) = lowest + (split - lowest) * rule.x;
  if (split < u) points.col(1).tail(n) = split + (u - split) * rule.x;
  const Column values = copula.cdf(points);
  const double above = split < u ? (u - split) * (rule.weight * values.tail(n)).sum() : 0;
  return above + (split - lowest) * (rule.weight * values.head(n)).sum();
}

/// int int C(u,v) du dv over v < u. Precondition: end is that of the diagonal.
double integral(const Rule& rule, const Copula& copula, double end) {
  double sum = 0;
  for (const auto& [low, high] : {std::pair(end, 0.5), std::pair(0.5, 1.0)}) {
    for (Index i = 0; i < rule.x.size(); ++i) {
      const double u = low + (high - low) * rule.x(i);
      const double lowest = end_of_zeros(copula, std::min(u, 1 - u), [&](double v) { return point(copula, u, v); });
      sum += (high - low) * rule.weight(i) * integral_over_v(rule, copula, u, lowest);
    }
  }
  return sum;
}

/// The only parameter of a family at which a monotone measure has a value.
Theta invert(const FamilyInfo& family, int dim, const char* what, double value,
             const std::function<double(const Theta&)>& measure) {
  if (family.parameters.size() != 1) {
    throw std::invalid_argument(family.name + ": " + what + " determines one parameter, the family has " +
                                std::to_string(family.parameters.size()));
  }
  const ParameterScale scale(family, dim);
  const auto miss = [&](double z) { return measure(scale.theta({z})) - value; };
  // From the middle outwards: the measure is costly at the ends.
  const double lowest = scale.box().lower[0], highest = scale.box().upper[0];
  double low = std::clamp(0.0, lowest, highest), high = low;
  double at_low = miss(low), at_high = at_low;
  for (; at_low > 0 && low > lowest; at_low = miss(low)) low = std::max(low - 1, lowest);
  for (; at_high < 0 && high < highest; at_high = miss(high)) high = std::min(high + 1, highest);
  if (!(at_low <= 0 && at_high >= 0)) {
    const bool below = at_low > 0;
    const double found = value + (below ? at_low : at_high);
    const double end = std::abs(found) < kTolerance ? 0 : found;
    throw std::domain_error(family.name + ": " + what + " must be " + to_text(end) + (below ? " or more" : " or less") +
                            " in dimension " + std::to_string(dim) + ", got " + to_text(value));
  }
  if (at_low == 0 || at_high == 0) return scale.theta({at_low == 0 ? low : high});
  std::uintmax_t most_steps = 100;
  const boost::math::tools::eps_tolerance<double> done(44);
  const auto [left, right] = boost::math::tools::toms748_solve(miss, low, high, at_low, at_high, done, most_steps);
  return scale.theta({0.5 * (left + right)});
}

}  // namespace

double spearman_rho(const Copula& copula) {
  const double end = end_of_zeros(copula, 0.5, [&](double u) { return point(copula, u, u); });
  double previous = integral(Rule(4), copula, end);
  for (int steps = 8;; steps *= 2) {
    const double next = integral(Rule(steps), copula, end);
    if (!(std::abs(next - previous) > kTolerance) || steps == 64) return 24 * next - 3;
    previous = next;
  }
}

Theta theta_from_rho(const FamilyInfo& family, int dim, double rho) {
  return invert(family, dim, "rho", rho, [&](const Theta& theta) { return spearman_rho(*family.make(2, theta)); });
}

Theta theta_from_lower_tail(const FamilyInfo& family, int dim, double lambda) {
  return invert(family, dim, "the lower tail coefficient", lambda,
                [&](const Theta& theta) { return family.tails(theta).lower; });
}

Theta theta_from_upper_tail(const FamilyInfo& family, int dim, double lambda) {
  return invert(family, dim, "the upper tail coefficient", lambda,
                [&](const Theta& theta) { return family.tails(theta).upper; });
}

}  // namespace sklar
