#include "copula/inference/likelihood_intervals.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

#include "copula/inference/minimise.hpp"
#include "copula/inference/objective.hpp"

namespace sklar {
namespace {

constexpr double kNone = FitResult::kNone;

Interval between(double a, double b) {
  return {std::min(a, b), std::max(a, b)};
}

/// A maximum of the likelihood and its surroundings in the coordinates z.
class Maximum {
 public:
  Maximum(const FamilyInfo& family, const FitResult& result, const PointsRef& u, const ColumnRef& weights,
          const SpreadAt& spread, const IntervalOptions& options)
      : family_(family),
        u_(u),
        weights_(weights),
        dim_(static_cast<int>(u.cols())),
        parallel_(options.fit.parallel),
        scale_(family, dim_),
        z_(scale_.z(result.theta)),
        quantile_(normal_quantile(options.confidence)),
        spread_(spread(scale_, z_)),
        least_(-likelihood(z_)) {}

  [[nodiscard]] std::size_t size() const { return z_.size(); }
  [[nodiscard]] bool has_spread() const { return (spread_.covariance.diagonal().array() > 0).all(); }  ///< NaN: no

  [[nodiscard]] double standard_error(std::size_t a) const {
    const std::vector<double> theta = slopes([a](const Theta& at) { return at[a]; });
    return error_of(theta);
  }

  [[nodiscard]] Interval wald(std::size_t a) const {
    const double reach = quantile_ * std::sqrt(variance(spread_.covariance, a));
    return theta_between(a, z_[a] - reach, z_[a] + reach);
  }

  [[nodiscard]] Interval wald_tau() const {
    if (scale_.by_tau()) return tau_of(wald(0));
    const double centre = std::atanh(family_.tau(scale_.theta(z_)));
    const double reach = quantile_ * error_of(slopes([this](const Theta& at) { return std::atanh(family_.tau(at)); }));
    return between(std::tanh(centre - reach), std::tanh(centre + reach));
  }

  [[nodiscard]] Interval profile(std::size_t a) const { return theta_between(a, end(a, -1), end(a, 1)); }

  /// Precondition: one parameter, so that tau is monotone in it.
  [[nodiscard]] Interval tau_of(const Interval& theta) const {
    return between(family_.tau({theta.lowest}), family_.tau({theta.highest}));
  }

 private:
  static double variance(const Eigen::MatrixXd& covariance, std::size_t a) {
    return covariance(static_cast<Index>(a), static_cast<Index>(a));
  }

  [[nodiscard]] double likelihood(const std::vector<double>& z) const {
    const CopulaPtr copula = family_.make_unchecked(dim_, scale_.theta(z));
    return log_likelihood(*copula, u_, weights_, {.parallel = parallel_}).or_nothing();
  }

  /// The derivative of a function of theta by each z.
  template <class Function>
  [[nodiscard]] std::vector<double> slopes(const Function& f) const {
    constexpr double kStep = 1e-4;
    std::vector<double> slopes(size());
    for (std::size_t a = 0; a < size(); ++a) {
      std::vector<double> low = z_, high = z_;
      low[a] = std::max(low[a] - kStep, scale_.box().lower[a]);
      high[a] = std::min(high[a] + kStep, scale_.box().upper[a]);
      slopes[a] = (f(scale_.theta(high)) - f(scale_.theta(low))) / (high[a] - low[a]);
    }
    return slopes;
  }

  /// By the delta method.
  [[nodiscard]] double error_of(const std::vector<double>& slopes) const {
    const Eigen::Map<const Eigen::VectorXd> gradient(slopes.data(), static_cast<Index>(slopes.size()));
    return std::sqrt(gradient.dot(spread_.covariance * gradient));
  }

  [[nodiscard]] Interval theta_between(std::size_t a, double low, double high) const {
    std::vector<double> lower = z_, upper = z_;
    lower[a] = std::max(low, scale_.box().lower[a]);
    upper[a] = std::min(high, scale_.box().upper[a]);
    return between(scale_.theta(lower)[a], scale_.theta(upper)[a]);
  }

