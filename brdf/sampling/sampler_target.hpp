#pragma once
/// What a ConditionalSampler is fitted to: quadrature points of the luminance of f_r cos(theta_i) given theta_o.

#include <vector>

#include "brdf/geometry/half_disk.hpp"

namespace sklar::brdf {

/// A direction and how much light it stands for.
struct TargetPoint {
  WiCoordinates at;
  double measure;  ///< solid angle it stands for, both sides of the plane of incidence
  double mass;     ///< share of the reflected light; the sum over the points is 1, or all are 0
};

/// The points follow the light: along each azimuth of the half vector the light is found at angles over seven decades,
/// and then half of the points are put where it is. So lobes of any width are resolved.
/// @param cosine of theta_o, in (0,1]. @param azimuths of the half vector; 48 points each. @param turns azimuths of wo
/// over which the light is averaged; 1 if isotropic.
[[nodiscard]] std::vector<TargetPoint> sampler_target(const Brdf& brdf, double cosine, int azimuths, int turns);

}  // namespace sklar::brdf
