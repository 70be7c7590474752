#include "brdf/model/spline.hpp"

#include <algorithm>

namespace sklar::brdf {

SplineWeights spline_weights(double x, int count) {
  const int intervals = count - kSplineOrder + 1;
  const double position = x * intervals;
  const int first = std::clamp(static_cast<int>(position), 0, intervals - 1);
  const double t = position - first, s = 1 - t;
  return {.first = first,
          .weight = {s * s * s / 6, (t * t * (3 * t - 6) + 4) / 6, (s * s * (3 * s - 6) + 4) / 6, t * t * t / 6}};
}

Eigen::MatrixXd spline_basis(const Eigen::ArrayXd& x, int count) {
  if (count == 1) return Eigen::MatrixXd::Ones(x.size(), 1);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(x.size(), count);
  for (Eigen::Index row = 0; row < x.size(); ++row) {
    const SplineWeights weights = spline_weights(x(row), count);
    for (int i = 0; i < kSplineOrder; ++i) basis(row, weights.first + i) = weights.weight[static_cast<std::size_t>(i)];
  }
  return basis;
}

Eigen::MatrixXd bernstein_powers(int degree) {
  Eigen::MatrixXd powers = Eigen::MatrixXd::Zero(degree, degree);
  double row = 1;  // C(degree, i)
  for (int i = 1; i <= degree; ++i) {
    row = row * (degree - i + 1) / i;
    double column = 1;  // C(i, m)
    for (int m = i; m >= 1; --m) {
      powers(i - 1, m - 1) = ((i - m) % 2 == 0 ? 1 : -1) * row * column;
      column = column * m / (i - m + 1);
    }
  }
  return powers;
}

Eigen::MatrixXd azimuth_powers(int degree) {
  Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(degree, degree);  // of z^k: C(k, j) 2^(j - k) at (z - 1/2)^j
  for (int k = 0; k < degree; ++k) {
    double entry = 1;
    for (int j = k; j >= 0; --j) {
      shift(j, k) = entry;
      entry *= 0.5 * j / (k - j + 1);
    }
  }
  return shift * bernstein_powers(degree);
}

}  // namespace sklar::brdf