  /// The least -l with z_a as given.
  [[nodiscard]] double least_at(std::size_t a, double value) const {
    std::vector<double> z = z_;
    z[a] = value;
    if (size() == 1) return -likelihood(z);
    const auto with = [&z, a](const std::vector<double>& others) {
      std::copy(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(a), z.begin());
      std::copy(others.begin() + static_cast<std::ptrdiff_t>(a), others.end(),
                z.begin() + static_cast<std::ptrdiff_t>(a) + 1);
      return z;
    };
    const auto without = [a](std::vector<double> all) {
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(a));
      return all;
    };
    const auto objective = [&](const std::vector<double>& others) -> Evaluation {
      const double least = -likelihood(with(others));
      return std::isfinite(least) ? Evaluation{least} : Evaluation{kBroken, 1};
    };
    const MinimiseOptions options{.step = 0.1 * scale_.spacing(), .tolerance = 1e-7, .max_evaluations = 1000};
    const Box box{without(scale_.box().lower), without(scale_.box().upper)};
    return minimise(objective, without(z_), box, options).best.value;
  }

  /// Standard deviations of z_a between the maximum and a value, by the likelihood, less the quantile. The maximum is
  /// one up to the tolerance of the search, so that the drop may be a rounding below 0.
  [[nodiscard]] double excess(std::size_t a, double value) const {
    const double drop = std::min(2 * (least_at(a, value) - least_), kBroken);
    const double factor = variance(spread_.covariance, a) / variance(spread_.inverse_information, a);
    return std::sqrt(std::max(drop, 0.0) / factor) - quantile_;
  }

  /// z_a on one side where the excess is 0, or the end of the range searched.
  [[nodiscard]] double end(std::size_t a, int sign) const {
    const double last = sign < 0 ? scale_.box().lower[a] : scale_.box().upper[a];
    double inside = z_[a], at_inside = -quantile_;
    double reach = quantile_ * std::sqrt(variance(spread_.covariance, a));
    for (;; reach *= 2) {
      const double outside = sign < 0 ? std::max(z_[a] - reach, last) : std::min(z_[a] + reach, last);
      const double at_outside = excess(a, outside);
      if (at_outside > 0) return root(a, inside, at_inside, outside, at_outside);
      if (outside == last) return last;
      inside = outside;
      at_inside = at_outside;
    }
  }

  [[nodiscard]] double root(std::size_t a, double inside, double at_inside, double outside, double at_outside) const {
    constexpr double kTolerance = 1e-9;
    if (at_inside == 0) return inside;
    if (inside > outside) {
      std::swap(inside, outside);
      std::swap(at_inside, at_outside);
    }
    std::uintmax_t steps = 200;
    const auto bracket = boost::math::tools::toms748_solve(
        [&](double value) { return excess(a, value); }, inside, outside, at_inside, at_outside,
        [](double low, double high) { return high - low <= kTolerance; }, steps);
    return 0.5 * (bracket.first + bracket.second);
  }

  static constexpr double kBroken = 1e300;  ///< in place of an infinite drop, which has no slope

  const FamilyInfo& family_;
  PointsRef u_;
  ColumnRef weights_;
  int dim_;
  bool parallel_;
  ParameterScale scale_;
  std::vector<double> z_;
  double quantile_;
  LikelihoodSpread spread_;
  double least_;
};

}  // namespace

double normal_quantile(double confidence) {
  return std::sqrt(2.0) * boost::math::erf_inv(confidence);
}

ConfidenceIntervals no_intervals(const FitResult& result, std::string message) {
  const Interval unknown{kNone, kNone};
  return {.theta = std::vector<Interval>(result.theta.size(), unknown),
          .tau = unknown,
          .standard_error = std::vector<double>(result.theta.size(), kNone),
          .message = std::move(message)};
}

ConfidenceIntervals likelihood_intervals(const FamilyInfo& family, const FitResult& result, const PointsRef& u,
                                         const ColumnRef& weights, const SpreadAt& spread,
                                         const IntervalOptions& options) {
  if (result.method != FitMethod::maximum_likelihood) {
    return no_intervals(result, std::string(to_text(options.method)) + " intervals need a fit by maximum likelihood");
  }
  if (result.status != FitStatus::converged) return no_intervals(result, result.message);
  if (result.theta.empty()) return no_intervals(result, "the family has no parameters");
  const Maximum maximum(family, result, u, weights, spread, options);
  if (!maximum.has_spread())
    return no_intervals(result, "the likelihood at its maximum does not tell the spread of the estimate");
  ConfidenceIntervals intervals = no_intervals(result, "");
  const bool wald = options.method == IntervalMethod::wald;
  for (std::size_t a = 0; a < maximum.size(); ++a) {
    intervals.theta[a] = wald ? maximum.wald(a) : maximum.profile(a);
    intervals.standard_error[a] = maximum.standard_error(a);
  }
  if (wald) intervals.tau = maximum.wald_tau();
  if (!wald && maximum.size() == 1) intervals.tau = maximum.tau_of(intervals.theta[0]);
  return intervals;
}

}  // namespace sklar
