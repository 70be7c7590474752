#include "brdf/data/fit_weight.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sklar::brdf {

double fit_weight(const DirectionPair& pair) {
  constexpr double kLowestCosine = 0.02, kEdgeWeight = 0.1;
  static const double edge_cosine = std::cos(80 * std::numbers::pi / 180);
  const double lowest = std::min(pair.wi.z(), pair.wo.z());
  if (lowest < kLowestCosine) return 0;
  return lowest >= edge_cosine ? 1 : kEdgeWeight;
}

}  // namespace sklar::brdf
