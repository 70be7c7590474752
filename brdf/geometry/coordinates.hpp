#pragma once
/// Half/difference coordinates of a direction pair. Source: Rusinkiewicz 1998, "A New Change of Variables for Efficient
/// BRDF Representation".
///
/// h is the half vector, (theta_h, phi_h) its angles; (theta_d, phi_d) are the angles of one direction in the frame of
/// h, Rz(phi_h) Ry(theta_h): x toward increasing theta_h, y = n x h. Exchanging the two directions turns phi_d by pi,
/// so a reciprocal reflectance needs only [0,pi). An isotropic one does not depend on phi_h.
///
/// With a = wi + wo and d = wi - wo, |a| = 2 cos(theta_d) and |d| = 2 sin(theta_d), and d is normal to h: every angle
/// is an atan2 of sums and differences, without the acos that loses half the digits near 0.

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// Isotropic, reciprocal half/difference coordinates, radians.
struct HalfDifference {
  double theta_h;  ///< [0,pi/2] for directions above the horizon
  double theta_d;  ///< [0,pi/2]
  double phi_d;    ///< [0,pi)
};

/// All four coordinates, of a reflectance that depends on phi_h.
struct HalfDifference4 {
  double theta_h;  ///< [0,pi/2] for directions above the horizon
  double phi_h;    ///< [0,2 pi)
  double theta_d;  ///< [0,pi/2]
  double phi_d;    ///< [0,pi)
};

/// Two directions, unit, away from the surface.
struct DirectionPair {
  Vec3 wi;
  Vec3 wo;
};

/// Coordinates of the pair; the same to the last bit for (wo, wi) and (wi, wo). phi_d is 0 where wi = wo, and the
/// azimuth of h is taken as 0 where h = z. Absolute errors, in units of 1e-15: 1 in theta_d, 1 / cos(theta_d) in
/// theta_h, 4 / (sin(theta_d) sin(theta_h)) in phi_d, which has no meaning where either angle is 0.
/// @param wo, wi unit; above the horizon, or at least not opposite to each other.
[[nodiscard]] HalfDifference half_difference(const Vec3& wo, const Vec3& wi);

/// The pair at these coordinates with phi_h = 0; wi is the direction at phi_d, wo the one at phi_d + pi. Either may lie
/// below the horizon: cos_i = cos th cos td - sin th sin td cos pd, cos_o the same with +.
[[nodiscard]] DirectionPair directions(const HalfDifference& coordinates);

/// The four coordinates, as half_difference gives three of them; phi_h is 0 where h = z.
[[nodiscard]] HalfDifference4 half_difference4(const Vec3& wo, const Vec3& wi);

/// The pair at these coordinates, as for three of them, turned by phi_h.
[[nodiscard]] DirectionPair directions4(const HalfDifference4& coordinates);

}  // namespace sklar::brdf
