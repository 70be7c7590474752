#pragma once
/// The coefficients of one polynomial as vector kernels take them.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sklar {

/// R(y) = sum_k c[k] (scale y)^k, all c positive.
struct Coefficients {
  std::vector<double> c;
  double scale = 1;
  double relative_error = 0;  ///< of every c

  /// Whether no sum at scale y <= 1, nor its reverse, leaves the range of double.
  [[nodiscard]] bool usable() const {
    constexpr double kSmallest = 1e-250, kLargest = 1e250;
    return std::ranges::all_of(c, [](double x) { return x > kSmallest && x < kLargest; });
  }
};

}  // namespace sklar
