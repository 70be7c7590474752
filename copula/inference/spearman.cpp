#include "copula/inference/spearman.hpp"

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <functional>

#include "copula/error.hpp"
#include "copula/inference/parameter_scale.hpp"

namespace sklar {
namespace {

constexpr double kTolerance = 1e-9;  // of the last halving of the steps, which squares the error

using Quadrature = boost::math::quadrature::tanh_sinh<double>;

double cdf_at(const Copula& copula, double u, double v) {
  Points point = Points::Ones(1, copula.dim());
  point.leftCols(2) << u, v;
  return copula.cdf(point)(0);
}

double integral_over_v(Quadrature& quadrature, const Copula& copula, double u) {
  const double near = std::min(u, 1 - u), far = std::max(u, 1 - u);
  const auto integrand = [&](double v) { return cdf_at(copula, u, v); };
  double sum = 0;
  for (const auto& [low, high] : {std::pair(0.0, near), std::pair(near, far), std::pair(far, 1.0)}) {
    if (low < high) sum += quadrature.integrate(integrand, low, high, kTolerance);
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
    throw std::domain_error(family.name + ": " + what + " must be in " +
                            Interval{at_low + value, at_high + value}.to_text() + " in dimension " +
                            std::to_string(dim) + ", got " + to_text(value));
  }
  if (at_low == 0 || at_high == 0) return scale.theta({at_low == 0 ? low : high});
  std::uintmax_t most_steps = 100;
  const boost::math::tools::eps_tolerance<double> done(44);
  const auto [left, right] = boost::math::tools::toms748_solve(miss, low, high, at_low, at_high, done, most_steps);
  return scale.theta({0.5 * (left + right)});
}

}  // namespace

double spearman_rho(const Copula& copula) {
  Quadrature inner(8), outer(8);
  const auto integrand = [&](double u) { return integral_over_v(inner, copula, u); };
  return 12 * (outer.integrate(integrand, 0.0, 0.5, kTolerance) + outer.integrate(integrand, 0.5, 1.0, kTolerance)) - 3;
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
