#pragma once
/// The built-in material: what the software works on when no file is given.

#include "brdf/data/measured_table.hpp"

namespace sklar::brdf {

/// A blue coated surface: Lambert, albedo (0.06, 0.14, 0.30), plus Ggx, f0 0.05, alpha 0.25, at the bin centres of the
/// grid, cells below the horizon masked, and each value times exp(0.02 z), z standard normal, seeded: the scatter of a
/// measurement of 2 %. The same on every call. name and provenance are synthetic.
[[nodiscard]] MeasuredTable builtin_material();

}  // namespace sklar::brdf
