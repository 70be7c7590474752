#pragma once
/// Pearson's test of observed counts against expected ones, for samplers.

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace sklar::test {

/// A seed that follows from the test's name alone (FNV-1a), so that it is never picked to pass.
inline std::uint64_t seed_of_this_test() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::uint64_t hash = 14695981039346656037U;
  for (const char letter : std::string(test->test_suite_name()) + "." + test->name()) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211U;
  }
  return hash;
}

/// The level of each of `tests` independent tests at which all of them pass with probability 0.9999 (Sidak 1967): some
/// twenty such families run at two numbers of draws, and each change of a fit or a sampler rolls all their dice again.
inline double sidak_level(int tests) {
  return -std::expm1(std::log(0.9999) / tests);
}

struct ChiSquare {
  double statistic = 0;
  int cells = 0;  ///< after pooling
  double p = 1;   ///< chance of a larger statistic if the expectation is right
};

/// @param observed, expected one count a cell, the expectation summing to the number of draws. Cells expecting fewer
/// than 5 draws are pooled into one.
inline ChiSquare chi_square(const std::vector<double>& observed, const std::vector<double>& expected) {
  ChiSquare result;
  double pooled_observed = 0;
  double pooled_expected = 0;
  const auto add = [&](double count, double expectation) {
    result.statistic += (count - expectation) * (count - expectation) / expectation;
    ++result.cells;
  };
  for (std::size_t cell = 0; cell < expected.size(); ++cell) {
    if (expected[cell] >= 5) {
      add(observed[cell], expected[cell]);
    } else {
      pooled_observed += observed[cell];
      pooled_expected += expected[cell];
    }
  }
  // A pool that expects next to nothing still counts: draws in it are then impossible ones.
  if (pooled_expected >= 5 || pooled_observed > 25) add(pooled_observed, std::max(pooled_expected, 1e-3));
  if (result.cells > 1) {
    const boost::math::chi_squared distribution(result.cells - 1);
    result.p = boost::math::cdf(boost::math::complement(distribution, result.statistic));
  }
  return result;
}

/// Fails the running test if the counts do not agree at sidak_level(tests); the table then goes to a file.
inline void expect_chi_square(const std::vector<double>& observed, const std::vector<double>& expected, int tests,
                              const std::string& what) {
  const ChiSquare result = chi_square(observed, expected);
  EXPECT_GT(result.cells, 1) << what;
  if (result.p > sidak_level(tests)) return;
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::string path = testing::TempDir() + "chi_square_" + test->test_suite_name() + "_" + test->name() + ".csv";
  std::ofstream table(path);
  table << "cell,observed,expected\n";
  for (std::size_t cell = 0; cell < expected.size(); ++cell) {
    table << cell << ',' << observed[cell] << ',' << expected[cell] << '\n';
  }
  ADD_FAILURE() << what << ": chi-square " << result.statistic << " over " << result.cells << " cells, p = " << result.p
                << ", level " << sidak_level(tests) << "; table in " << path;
}

}  // namespace sklar::test
