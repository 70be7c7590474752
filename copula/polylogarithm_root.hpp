#pragma once
/// Where a polylogarithm falls to a given fraction of its value: the conditional inverses of Frank and Ali-Mikhail-Haq.
///
/// With y = x/(1-x) and W = 1 + 2y, x dW/dx = (W^2-1)/2, so that Li_(1-n), n >= 2, is a polynomial of W with the parity
/// of n:
///   Li_-1 = (W^2-1)/4,  Li_-2 = W (W^2-1)/4,  Li_-3 = (W^2-1) (3W^2-1)/8
/// n = 2 and 4 are quadratics for W^2 - 1, n = 3 is a cubic without a square. They are solved for B = (1-x) W, which
/// is well conditioned and lies between 1-x and 1+x. From B, the fraction z of y is a difference, and so is 1 - z; both
/// are written as products of p or 1 - p instead.

#include <cmath>
#include <utility>

#include "copula/numerics.hpp"

namespace sklar {

namespace polylogarithm {

/// n = 2: y z (1 + y z) = p y (1 + y).
template <class T>
[[nodiscard]] std::pair<T, T> solve_quadratic(const T& x, const T& w, const T& p) {
  const T rest = T(1) - p;
  const T root = sqrt(x > T(0) ? w * w + T(4) * x * p : (T(1) + x) * (T(1) + x) - T(4) * x * rest);
  return {T(2) * p / (w + root), T(2) * rest / (T(1) + x + root)};
}

/// The largest root of B^3 - w^2 B = c, c >= -2 (w^2/3)^(3/2): Viete's formula where there are three, Cardano's where
/// there is one (DLMF 1.11(iii)).
template <class Real>
[[nodiscard]] Real cubic_root(const Real& w, const Real& c) {
  using std::atan, std::cbrt, std::cos, std::sqrt;
  const Real half = c / 2, square = w * w / 3, edge = sqrt(square) * square;
  if (half < edge) {  // half / edge = cos(3 phi)
    const Real phi = 2 * atan(Real(sqrt(Real((edge - half) / (edge + half))))) / 3;
    return 2 * sqrt(square) * cos(phi);
  }
  const Real v = cbrt(Real(half + sqrt(Real(half - edge)) * sqrt(Real(half + edge))));
  return v + square / v;
}

/// n = 3: B^3 - w^2 B = p (A^3 - w^2 A) = 4 p x A, A = 1 + x the B of p = 1.
template <class T>
[[nodiscard]] std::pair<T, T> solve_cubic(const T& x, const T& w, const T& p) {
  const T a = T(1) + x, four = T(4) * x, level = four * a * p;
  T b(cubic_root(w.value, level.value), 0);
  const T residual = b * (b * b - w * w) - level;
  const T chord = four + b * (a + b);  // the slope of the cubic between b and A
  // It is residual / (b - root) = b^2 + b root + root^2 - w^2 at the root, which is above w for x > 0, A for x < 0.
  b.error = largest_magnitude(residual / (x > T(0) ? b * (b + w) : chord));
  return {T(2) * a * p / (b * (b + w)), T(2) * a * (T(1) - p) / (four + b * (a + b))};
}

/// n = 4: Y m (1 + Y m) = p Y (1 + Y), Y = 6x/w^2, m the fraction to which W^2 - 1 falls.
template <class T>
[[nodiscard]] std::pair<T, T> solve_quartic(const T& x, const T& w, const T& p) {
  const T a = T(1) + x, square = w * w, six = T(6) * x;
  const T whole = x > T(0) ? square + six : a * a + T(2) * x;
  const auto [m, rest] = solve_quadratic<T>(six / whole, square / whole, p);
  const T b = sqrt(x > T(0) ? square + T(4) * x * m : a * a - T(4) * x * rest);
  return {T(2) * m / (b + w), T(2) * rest / (a + b)};
}

}  // namespace polylogarithm

/// The largest n that polylogarithm_root takes.
inline constexpr int kLargestPolylogarithmRoot = 4;

/// z and 1 - z in [0,1], each accurate in the relative sense, with f(y z) = p f(y) where f(x/(1-x)) = Li_(1-n)(x),
/// 2 <= n <= 4, y = x/w, in closed form. @param x below 1; negative only where f is monotone from 0 to y.
/// @param w 1 - x. @param p in (0,1).
template <class T>
[[nodiscard]] std::pair<T, T> polylogarithm_root(int n, const T& x, const T& w, const T& p) {
  if (n == 2) return polylogarithm::solve_quadratic(x, w, p);
  return n == 3 ? polylogarithm::solve_cubic(x, w, p) : polylogarithm::solve_quartic(x, w, p);
}

}  // namespace sklar
