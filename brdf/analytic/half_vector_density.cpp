#include "brdf/analytic/half_vector_density.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kAreaSteps = 128;

void require_nodes(const std::vector<double>& theta, const std::vector<double>& density) {
  if (theta.size() != density.size() || theta.size() < 2) {
    throw std::invalid_argument("TabulatedDensity: needs two or more nodes and a density at each, got " +
                                std::to_string(theta.size()) + " and " + std::to_string(density.size()));
  }
  const bool rising = std::ranges::adjacent_find(theta, [](double a, double b) { return !(a < b); }) == theta.end();
  if (!rising || theta.front() != 0 || std::abs(theta.back() - kPi / 2) > 1e-12) {
    throw std::invalid_argument("TabulatedDensity: nodes must rise from 0 to pi/2");
  }
  for (const double value : density) {
    if (!(value >= 0 && std::isfinite(value))) {
      throw std::domain_error("TabulatedDensity: density must be finite and at least 0, got " + to_text(value));
    }
  }
}

/// Half the integral of max(0, a + b cos(phi)) over a turn; a, b >= 0.
double half_turn(double a, double b) {
  return a >= b ? kPi * a : a * std::acos(-a / b) + std::sqrt((b - a) * (b + a));
}

/// Where the table of areas has its values.
double cosine_at(std::size_t step) {
  const double root = static_cast<double>(step) / kAreaSteps;
  return root * root * root;
}

}  // namespace

TabulatedDensity::TabulatedDensity(const std::vector<double>& theta, const std::vector<double>& density)
    : density_(density) {
  require_nodes(theta, density);
  for (const double angle : theta) {
    const double sine = std::sin(0.5 * angle);
    versine_.push_back(2 * sine * sine);
  }
  versine_.back() = 1;
  below_.push_back(0);
  for (std::size_t n = 1; n < versine_.size(); ++n) {
    below_.push_back(below_.back() + kPi * (versine_[n] - versine_[n - 1]) * (density_[n - 1] + density_[n]));
  }
  const double mass = below_.back();
  if (!(mass > 0 && std::isfinite(mass))) {
    throw std::domain_error("TabulatedDensity: density must have a positive, finite integral, got " + to_text(mass));
  }
  for (double& value : density_) value /= mass;
  for (double& value : below_) value /= mass;
}

double TabulatedDensity::operator()(double versine) const {
  const auto above = std::upper_bound(versine_.begin() + 1, versine_.end() - 1, versine);
  const auto n = static_cast<std::size_t>(above - versine_.begin());
  const double share = std::clamp((versine - versine_[n - 1]) / (versine_[n] - versine_[n - 1]), 0.0, 1.0);
  return (1 - share) * density_[n - 1] + share * density_[n];
}

double TabulatedDensity::draw(double uniform) const {
  // The first node with so much below it ends the segment: one of positive mass, also for a uniform of 1.
  const auto above = std::lower_bound(below_.begin() + 1, below_.end() - 1, uniform);
  const auto n = static_cast<std::size_t>(above - below_.begin());
  const double width = versine_[n] - versine_[n - 1];
  const double mass = std::max(uniform - below_[n - 1], 0.0) / (2 * kPi);
  const double first = density_[n - 1];
  // first s + slope s^2 / 2 = mass, by the root that does not cancel.
  const double slope = (density_[n] - first) / width;
  const double root = first + std::sqrt(std::max(first * first + 2 * slope * mass, 0.0));
  return root > 0 ? std::min(versine_[n - 1] + std::min(2 * mass / root, width), 1.0) : versine_[n];
}

FacetArea::FacetArea(const HalfVectorDensity& density) {
  const std::vector<double> nodes = density.nodes();
  const double offset = 0.5 / std::numbers::sqrt3;  // of two Gauss-Legendre nodes, from the middle of a unit interval
  std::vector<double> versine, weight;
  for (std::size_t n = 1; n < nodes.size(); ++n) {
    const double width = nodes[n] - nodes[n - 1];
    for (const double share : {0.5 - offset, 0.5 + offset}) {
      versine.push_back(nodes[n - 1] + share * width);
      weight.push_back(width * density(versine.back()));  // two halves of a turn, two nodes of weight 1/2
    }
  }
  for (std::size_t step = 0; step <= kAreaSteps; ++step) {
    const double cosine = cosine_at(step);
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    double sum = 0;
    for (std::size_t n = 0; n < versine.size(); ++n) {
      if (weight[n] == 0) continue;
      const double v = versine[n];
      sum += weight[n] * half_turn((1 - v) * cosine, std::sqrt(v * (2 - v)) * sine);
    }
    values_.push_back(sum);
  }
}

double FacetArea::operator()(double cosine) const {
  const auto step = static_cast<std::size_t>(std::cbrt(std::clamp(cosine, 0.0, 1.0)) * kAreaSteps);
  const std::size_t n = std::min(step, kAreaSteps - 1);
  const double share = (cosine - cosine_at(n)) / (cosine_at(n + 1) - cosine_at(n));
  return std::max((1 - share) * values_[n] + share * values_[n + 1], of_normal() * cosine);
}

}  // namespace sklar::brdf
