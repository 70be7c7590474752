#pragma once
/// The coordinates of the refined model: half/difference angles, warped so that smooth functions of them are what
/// measured reflectance is a smooth function of. All three are algebraic in the dot products, so that evaluation needs
/// no arc cosine.

#include <Eigen/Core>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// Each in [0,1].
struct Warped {
  double half;        ///< ((1 - cos theta_h) (1 + w) / (1 - cos theta_h + w))^(1/4): like sqrt(theta_h) near 0
  double difference;  ///< 1 - sqrt(1 - sin theta_d): like theta_d, finer towards grazing
  double azimuth;     ///< cos^2 phi_d, damped to 0 at theta_h = 0 and theta_d = 0 where phi_d has no meaning
};

/// Folds phi_d at pi/2: reciprocity and the mirror symmetry of isotropic surfaces without handedness give
/// f(phi_d) = f(phi_d + pi) = f(-phi_d). The same to the last bit for (wo, wi) and (wi, wo).
/// @param width w > 0, the 1 - cos theta_h around which the axis of theta_h is finest.
/// @param wo, wi unit, above the horizon.
[[nodiscard]] Warped warp(double width, const Vec3& wo, const Vec3& wi);

/// What is added to (sin theta_h sin theta_d)^2 under (sin theta_h sin theta_d cos phi_d)^2.
inline constexpr double kPole = 1e-6;

}  // namespace sklar::brdf
