#pragma once
/// The coordinates of wi given wo that samplers work in, all algebraic in the components.
///
/// Of the half vector, with z = tan(theta_h) exp(i (phi_h - phi_o)), a complex number:
///     m = z / (cos(theta_o) + sin(theta_o) z).
/// wi is above the horizon exactly where |m| < 1, whatever theta_o: in the plane of z the horizon is the circle
/// |z - tan(theta_o)| = 1 / cos(theta_o), whose inside the scaling projection of Edwards et al. 2006, "The Halfway
/// Vector Disk for BRDF Modeling", takes to a unit disk with backscattering in its middle. m is the Moebius map of it
/// to the unit disk with the mirror direction in its middle, which keeps lobes around it round. Back, with D = |1 -
/// sin(theta_o) m|^2:
///     tan(theta_h) exp(i (phi_h - phi_o)) = cos(theta_o) m / (1 - sin(theta_o) m),
///     cos(theta_i) = cos(theta_o) (1 - |m|^2) / (D + cos^2(theta_o) |m|^2).
/// The solid angle is dwi = 4 (wo.h) dwh and dwh = |dz|^2 / (1 + |z|^2)^(3/2).
///
/// Of wi itself: radius2 = sin^2(theta_i) and phi_i - phi_o; a uniform radius2 is the cosine hemisphere.

#include <algorithm>
#include <cmath>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// Half a turn phi in [0, pi] as s in [0,1] without trigonometry: s = tan(phi/2) / 2 up to pi/2, mirrored beyond.
struct FoldedAzimuth {
  double s;
  double slope;  ///< ds/dphi

  /// Of a vector in the plane, phi counted from x. @param length of (x, y). s is 0 for the null vector.
  [[nodiscard]] static FoldedAzimuth of(double x, double y, double length) {
    constexpr double kTiny = 1e-300;
    const double tangent = std::abs(y) / (length + std::abs(x) + kTiny);
    return {0.5 - std::copysign(0.5 - 0.5 * tangent, x), 0.25 + 0.25 * tangent * tangent};
  }
};

/// What the coordinates need of wo, above the horizon; by default, along the normal.
struct Outgoing {
  Outgoing() = default;
  explicit Outgoing(const Vec3& wo) : sine(std::sqrt(wo.x() * wo.x() + wo.y() * wo.y())) {
    constexpr double kLeast = 1e-8;     // the cosine below which nothing changes any more, so that all stays finite
    constexpr double kNormal = 1e-100;  // below, the plane of incidence has no meaning left, and none is needed
    cosine = std::max(wo.z(), kLeast);
    if (sine > kNormal) along = Vec2(wo.x(), wo.y()) * (1 / sine);
  }

  double sine = 0, cosine = 1;  ///< of theta_o
  Vec2 along = Vec2(1, 0);      ///< unit, wo's direction in the plane of the surface
};

/// Of the half vector of two directions above the horizon.
struct HalfDisk {
  double x, y;  ///< along m, of length `length`
  double length;
  double square;  ///< |m|^2, in [0,1]
  double rest;    ///< 1 - |m|^2 to its own digits: cos(theta_o) cos(theta_i) |wo + wi|^2 / |below|^2
  double area;    ///< d^2 m / dwi

  /// @param wo, wi unit. @param given of wo.
  HalfDisk(const Outgoing& given, const Vec3& wo, const Vec3& wi) {
    const double sum_x = wi.x() + wo.x(), sum_y = wi.y() + wo.y(), sum_z = wi.z() + wo.z();
    const double along = sum_x * given.along.x() + sum_y * given.along.y();
    const double across = sum_y * given.along.x() - sum_x * given.along.y();
    const double level2 = along * along + across * across, sum2 = level2 + sum_z * sum_z;
    // m = (along + i across) / (a + i b)
    const double up = given.cosine * sum_z, a = up + given.sine * along, b = given.sine * across;
    const double below2 = a * a + b * b;
    x = up * along + given.sine * level2;
    y = up * across;
    length = std::sqrt(level2 * below2);
    square = std::min(level2 / below2, 1.0);
    rest = given.cosine * wi.z() * sum2 / below2;
    area = given.cosine * up * sum2 / (2 * below2 * below2);
  }
};

/// wi relative to the plane of incidence: along it towards wo, across it, up.
struct LocalDirection {
  double along, across, up;
};

/// wi of a point of the disk. @param x, y of m. @param square |m|^2. @param rest 1 - |m|^2.
[[nodiscard]] inline LocalDirection from_disk(const Outgoing& given, double x, double y, double square, double rest) {
  const double c = given.cosine, q = given.sine;
  const double away = 1 - q * x, d = away * away + (q * y) * (q * y), d_up = d + c * c * square;
  const double inverse = 1 / (d * d_up), factor = 2 * c * c * away * inverse;
  return {factor * (x - q * square) - q, factor * y, c * rest * d * inverse};
}

/// wi given wo in both coordinates of the sampler, with the measure of each.
struct WiCoordinates {
  double disk2;         ///< |m|^2, in [0,1]
  double disk_azimuth;  ///< FoldedAzimuth of the argument of m
  double disk_measure;  ///< d|m|^2 ddisk_azimuth / dwi, half of it for each side of the plane of incidence
  double radius2;       ///< sin^2(theta_i)
  double azimuth;       ///< FoldedAzimuth of phi_i - phi_o
  double measure;       ///< dradius2 dazimuth / dwi, half of it for each side

  /// @param wo, wi unit, above the horizon. @param given of wo.
  WiCoordinates(const Outgoing& given, const Vec3& wo, const Vec3& wi) {
    const HalfDisk half(given, wo, wi);
    const FoldedAzimuth of_m = FoldedAzimuth::of(half.x, half.y, half.length);
    disk2 = half.square;
    disk_azimuth = of_m.s;
    disk_measure = of_m.slope * half.area;

    radius2 = wi.x() * wi.x() + wi.y() * wi.y();
    const double wi_x = wi.x() * given.along.x() + wi.y() * given.along.y();
    const double wi_y = wi.y() * given.along.x() - wi.x() * given.along.y();
    const FoldedAzimuth of_wi = FoldedAzimuth::of(wi_x, wi_y, std::sqrt(radius2));
    azimuth = of_wi.s;
    measure = of_wi.slope * wi.z();
  }
};

}  // namespace sklar::brdf
