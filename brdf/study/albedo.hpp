#pragma once
/// How much light a reflectance sends back (the paper's Eq. 20 and Fig. 5).

#include "brdf/render/hemisphere.hpp"

namespace sklar::brdf {

/// Directional albedo: the integral of f(wo, wi) cos(theta_i) over the hemisphere of wi.
struct AlbedoCurve {
  Eigen::ArrayXd theta_o;  ///< radians
  RgbRows albedo;          ///< a row for each theta_o
};

/// The default grid: 0, 1, ..., 89 degrees.
[[nodiscard]] Eigen::ArrayXd albedo_angles();

/// Directional albedo of an isotropic BRDF by the quadrature of hemisphere_nodes, on all threads. Relative error with
/// the default 192 x 128 nodes: rounding for Lambert; 1e-7 for isotropic GGX of roughness 0.005 to 1 up to 85 degrees,
/// 3e-6 at 88; 2e-3 for measured tables, whose interpolation has kinks, up to 85 degrees.
/// @param theta_o radians, each in [0, pi/2).
/// @throws std::invalid_argument if the BRDF claims anisotropy, std::domain_error for an angle outside.
[[nodiscard]] AlbedoCurve directional_albedo(const Brdf& brdf, const Eigen::ArrayXd& theta_o = albedo_angles(),
                                             const HemisphereOptions& nodes = {.polar = 192, .azimuth = 128});

}  // namespace sklar::brdf
