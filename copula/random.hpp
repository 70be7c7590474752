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

/// rows x columns uniforms, filled row by row, so that the first rows do not depend on how many follow.
[[nodiscard]] inline Points uniforms(Rng& rng, Index rows, Index columns) {
  Points w(rows, columns);
  for (Index row = 0; row < rows; ++row) {
    for (Index column = 0; column < columns; ++column) w(row, column) = uniform(rng);
  }
  return w;
}

}  // namespace sklar
