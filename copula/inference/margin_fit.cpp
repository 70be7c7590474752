#include "copula/inference/margin_fit.hpp"

#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/special_functions/log1p.hpp>
#include <boost/math/special_functions/trigamma.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "copula/error.hpp"
#include "copula/inference/checks.hpp"

namespace sklar {
namespace {

using Real = long double;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostSteps = 200;
constexpr Real kRelativeStep = 1e-15L;  // of the last step of Newton's method, whose error is far below it

/// The data of a fit: n values of frequencies w, N in all.
struct Sample {
  ColumnRef x;
  Column w;
  double n;

  template <class Term>
  [[nodiscard]] Real mean(Term term) const {
    Real sum = 0;
    for (Index i = 0; i < x.size(); ++i) {
      if (w[i] > 0) sum += w[i] * term(Real(x[i]));
    }
    return sum / n;
  }
};

struct Estimate {
  std::vector<double> parameters, standard_error;
};

/// The estimates with standard errors from the information of one observation [[aa, ab], [ab, bb]].
Estimate with_errors(Real a, Real b, Real n, Real aa, Real ab, Real bb) {
  const Real determinant = n * (aa * bb - ab * ab);
  return {{static_cast<double>(a), static_cast<double>(b)},
          {static_cast<double>(std::sqrt(bb / determinant)), static_cast<double>(std::sqrt(aa / determinant))}};
}

Estimate fit_normal(const Sample& data) {
  const Real mean = data.mean([](Real x) { return x; });
  const Real variance = data.mean([&](Real x) { return (x - mean) * (x - mean); });
  return with_errors(mean, std::sqrt(variance), data.n, 1 / variance, 0, 2 / variance);
}

/// Newton's method for 1/k (Minka 2002, Estimating a Gamma distribution, eq. 11).
Estimate fit_gamma(const Sample& data) {
  const Real mean = data.mean([](Real x) { return x; });
  // log mean(x) - mean(log x), of terms that are all positive.
  const Real s = -data.mean([&](Real x) { return boost::math::log1pmx((x - mean) / mean); });
  Real k = (3 - s + std::sqrt((s - 3) * (s - 3) + 24 * s)) / (12 * s);
  for (int step = 0; step < kMostSteps; ++step) {
    const Real miss = std::log(k) - boost::math::digamma(k) - s;
    const Real next = 1 / (1 / k + miss / (k * k * (1 / k - boost::math::trigamma(k))));
    const bool done = std::abs(next - k) <= kRelativeStep * k;
    k = next;
    if (done) break;
  }
  const Real scale = mean / k;
  return with_errors(k, scale, data.n, boost::math::trigamma(k), 1 / scale, k / (scale * scale));
}

/// The likelihood of a beta margin by its sufficient statistics: means of log y and log(1 - y).
class BetaLikelihood {
 public:
  BetaLikelihood(const Sample& data, const MarginSpec& spec) {
    const Real width = Real(spec.highest) - spec.lowest;
    log_y_ = data.mean([&](Real x) { return std::log((x - spec.lowest) / width); });
    log_rest_ = data.mean([&](Real x) { return std::log((spec.highest - x) / width); });
    const Real mean = data.mean([&](Real x) { return (x - spec.lowest) / width; });
    const Real variance = data.mean([&](Real x) {
      const Real deviation = (x - spec.lowest) / width - mean;
      return deviation * deviation;
    });
    const Real size = mean * (1 - mean) / variance - 1;
    a = mean * size;
    b = (1 - mean) * size;
  }

  void maximise() {
    for (int step = 0; step < kMostSteps; ++step) {
      const Real of_sum = boost::math::digamma(a + b), curvature = boost::math::trigamma(a + b);
      const Real slope_a = log_y_ - boost::math::digamma(a) + of_sum;
      const Real slope_b = log_rest_ - boost::math::digamma(b) + of_sum;
      const Real aa = boost::math::trigamma(a) - curvature, bb = boost::math::trigamma(b) - curvature;
      const Real determinant = aa * bb - curvature * curvature;
      Real step_a = (bb * slope_a + curvature * slope_b) / determinant;
      Real step_b = (curvature * slope_a + aa * slope_b) / determinant;
      const Real before = value(a, b);
      while (!(a + step_a > 0 && b + step_b > 0 && value(a + step_a, b + step_b) >= before) && !small(step_a, step_b)) {
        step_a /= 2;
        step_b /= 2;
      }
      if (a + step_a > 0 && b + step_b > 0) {
        a += step_a;
        b += step_b;
      }
      if (small(step_a, step_b)) break;
    }
  }

  Real a, b;  ///< at first those with the mean and variance of the data

 private:
  [[nodiscard]] Real value(Real at_a, Real at_b) const {
    return (at_a - 1) * log_y_ + (at_b - 1) * log_rest_ + boost::math::lgamma(at_a + at_b) - boost::math::lgamma(at_a) -
           boost::math::lgamma(at_b);
  }

