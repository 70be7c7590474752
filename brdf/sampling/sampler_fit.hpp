#pragma once
/// The tables of a ConditionalSampler from any reflectance.

#include "brdf/brdf.hpp"
#include "brdf/sampling/sampler_tables.hpp"

namespace sklar::brdf {

/// Expectation maximisation at each node of theta_o (Dempster, Laird and Rubin 1977): margins that are linear between
/// knots are mixtures of hat functions, so a step is closed-form but for the dependence, which is searched. Truncation
/// at the horizon is a case of missing data. The last steps follow f^2 / pdf in place of f, as the variance of the
/// weight does. Widths are searched at a few theta_o by the same steps.
/// @param cosine_share of the draws that follow the cosine, whatever the fit.
[[nodiscard]] SamplerTables fit_sampler(const Brdf& brdf, double cosine_share);

}  // namespace sklar::brdf
