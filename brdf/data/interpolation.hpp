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

/// Images of a stack: those of `within`, and by `share` those `step` images on.
struct ImageBlend {
  Between within;
  int step = 0;
  double share = 0;
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

/// Linear interpolation from a (share 0) to b (share 1).
[[nodiscard]] inline double mix(double a, double b, double share) {
  return a + share * (b - a);
}

/// Mixes what at(image) gives for the images of a blend.
template <class At>
[[nodiscard]] double mix(const ImageBlend& blend, const At& at) {
  const double here = mix(at(blend.within.low), at(blend.within.high), blend.within.share);
  if (blend.share == 0) return here;
  const double there = mix(at(blend.within.low + blend.step), at(blend.within.high + blend.step), blend.within.share);
  return mix(here, there, blend.share);
}

}  // namespace sklar::brdf
