#pragma once
/// Values for the cells that were not measured.

#include "brdf/data/measured_table.hpp"

namespace sklar::brdf {

/// The table with every masked cell given the mean of its neighbours along the three axes (phi_d periodic) that have a
/// value, layer by layer from the valid cells outward; then all cells are valid. For models that need a value on every
/// point of a grid: between valid cells it is interpolated, below the horizon continued. Linear in the cells.
/// @throws std::invalid_argument if no cell is valid.
[[nodiscard]] MeasuredTable filled(const MeasuredTable& table);

}  // namespace sklar::brdf
