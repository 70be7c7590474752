#pragma once
/// Directions as the vector kernels read them.

#include <cstddef>

namespace sklar::brdf {

/// Coordinate k of row i at first[k * stride + i].
struct DirectionRows {
  const double* first;
  std::ptrdiff_t stride;
};

}  // namespace sklar::brdf
