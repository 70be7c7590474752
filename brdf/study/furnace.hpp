#pragma once
/// The white furnace: a surface under light of radiance 1 from everywhere sends back its directional albedo, which a
/// sampler estimates by the mean of its weights.

#include <cstdint>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// Means over draws and their standard errors; a row for each theta_o.
struct FurnaceCurve {
  RgbRows albedo, sigma;
};

/// The albedo by the BRDF's own sampler. Runs on all threads of oneTBB; the result does not depend on their number.
/// @param theta_o radians, each in [0, pi/2). @param draws for each theta_o, at least 2.
/// @throws std::domain_error for an angle outside, std::invalid_argument for fewer draws.
[[nodiscard]] FurnaceCurve furnace_albedo(const Brdf& brdf, const Eigen::ArrayXd& theta_o, Eigen::Index draws,
                                          std::uint64_t seed);

}  // namespace sklar::brdf
