#pragma once
/// The registered families with their admissible examples, by dimension.

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

inline bool admissible(const FamilyInfo& family, int dim, const Theta& theta) {
  for (std::size_t i = 0; i < theta.size(); ++i) {
    if (!family.parameters[i].domain(dim).contains(theta[i])) return false;
  }
  return true;
}

/// Every family x dimension x admissible example.
inline std::vector<FamilyCase> family_cases(const std::vector<int>& dims) {
  std::vector<FamilyCase> cases;
  for (const FamilyInfo& family : families::all()) {
    for (const int dim : dims) {
      for (const Theta& theta : family.examples) {
        if (admissible(family, dim, theta)) cases.push_back({&family, dim, theta});
      }
    }
  }
  return cases;
}

/// One case a family and dimension: the example with tau nearest to the one asked for.
inline std::vector<FamilyCase> family_cases_near(double tau, const std::vector<int>& dims) {
  std::vector<FamilyCase> nearest;
  for (FamilyCase& next : family_cases(dims)) {
    const bool same = !nearest.empty() && nearest.back().family == next.family && nearest.back().dim == next.dim;
    if (!same) {
      nearest.push_back(std::move(next));
    } else if (std::abs(next.tau() - tau) < std::abs(nearest.back().tau() - tau)) {
      nearest.back() = std::move(next);
    }
  }
  return nearest;
}

}  // namespace sklar::test
