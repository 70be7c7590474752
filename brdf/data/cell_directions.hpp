#pragma once
/// The direction pairs at the cell centres of Grid, which every pass over a table asks for.

#include "brdf/data/measured_table.hpp"
#include "brdf/geometry/coordinates.hpp"

namespace sklar::brdf {

/// directions() at the centre of a cell, from sines and cosines kept for every axis: products alone.
/// @param theta_h, theta_d, phi_d indices of a cell of Grid.
[[nodiscard]] DirectionPair cell_directions(int theta_h, int theta_d, int phi_d);

}  // namespace sklar::brdf
