#pragma once
/// Lambert's W in logarithms.

#include <algorithm>
#include <cmath>
#include <limits>

namespace sklar {

/// The l > 0 with a (e^l - 1) + b l = t, accurate in the relative sense: l = log( (b/a) W_0((a/b) e^((a+t)/b)) ), where
/// the argument of W_0 may overflow and the logarithm cancel. By steps of fourth order from above, as Fritsch, Shafer
/// and Crowley (1973), Algorithm 443, Communications of the ACM 16(2), for w e^w; two or three in double.
/// @param a,b,t > 0, finite.
template <class Real>
[[nodiscard]] Real log_lambert(const Real& a, const Real& b, const Real& t) {
  using std::abs, std::expm1, std::log1p, std::sqrt;
  const Real sum = a + b, share = a / sum, rest = b / sum, target = t / sum;
  const auto step = [](const Real& newton, const Real& curvature) {
    const Real product = curvature * newton;
    return Real(newton * (1 + product / 2) / (1 + product + product * newton / 6));
  };
  // Both are above the root: share (e^l - 1) >= share l, and rest l > 0.
  Real l = target < 1 ? step(target, share) : std::min(target, Real(log1p(Real(t / a))));
  const Real enough = sqrt(sqrt(std::numeric_limits<Real>::epsilon()));  // the error left is of the fourth power
  constexpr int kMostSteps = 40;
  for (int i = 0; i < kMostSteps; ++i) {
    const Real growth = share * expm1(l), slope = share + growth + rest;
    const Real change = step((target - growth - rest * l) / slope, Real((share + growth) / slope));
    l += change;
    if (abs(change) <= enough * std::min(l, Real(1))) break;
  }
  return l;
}

}  // namespace sklar
