#include "copula/inference/marginal.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "copula/error.hpp"
#include "copula/inference/checks.hpp"

namespace sklar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string entry(const char* name, std::size_t i, double value) {
  return std::string(name) + "(" + std::to_string(i) + ") = " + to_text(value);
}

void require_edges(const std::vector<double>& edges) {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (std::isfinite(edges[i]) && (i == 0 || edges[i] > edges[i - 1])) continue;
    throw std::domain_error("histogram: edges must be finite and strictly increasing, got " +
                            entry("edges", i, edges[i]));
  }
}

void require_masses(const std::vector<double>& masses) {
  for (std::size_t i = 0; i < masses.size(); ++i) {
    if (std::isfinite(masses[i]) && masses[i] >= 0) continue;
    throw std::domain_error("histogram: masses must be finite and 0 or more, got " + entry("masses", i, masses[i]));
  }
}

}  // namespace

Column Marginal::cdf(const ColumnRef& x) const {
  return x.unaryExpr([this](double value) { return cdf(value); });
}

Column Marginal::quantile(const ColumnRef& p) const {
  require_unit_cube("quantile", "p", p);
  return p.unaryExpr([this](double value) { return quantile(value); });
}

Column DensityMarginal::log_pdf(const ColumnRef& x) const {
  return x.unaryExpr([this](double value) { return log_pdf(value); });
}

HistogramMarginal::HistogramMarginal(std::vector<double> edges, std::vector<double> masses)
    : edges_(std::move(edges)), masses_(std::move(masses)), cumulative_(masses_.size() + 1, 0.0) {
  if (masses_.empty() || edges_.size() != masses_.size() + 1) {
    throw std::invalid_argument("histogram: needs 1 or more masses and one edge more, got " +
                                std::to_string(masses_.size()) + " masses and " + std::to_string(edges_.size()) +
                                " edges");
  }
  require_edges(edges_);
  require_masses(masses_);
  const double largest = *std::max_element(masses_.begin(), masses_.end());
  if (largest == 0) throw std::invalid_argument("histogram: all masses are zero");
  for (std::size_t i = 0; i < masses_.size(); ++i) cumulative_[i + 1] = cumulative_[i] + masses_[i] / largest;
  const double total = cumulative_.back();
  for (double& value : cumulative_) value /= total;
  log_density_.reserve(masses_.size());
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    log_density_.push_back(std::log(masses_[i] / largest / total) - std::log(edges_[i + 1] - edges_[i]));
  }
}

/// The bin [edge_i, edge_{i+1}) of x; the last one is closed. Precondition: x within the edges.
std::size_t HistogramMarginal::bin(double x) const {
  const auto above = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, x);
  return static_cast<std::size_t>(above - edges_.begin()) - 1;
}

double HistogramMarginal::cdf(double x) const {
  if (x <= edges_.front()) return 0;
  if (x >= edges_.back()) return 1;
  if (std::isnan(x)) return x;
  const std::size_t i = bin(x);
  const double part = (x - edges_[i]) / (edges_[i + 1] - edges_[i]);
  return cumulative_[i] + part * (cumulative_[i + 1] - cumulative_[i]);
}

double HistogramMarginal::quantile(double p) const {
  if (std::isnan(p)) return p;
  assert(p >= 0 && p <= 1);
  // The bin with cumulative_[i] < p <= cumulative_[i+1]; for p = 0 the first with mass.
  const auto end = p > 0 ? std::lower_bound(cumulative_.begin() + 1, cumulative_.end() - 1, p)
                         : std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, 0.0);
  const auto i = static_cast<std::size_t>(end - cumulative_.begin()) - 1;
  const double part = (p - cumulative_[i]) / (cumulative_[i + 1] - cumulative_[i]);
  return part < 1 ? edges_[i] + part * (edges_[i + 1] - edges_[i]) : edges_[i + 1];
}

double HistogramMarginal::log_pdf(double x) const {
  if (std::isnan(x)) return x;
  if (x < edges_.front() || x > edges_.back()) return -kInfinity;
  return log_density_[bin(x)];
}

EmpiricalMarginal::EmpiricalMarginal(const ColumnRef& data, const ColumnRef& weights) {
  require_enough_rows("empirical margin", "data", data.rows(), 1);
  require_finite("empirical margin", "data", data);
  require_weights("empirical margin", weights, data.rows());
  std::vector<Index> order(static_cast<std::size_t>(data.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return data[a] < data[b]; });
  cumulative_.push_back(0);
  for (const Index i : order) {
    sorted_.push_back(data[i]);
    if (weights.size() > 0) weights_.push_back(weights[i]);
    cumulative_.push_back(cumulative_.back() + (weights.size() > 0 ? weights[i] : 1.0));
  }
}

EmpiricalMarginal::Ranks EmpiricalMarginal::ranks(double x) const {
  const auto [first, last] = std::equal_range(sorted_.begin(), sorted_.end(), x);
  const double below = cumulative_[static_cast<std::size_t>(first - sorted_.begin())];
  return {below, cumulative_[static_cast<std::size_t>(last - sorted_.begin())] - below, first != last};
}

double EmpiricalMarginal::cdf(double x) const {
  if (std::isnan(x)) return x;
  const Ranks at = ranks(x);
  return (at.at_value ? at.below + 0.5 * (at.tied + 1) : at.below) / (total() + 1);
}

double EmpiricalMarginal::pseudo_observation(double x) const {
  if (std::isnan(x)) return x;
  const Ranks at = ranks(x);
  return (at.below + 0.5 * (at.tied + 1)) / (total() + 1);
}

double EmpiricalMarginal::quantile(double p) const {
  if (std::isnan(p)) return p;
  assert(p >= 0 && p <= 1);
  const double rank = std::clamp(p * (total() + 1), std::numeric_limits<double>::min(), total());
  const auto reached = std::lower_bound(cumulative_.begin() + 1, cumulative_.end(), rank);
  return sorted_[static_cast<std::size_t>(reached - cumulative_.begin()) - 1];
}

}  // namespace sklar
