#pragma once
/// Seeded uniforms, the same on every platform.

#include <cstdint>
#include <random>

#include "copula/types.hpp"

namespace sklar {

using Rng = std::mt19937_64;

/// One uniform strictly inside (0,1): the midpoints of 2^52 equal cells, so that 0 and 1 never occur.
[[nodiscard]] inline double uniform(Rng& rng) {
  return (static_cast<double>(rng() >> 12) + 0.5) * 0x1p-52;
}

/// Uniforms for every entry, row by row, so that the first rows do not depend on how many follow.
inline void fill_uniforms(Rng& rng, PointsOut w) {
  for (Index row = 0; row < w.rows(); ++row) {
    for (Index column = 0; column < w.cols(); ++column) w(row, column) = uniform(rng);
  }
}

/// rows x columns uniforms in that order.
[[nodiscard]] inline Points uniforms(Rng& rng, Index rows, Index columns) {
  Points w(rows, columns);
  fill_uniforms(rng, w);
  return w;
}

}  // namespace sklar
