#pragma once
/// Any reflectance model as a table.

#include <string>

#include "brdf/data/measured_table.hpp"

namespace sklar::brdf {

/// The values of a reciprocal, isotropic model at the bin centres; valid where both cosines are positive. Runs on all
/// threads of oneTBB. @throws std::invalid_argument if the model claims not to be reciprocal or isotropic.
[[nodiscard]] MeasuredTable tabulate(const Brdf& model, std::string name, Provenance provenance);

}  // namespace sklar::brdf
