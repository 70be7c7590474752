#pragma once
/// Positions between the nodes of an axis.

#include <algorithm>
#include <cmath>

namespace sklar::brdf {

/// Two neighbouring nodes and the share of the second.
struct Between {
  int low;
  int high;
  double share;
};

/// @param position in nodes, 0 at the first; outside [0, nodes - 1] the end nodes hold. @param nodes >= 1.
[[nodiscard]] inline Between between_clamped(double position, int nodes) {
  const double inside = std::clamp(position, 0.0, nodes - 1.0);
  const int low = std::max(std::min(static_cast<int>(inside), nodes - 2), 0);
  return {low, std::min(low + 1, nodes - 1), inside - low};
}

/// @param position in nodes, 0 at the first, in [-nodes, nodes); node `nodes` is node 0.
[[nodiscard]] inline Between between_periodic(double position, int nodes) {
  const double floor = std::floor(position);
  const int low = (static_cast<int>(floor) + nodes) % nodes;
  return {low, (low + 1) % nodes, position - floor};
}

[[nodiscard]] inline double mix(double a, double b, double share) {
  return a + share * (b - a);
}

}  // namespace sklar::brdf
