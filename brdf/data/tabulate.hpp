#pragma once
/// Any reflectance model as a table.

#include <string>

#include "brdf/data/anisotropic_table.hpp"

namespace sklar::brdf {

/// The values of a reciprocal, isotropic model at the bin centres; valid where both cosines are positive. Runs on all
/// threads of oneTBB. @throws std::invalid_argument if the model claims not to be reciprocal or isotropic.
[[nodiscard]] MeasuredTable tabulate(const Brdf& model, std::string name, Provenance provenance);

/// The same for any reciprocal model, over four coordinates. @param grid its symmetries are those that the model is
/// known to have: what they repeat is evaluated once. @throws std::invalid_argument if the model claims not to be
/// reciprocal or the grid is not sound.
[[nodiscard]] AnisotropicTable tabulate_anisotropic(const Brdf& model, std::string name, Provenance provenance,
                                                    const AnisotropicGrid& grid = {});

}  // namespace sklar::brdf
