#include "copula/inference/parameter_scale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sklar {
namespace {

constexpr int kLatticePoints = 33;
constexpr double kShort = 1e-10;     ///< relative distance kept from an open end, where a formula may overflow
constexpr double kLatticeEnd = 3.0;  ///< |z| = 3 is |tau| = 0.995

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The admissible value nearest to theta.
double nearest(double theta, const Interval& domain) {
  const double lowest = domain.lowest_included ? domain.lowest : std::nextafter(domain.lowest, kInfinity);
  const double highest = domain.highest_included ? domain.highest : std::nextafter(domain.highest, -kInfinity);
  return std::clamp(theta, lowest, highest);
}

/// Where the search ends: at an end of the domain, short of one that does not belong to it, or far out.
Interval searched(const Interval& domain) {
  const auto short_of = [](double end) { return kShort * std::max(1.0, std::abs(end)); };
  const double lowest = std::max(domain.lowest, -ParameterScale::kLargestTheta);
  const double highest = std::min(domain.highest, ParameterScale::kLargestTheta);
  return {domain.lowest_included ? lowest : lowest + short_of(lowest),
          domain.highest_included ? highest : highest - short_of(highest)};
}

double to_theta(double z, const Interval& domain) {
  if (std::isfinite(domain.lowest)) return std::isfinite(domain.highest) ? z : domain.lowest + std::expm1(z);
  return std::isfinite(domain.highest) ? domain.highest - std::expm1(-z) : std::sinh(z);
}

double to_z(double theta, const Interval& domain) {
  if (std::isfinite(domain.lowest)) return std::isfinite(domain.highest) ? theta : std::log1p(theta - domain.lowest);
  return std::isfinite(domain.highest) ? -std::log1p(domain.highest - theta) : std::asinh(theta);
}

double theta_slope(double z, const Interval& domain) {
  if (std::isfinite(domain.lowest)) return std::isfinite(domain.highest) ? 1 : std::exp(z);
  return std::isfinite(domain.highest) ? std::exp(-z) : std::cosh(z);
}

double within_search(double tau) {
  return std::clamp(tau, -ParameterScale::kLargestTau, ParameterScale::kLargestTau);
}

}  // namespace

ParameterScale::ParameterScale(const FamilyInfo& family, int dim)
    : family_(&family), by_tau_(family.parameters.size() == 1 && family.theta_from_tau) {
  for (const ParameterInfo& parameter : family.parameters) domain_.push_back(parameter.domain(dim));
  if (by_tau_) {
    tau_ = family.tau_range(dim);
    box_ = {{std::atanh(within_search(tau_.lowest))}, {std::atanh(within_search(tau_.highest))}};
    return;
  }
  for (const Interval& domain : domain_) {
    box_.lower.push_back(to_z(searched(domain).lowest, domain));
    box_.upper.push_back(to_z(searched(domain).highest, domain));
  }
}

Theta ParameterScale::theta(const std::vector<double>& z) const {
  if (by_tau_) return theta_at_tau(std::tanh(z[0]));
  Theta theta(size());
  for (std::size_t i = 0; i < size(); ++i) theta[i] = nearest(to_theta(z[i], domain_[i]), domain_[i]);
  return theta;
}

std::vector<double> ParameterScale::z(const Theta& theta) const {
  if (by_tau_) return at_tau(family_->tau(theta));
  std::vector<double> z(size());
  for (std::size_t i = 0; i < size(); ++i) {
    z[i] = std::clamp(to_z(theta[i], domain_[i]), box_.lower[i], box_.upper[i]);
  }
  return z;
}

std::vector<double> ParameterScale::slope(const std::vector<double>& z) const {
  std::vector<double> slope(size());
  for (std::size_t i = 0; i < size(); ++i) slope[i] = theta_slope(z[i], domain_[i]);
  return slope;
}

Theta ParameterScale::theta_at_tau(double tau) const {
  const double attainable = std::clamp(within_search(tau), tau_.lowest, tau_.highest);
  return {nearest(family_->theta_from_tau(attainable)[0], domain_[0])};
}

std::vector<double> ParameterScale::at_tau(double tau) const {
  return {std::clamp(std::atanh(within_search(tau)), box_.lower[0], box_.upper[0])};
}

/// The part of the box where the lattice is: |z| up to kLatticeEnd, or that far from an end beyond.
Box ParameterScale::lattice_box() const {
  Box box = box_;
  for (std::size_t i = 0; i < size(); ++i) {
    box.lower[i] = std::max(box_.lower[i], std::min(-kLatticeEnd, box_.upper[i] - kLatticeEnd));
    box.upper[i] = std::min(box_.upper[i], std::max(kLatticeEnd, box_.lower[i] + kLatticeEnd));
  }
  return box;
}

std::vector<std::vector<double>> ParameterScale::lattice() const {
  std::vector<std::vector<double>> points;
  const Box box = lattice_box();
  for (int point = 0; point < kLatticePoints && size() > 0; ++point) {
    std::vector<double> z(size());
    const double part = static_cast<double>(point) / (kLatticePoints - 1);
    for (std::size_t i = 0; i < size(); ++i) z[i] = box.lower[i] + part * (box.upper[i] - box.lower[i]);
    points.push_back(std::move(z));
  }
  if (by_tau_) return points;
  for (const Theta& example : family_->examples) {
    bool admissible = example.size() == size();
    for (std::size_t i = 0; i < size() && admissible; ++i) {
      admissible = domain_[i].contains(example[i]);
    }
    if (admissible) points.push_back(z(example));
  }
  return points;
}

double ParameterScale::spacing() const {
  const Box box = lattice_box();
  double spacing = kLatticeEnd;
  for (std::size_t i = 0; i < size(); ++i) {
    spacing = std::min(spacing, (box.upper[i] - box.lower[i]) / (kLatticePoints - 1));
  }
  return spacing;
}

}  // namespace sklar