  [[nodiscard]] bool small(Real step_a, Real step_b) const {
    return std::abs(step_a) <= kRelativeStep * a && std::abs(step_b) <= kRelativeStep * b;
  }

  Real log_y_, log_rest_;
};

Estimate fit_beta(const Sample& data, const MarginSpec& spec) {
  BetaLikelihood likelihood(data, spec);
  likelihood.maximise();
  const Real a = likelihood.a, b = likelihood.b, curvature = boost::math::trigamma(a + b);
  return with_errors(a, b, data.n, boost::math::trigamma(a) - curvature, -curvature,
                     boost::math::trigamma(b) - curvature);
}

Estimate fit_parameters(const MarginSpec& spec, const Sample& data) {
  if (spec.kind == MarginKind::normal) return fit_normal(data);
  return spec.kind == MarginKind::gamma ? fit_gamma(data) : fit_beta(data, spec);
}

void require_inside(const MarginSpec& spec, const ColumnRef& x) {
  const Interval inside = support(spec);
  for (Index i = 0; i < x.size(); ++i) {
    if (inside.contains(x[i])) continue;
    throw std::domain_error(std::string(to_text(spec.kind)) + " margin: x must be in " + inside.to_text() + ", got x(" +
                            std::to_string(i) + ") = " + to_text(x[i]));
  }
}

}  // namespace

std::shared_ptr<const Marginal> share(const StoredMarginal& margin) {
  return std::visit(
      [](const auto& value) -> std::shared_ptr<const Marginal> {
        return std::make_shared<std::decay_t<decltype(value)>>(value);
      },
      margin);
}

std::shared_ptr<const DensityMarginal> density_of(const StoredMarginal& margin) {
  return std::dynamic_pointer_cast<const DensityMarginal>(share(margin));
}

std::string_view to_text(MarginKind kind) {
  switch (kind) {
    case MarginKind::empirical:
      return "empirical";
    case MarginKind::kernel:
      return "kernel";
    case MarginKind::normal:
      return "normal";
    case MarginKind::gamma:
      return "gamma";
    case MarginKind::beta:
      return "beta";
  }
  return "";
}

Interval support(const MarginSpec& spec) {
  if (spec.kind == MarginKind::beta) return {spec.lowest, spec.highest, false, false};
  return {spec.kind == MarginKind::gamma ? 0 : -kInfinity, kInfinity, false, false};
}

std::vector<std::string_view> parameter_names(MarginKind kind) {
  switch (kind) {
    case MarginKind::empirical:
      return {};
    case MarginKind::kernel:
      return {"bandwidth"};
    case MarginKind::normal:
      return {"mean", "sd"};
    case MarginKind::gamma:
      return {"shape", "scale"};
    case MarginKind::beta:
      return {"a", "b"};
  }
  return {};
}

bool is_parametric(MarginKind kind) {
  return kind == MarginKind::normal || kind == MarginKind::gamma || kind == MarginKind::beta;
}

bool is_location(MarginKind kind, std::size_t parameter) {
  return kind == MarginKind::normal && parameter == 0;
}

StoredMarginal make_margin(const MarginSpec& spec, const std::vector<double>& parameters) {
  const double first = parameters.at(0), second = parameters.at(1);
  if (spec.kind == MarginKind::normal) return NormalMarginal(first, second);
  if (spec.kind == MarginKind::gamma) return GammaMarginal(first, second);
  return BetaMarginal(first, second, spec.lowest, spec.highest);
}

MarginFit fit_margin(const MarginSpec& spec, const ColumnRef& x, const ColumnRef& weights) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  EmpiricalMarginal ranks(x, weights);
  if (spec.kind == MarginKind::empirical) return {spec, std::move(ranks), {}, {}, kNone};
  require_inside(spec, x);
  if (ranks.quantile(0.0) == ranks.quantile(1.0)) {
    throw std::invalid_argument(std::string(to_text(spec.kind)) + " margin: all values are " +
                                to_text(ranks.quantile(0.0)));
  }
  const Column w = weights.size() > 0 ? Column(weights) : Column(Column::Ones(x.size()));
  const auto fitted = [&](StoredMarginal margin, Estimate estimate) {
    const Column terms = density_of(margin)->log_pdf(x);
    const double likelihood = (w > 0).select(w * terms, 0.0).sum();
    return MarginFit{spec, std::move(margin), std::move(estimate.parameters), std::move(estimate.standard_error),
                     likelihood};
  };
  if (spec.kind == MarginKind::kernel) {
    const double bandwidth = silverman_bandwidth(x, weights);
    return fitted(KernelMarginal(x, bandwidth, weights), {{bandwidth}, {kNone}});
  }
  Estimate estimate = fit_parameters(spec, {x, w, w.sum()});
  StoredMarginal margin = make_margin(spec, estimate.parameters);
  return fitted(std::move(margin), std::move(estimate));
}

}  // namespace sklar
