#include "copula/inference/marginal.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
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

EmpiricalMarginal::EmpiricalMarginal(const ColumnRef& data) : sorted_(data.begin(), data.end()) {
  require_enough_rows("empirical margin", "data", data.rows(), 1);
  require_finite("empirical margin", "data", data);
  std::sort(sorted_.begin(), sorted_.end());
}

double EmpiricalMarginal::cdf(double x) const {
  if (std::isnan(x)) return x;
  const auto [first, last] = std::equal_range(sorted_.begin(), sorted_.end(), x);
  const auto below = static_cast<double>(first - sorted_.begin());
  const auto tied = static_cast<double>(last - first);
  const double rank = tied > 0 ? 0.5 * (below + 1 + (below + tied)) : below;
  return rank / static_cast<double>(sorted_.size() + 1);
}

double EmpiricalMarginal::quantile(double p) const {
  if (std::isnan(p)) return p;
  assert(p >= 0 && p <= 1);
  const auto n = static_cast<double>(sorted_.size());
  const double rank = std::clamp(std::ceil(p * (n + 1)), 1.0, n);
  return sorted_[static_cast<std::size_t>(rank) - 1];
}

}  // namespace sklar
