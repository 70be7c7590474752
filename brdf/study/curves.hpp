#pragma once
/// What a report plots of one reflectance.

#include <string>

#include "brdf/study/figures.hpp"

namespace sklar::brdf {

/// A JSON object of numbers with four digits: "lobes"[theta_i][theta_o], luminance of f_r [1/sr] in the plane of
/// incidence; "albedo"[channel][theta_o]; "theta_h" and "phi_d", the shares of cell_shares of green.
/// "copulas", copula_densities_json; of a RefinedBrdf also "live", live_sphere_json. Of a SampledBrdf what it samples.
/// @param view of the same reflectance.
[[nodiscard]] std::string curves_json(const Brdf& brdf, const View& view);

/// Where these stand, in degrees: "lobe_theta_i"; "lobe_theta_o", above 0 on the side of the mirror direction;
/// "albedo_theta_o", "theta_h", "phi_d".
[[nodiscard]] std::string curve_axes_json();

}  // namespace sklar::brdf
