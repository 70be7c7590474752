#pragma once
/// The conformance suite runs once for every registered family, named in no test.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "copula/error.hpp"
#include "copula/random.hpp"
#include "tests/support/chi_square.hpp"
#include "tests/support/family_cases.hpp"

/// A suite for TEST_P over the registered families.
// NOLINTBEGIN(bugprone-macro-parentheses): a class name takes none
#define SKLAR_FAMILY_SUITE(Suite)                                           \
  class Suite : public sklar::test::FamilyTest {};                          \
  INSTANTIATE_TEST_SUITE_P(                                                 \
      Family, Suite, testing::ValuesIn(sklar::test::registered_families()), \
      [](const testing::TestParamInfo<const sklar::FamilyInfo*>& each) { return each.param->name; })
// NOLINTEND(bugprone-macro-parentheses)

namespace sklar::test {

inline std::vector<const FamilyInfo*> registered_families() {
  std::vector<const FamilyInfo*> families;
  for (const FamilyInfo& family : families::all()) families.push_back(&family);
  return families;
}

class FamilyTest : public testing::TestWithParam<const FamilyInfo*> {
 protected:
  [[nodiscard]] static const FamilyInfo& family() { return *GetParam(); }

  /// The family's admissible examples in each dimension.
  [[nodiscard]] static std::vector<FamilyCase> cases(const std::vector<int>& dims) {
    return only_mine(family_cases(dims));
  }

  /// One example a dimension, with tau nearest to the one asked for.
  [[nodiscard]] static std::vector<FamilyCase> cases_near(double tau, const std::vector<int>& dims) {
    return only_mine(family_cases_near(tau, dims));
  }

 private:
  static std::vector<FamilyCase> only_mine(const std::vector<FamilyCase>& all) {
    std::vector<FamilyCase> mine;
    for (const FamilyCase& next : all) {
      if (next.family == GetParam()) mine.push_back(next);
    }
    return mine;
  }
};

/// Values that every test includes: lattices of the interior miss whole families of bugs.
inline const std::vector<double>& hard_values() {
  static const std::vector<double> values = {1e-100, 1e-12, 1e-3, 0.5, 1 - 1e-9, 1 - 1e-14};
  return values;
}

/// n points of the open cube, each coordinate a hard value or a uniform.
inline Points hard_points(Index n, int dim, Rng& rng) {
  Points u = uniforms(rng, n, dim);
  for (Index i = 0; i < n; ++i) {
    for (int k = 0; k < dim; ++k) {
      if (rng() % 2 == 0) u(i, k) = hard_values()[rng() % hard_values().size()];
    }
  }
  return u;
}

inline std::vector<double> row_of(const Points& u, Index row) {
  std::vector<double> values(static_cast<std::size_t>(u.cols()));
  for (Index k = 0; k < u.cols(); ++k) values[static_cast<std::size_t>(k)] = u(row, k);
  return values;
}

/// As in "(0.5, 1e-12)".
inline std::string row_text(const Points& u, Index row) {
  std::string text = "(";
  for (Index k = 0; k < u.cols(); ++k) text += (k > 0 ? ", " : "") + to_text(u(row, k));
  return text + ")";
}

}  // namespace sklar::test
