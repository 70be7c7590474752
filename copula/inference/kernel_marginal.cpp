#include "copula/inference/kernel_marginal.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "copula/error.hpp"
#include "copula/inference/checks.hpp"
#include "copula/inference/parametric_marginal.hpp"

namespace sklar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRootHalf = 0.70710678118654752;
constexpr double kLogRootTwoPi = 0.91893853320467274;

/// The normal cdf at (x - centre) / h. In double its relative error is 3e-16 z^2, far out long double is needed.
double normal_cdf(double x, double centre, double h) {
  constexpr double kFar = 10;
  const double z = (x - centre) / h;
  if (z > -kFar) return 0.5 * std::erfc(-z * kRootHalf);
  return NormalMarginal(centre, h).cdf(x);
}

/// The value of rank k of the rows sorted, a row of weight w being w rows.
double order_statistic(const EmpiricalMarginal& data, double total, double k) {
  return data.quantile(std::min((k - 0.5) / (total + 1), 1.0));
}

double sample_quartile(const EmpiricalMarginal& data, double total, double p) {
  const double position = 1 + (total - 1) * p;
  const double low = order_statistic(data, total, std::floor(position));
  return low + (position - std::floor(position)) * (order_statistic(data, total, std::floor(position) + 1) - low);
}

}  // namespace

KernelMarginal::KernelMarginal(const ColumnRef& data, double bandwidth, const ColumnRef& weights)
    : values_(data.begin(), data.end()), weights_(weights.begin(), weights.end()), bandwidth_(bandwidth) {
  require_enough_rows("kernel margin", "data", data.rows(), 1);
  require_finite("kernel margin", "data", data);
  require_weights("kernel margin", weights, data.rows());
  if (!(bandwidth > 0) || !std::isfinite(bandwidth)) {
    throw std::domain_error("kernel margin: the bandwidth must be finite and above 0, got " + to_text(bandwidth));
  }
  total_ = weights.size() > 0 ? weights.sum() : static_cast<double>(data.size());
}

double KernelMarginal::tail(double x, bool upper) const {
  long double sum = 0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    sum += weight(i) * (upper ? normal_cdf(-x, -values_[i], bandwidth_) : normal_cdf(x, values_[i], bandwidth_));
  }
  return static_cast<double>(sum / total_);
}

double KernelMarginal::cdf(double x) const {
  return tail(x, false);
}

double KernelMarginal::quantile(double p) const {
  if (std::isnan(p)) return p;
  assert(p >= 0 && p <= 1);
  if (p == 0 || p == 1) return p == 0 ? -kInfinity : kInfinity;
  const bool upper = p > 0.5;
  const double mass = upper ? 1 - p : p;
  const auto miss = [&](double x) { return (upper ? 1 : -1) * (1 - tail(x, upper) / mass); };
  // The quantile of one kernel, at the smallest and at the largest value.
  const double reach = NormalMarginal(0, bandwidth_).quantile(p);
  double low = *std::min_element(values_.begin(), values_.end()) + reach;
  double high = *std::max_element(values_.begin(), values_.end()) + reach;
  low -= 1e-9 * (bandwidth_ + std::abs(low));
  high += 1e-9 * (bandwidth_ + std::abs(high));
  const auto done = [&](double a, double b) { return b - a <= 4e-16 * (std::abs(a) + bandwidth_); };
  std::uintmax_t most_steps = 200;
  const auto [left, right] = boost::math::tools::toms748_solve(miss, low, high, done, most_steps);
  return 0.5 * (left + right);
}

double KernelMarginal::log_pdf(double x) const {
  if (std::isnan(x)) return x;
  double nearest = kInfinity;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (weight(i) > 0) nearest = std::min(nearest, std::abs(x - values_[i]) / bandwidth_);
  }
  if (nearest == kInfinity) return -kInfinity;
  long double sum = 0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const double z = std::abs(x - values_[i]) / bandwidth_;
    sum += weight(i) * std::exp(0.5 * (nearest - z) * (nearest + z));
  }
  return -0.5 * nearest * nearest + std::log(static_cast<double>(sum / total_)) - std::log(bandwidth_) - kLogRootTwoPi;
}

double silverman_bandwidth(const ColumnRef& x, const ColumnRef& weights) {
  const EmpiricalMarginal data(x, weights);
  if (data.quantile(0.0) == data.quantile(1.0)) {
    throw std::invalid_argument("kernel margin: all values are " + to_text(data.quantile(0.0)));
  }
  const Column w = weights.size() > 0 ? Column(weights) : Column(Column::Ones(x.size()));
  const double total = w.sum();
  if (!(total > 1)) {
    throw std::invalid_argument("kernel margin: a bandwidth needs 2 observations or more, got " + to_text(total));
  }
  const double sd = std::sqrt((w * (x - (w * x).sum() / total).square()).sum() / (total - 1));
  const double range = sample_quartile(data, total, 0.75) - sample_quartile(data, total, 0.25);
  return 0.9 * (range > 0 ? std::min(sd, range / 1.34) : sd) * std::pow(total, -0.2);
}

}  // namespace sklar
