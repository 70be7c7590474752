#pragma once
/// Uniform cubic B-splines on [0,1] (de Boor 1978).

#include <Eigen/Core>
#include <array>

namespace sklar::brdf {

inline constexpr int kSplineOrder = 4;  ///< coefficients that act at a point, and the fewest there are

/// The coefficients first .. first + 3 act at a point, with these weights, which sum to 1.
struct SplineWeights {
  int first;
  std::array<double, kSplineOrder> weight;
};

/// @param x in [0,1]; outside the end polynomials go on. @param count of coefficients, >= kSplineOrder.
[[nodiscard]] SplineWeights spline_weights(double x, int count);

/// Row i: all weights at x(i). x.size() x count. One coefficient alone is a constant.
[[nodiscard]] Eigen::MatrixXd spline_basis(const Eigen::ArrayXd& x, int count);

/// Column m - 1: the coefficients of z, .., z^degree in the Bernstein polynomial C(degree, m) z^m (1 - z)^(degree - m).
/// A sum of these polynomials is 0 at z = 0, and in [0,1] between the least and the largest of 0 and its coefficients.
[[nodiscard]] Eigen::MatrixXd bernstein_powers(int degree);

/// The same as z times a polynomial in z - 1/2: rows are its powers 0 to degree - 1. On [0,1] they cancel little, so
/// single precision is enough for them.
[[nodiscard]] Eigen::MatrixXd azimuth_powers(int degree);

}  // namespace sklar::brdf
