#pragma once
/// How fits read a table: what a cell counts by its directions, and how dark tables are brought to light.

#include <cstddef>

#include "brdf/geometry/coordinates.hpp"

namespace sklar::brdf {

/// What a cell counts in a fit: 0 with a cosine below 0.02, where tables hold noise; 0.1 with an angle beyond 80
/// degrees, where they are extrapolated; else 1.
[[nodiscard]] double fit_weight(const DirectionPair& pair);

/// Factor of the values in a fit: those so small that no measure of error would see them are brought to a mean of 0.1.
/// @param planes of a table, masked cells 0. @param valid_cells of each plane.
template <class Planes>
[[nodiscard]] double fit_scale(const Planes& planes, std::size_t valid_cells) {
  constexpr double kTiny = 1e-3, kOrdinary = 0.1;
  double sum = 0;
  for (const auto& plane : planes) {
    for (const auto value : plane) sum += static_cast<double>(value);
  }
  const double mean = sum / (3.0 * static_cast<double>(valid_cells));
  return mean > 0 && mean < kTiny ? kOrdinary / mean : 1;
}

}  // namespace sklar::brdf
