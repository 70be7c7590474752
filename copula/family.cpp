#include "copula/family.hpp"

#include <cmath>

#include "copula/error.hpp"

namespace sklar {

bool Interval::contains(double value) const noexcept {
  const bool above = value > lowest || (lowest_included && value == lowest);
  const bool below = value < highest || (highest_included && value == highest);
  return above && below && std::isfinite(value);
}

std::string Interval::to_text() const {
  return (lowest_included && std::isfinite(lowest) ? "[" : "(") + sklar::to_text(lowest) + ", " +
         sklar::to_text(highest) + (highest_included && std::isfinite(highest) ? "]" : ")");
}

bool FamilyInfo::admits(int dim, const Theta& theta) const {
  if (!dimensions.contains(dim) || theta.size() != parameters.size()) return false;
  for (std::size_t i = 0; i < theta.size(); ++i) {
    if (!parameters[i].domain(dim).contains(theta[i])) return false;
  }
  return true;
}

void FamilyInfo::require_dimension(int dim) const {
  if (dim >= 2 && dimensions.contains(dim)) return;
  const std::string what = name + ": dimension must be " + dimensions.to_text() + ", got " + std::to_string(dim);
  if (dim < 2) throw std::invalid_argument(what);
  throw std::domain_error(what);
}

void FamilyInfo::require_admissible(int dim, const Theta& theta) const {
  require_dimension(dim);
  if (theta.size() != parameters.size()) {
    throw std::invalid_argument(name + ": takes " + std::to_string(parameters.size()) + " parameters, got " +
                                std::to_string(theta.size()));
  }
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const Interval domain = parameters[i].domain(dim);
    if (!domain.contains(theta[i])) {
      throw std::domain_error(name + ": " + parameters[i].name + " must be in " + domain.to_text() + " in dimension " +
                              std::to_string(dim) + ", got " + sklar::to_text(theta[i]));
    }
  }
}

CopulaPtr FamilyInfo::make(int dim, const Theta& theta) const {
  require_admissible(dim, theta);
  return make_unchecked(dim, theta);
}

Interval FamilyInfo::tau_range(int dim) const {
  const Interval domain = parameters.at(0).domain(dim);
  const Interval range{tau({domain.lowest}), tau({domain.highest}),
                       domain.lowest_included && std::isfinite(domain.lowest),
                       domain.highest_included && std::isfinite(domain.highest)};
  if (range.lowest <= range.highest) return range;
  return {range.highest, range.lowest, range.highest_included, range.lowest_included};  // tau falls with the parameter
}

Theta FamilyInfo::from_tau(int dim, double value) const {
  if (parameters.size() != 1 || !theta_from_tau) {
    throw std::invalid_argument(name + ": has no inverse of Kendall's tau; give theta");
  }
  require_dimension(dim);
  const Interval range = tau_range(dim);
  if (!range.contains(value)) {
    throw std::domain_error(name + ": tau must be in " + range.to_text() + " in dimension " + std::to_string(dim) +
                            ", got " + sklar::to_text(value));
  }
  return theta_from_tau(value);
}

}  // namespace sklar
