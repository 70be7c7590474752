#pragma once
/// The copulas in a fitted model, as a report draws them.

#include <string>

#include "brdf/brdf.hpp"
#include "copula/copula.hpp"

namespace sklar::brdf {

/// A JSON array, empty for a model without copulas: {"theta_d" in degrees, "component" from 1, "tau", "density"[i][j]},
/// c(u, v) of two coordinates at u = (i + 1/2) / n and v = (j + 1/2) / n. Of a PaperBrdf the copula of every slice that
/// is not black, in green; of a RefinedBrdf those of its components at 15, 45 and 75 degrees.
[[nodiscard]] std::string copula_densities_json(const Brdf& brdf);

/// c(u, v) of the first two coordinates as "density" above, five digits. @param nodes n.
[[nodiscard]] std::string pair_density_json(const Copula& copula, int nodes);

}  // namespace sklar::brdf
