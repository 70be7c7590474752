#pragma once
/// Isotropic materials in anisotropic clothes: found and reduced to the isotropic table.

#include "brdf/data/anisotropic_table.hpp"

namespace sklar::brdf {

/// Enough to see anisotropy, cheap to fill: 82,944 cells.
inline constexpr AnisotropicGrid kProbeGrid{.theta_h = 24, .phi_h = 24, .theta_d = 12, .phi_d = 12};

/// isotropy_deviation of a reciprocal model tabulated on a grid. kSymmetricDeviation and less counts as isotropic.
[[nodiscard]] double isotropy_deviation(const Brdf& model, const AnisotropicGrid& grid = kProbeGrid);

/// The mean over phi_h of a reciprocal model at `azimuths` equidistant phi_h, on the cells of Grid; valid where both
/// cosines are positive. @throws std::invalid_argument if the model claims not to be reciprocal or azimuths < 1.
[[nodiscard]] MeasuredTable isotropic_mean(const Brdf& model, std::string name, Provenance provenance,
                                           int azimuths = 4);

/// The mean over phi_h of a table, read between its cells; valid where both cosines are positive and a cell around is
/// valid. @throws std::invalid_argument as require_table does.
[[nodiscard]] MeasuredTable isotropic_mean(const AnisotropicTable& table);

}  // namespace sklar::brdf
