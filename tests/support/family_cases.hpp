#pragma once
/// The registered families with their admissible examples, by dimension.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "families/registry.hpp"

namespace sklar::test {

struct FamilyCase {
  const FamilyInfo* family;
  int dim;
  Theta theta;

  [[nodiscard]] CopulaPtr copula() const { return family->make(dim, theta); }
  [[nodiscard]] double tau() const { return family->tau(theta); }
  [[nodiscard]] std::string name() const {
    std::string text = family->name + " d=" + std::to_string(dim);
    for (const double value : theta) text += " " + std::to_string(value);
    return text;
  }
};

/// Every family x dimension x admissible example.
inline std::vector<FamilyCase> family_cases(const std::vector<int>& dims) {
  std::vector<FamilyCase> cases;
  for (const FamilyInfo& family : families::all()) {
    for (const int dim : dims) {
      for (const Theta& theta : family.examples) {
        if (family.admits(dim, theta)) cases.push_back({&family, dim, theta});
      }
    }
  }
  return cases;
}

/// tau, or what is nearest to it in the middle four fifths of the range that the family has in a dimension.
inline double tau_inside(const FamilyInfo& family, int dim, double tau) {
  if (family.parameters.size() != 1) return tau;
  const Interval range = family.tau_range(dim);
  const double margin = (range.highest - range.lowest) / 10;
  return std::clamp(tau, range.lowest + margin, range.highest - margin);
}

/// One case a family and dimension: the example with tau nearest to the one asked for, away from the ends of the range.
inline std::vector<FamilyCase> family_cases_near(double tau, const std::vector<int>& dims) {
  std::vector<FamilyCase> nearest;
  for (FamilyCase& next : family_cases(dims)) {
    const bool same = !nearest.empty() && nearest.back().family == next.family && nearest.back().dim == next.dim;
    const double wanted = tau_inside(*next.family, next.dim, tau);
    if (!same) {
      nearest.push_back(std::move(next));
    } else if (std::abs(next.tau() - wanted) < std::abs(nearest.back().tau() - wanted)) {
      nearest.back() = std::move(next);
    }
  }
  return nearest;
}

}  // namespace sklar::test
