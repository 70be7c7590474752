#pragma once
/// The coordinates of wi given wo that samplers work in, all algebraic in the components.
///
/// Of the half vector, with z = tan(theta_h) exp(i (phi_h - phi_o)), a complex number:
///     m = z / (cos(theta_o) + sin(theta_o) z).
/// wi is above the horizon exactly where |m| < 1, whatever theta_o: in the plane of z the horizon is the circle
/// |z - tan(theta_o)| = 1 / cos(theta_o), and m is the Moebius map of its inside to the unit disk that keeps 0, the
/// mirror direction, in place and lobes around it round. Back, with D = |1 - sin(theta_o) m|^2:
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

/// What the coordinates need of wo, above the horizon.
struct Outgoing {
  explicit Outgoing(const Vec3& wo) : sine(std::sqrt(wo.x() * wo.x() + wo.y() * wo.y())) {
    constexpr double kLeast = 1e-8;     // the cosine below which nothing changes any more, so that all stays finite
    constexpr double kNormal = 1e-100;  // below, the plane of incidence has no meaning left, and none is needed
    cosine = std::max(wo.z(), kLeast);
    if (sine > kNormal) along = Vec2(wo.x(), wo.y()) * (1 / sine);
  }

  double sine, cosine;      ///< of theta_o
  Vec2 along = Vec2(1, 0);  ///< unit, wo's direction in the plane of the surface
};

struct WiCoordinates {
  double disk2;         ///< |m|^2, in [0,1]
  double disk_azimuth;  ///< FoldedAzimuth of the argument of m
  double disk_measure;  ///< d|m|^2 ddisk_azimuth / dwi, half of it for each side of the plane of incidence
  double radius2;       ///< sin^2(theta_i)
  double azimuth;       ///< FoldedAzimuth of phi_i - phi_o
  double measure;       ///< dradius2 dazimuth / dwi, half of it for each side

  /// @param wo, wi unit, above the horizon. @param given of wo.
  WiCoordinates(const Outgoing& given, const Vec3& wo, const Vec3& wi) {
    const double sum_x = wi.x() + wo.x(), sum_y = wi.y() + wo.y(), sum_z = wi.z() + wo.z();
    const double x = sum_x * given.along.x() + sum_y * given.along.y();
    const double y = sum_y * given.along.x() - sum_x * given.along.y();
    const double across2 = x * x + y * y;
    // m = (x + i y) / (a + i b)
    const double a = given.cosine * sum_z + given.sine * x, b = given.sine * y;
    const double below2 = a * a + b * b, up = given.cosine * sum_z;
    const FoldedAzimuth of_m = FoldedAzimuth::of(up * x + given.sine * across2, up * y, std::sqrt(across2 * below2));
    disk2 = std::min(across2 / below2, 1.0);
    disk_azimuth = of_m.s;
    disk_measure = of_m.slope * (given.cosine * up) * (across2 + sum_z * sum_z) / (2 * below2 * below2);

    radius2 = wi.x() * wi.x() + wi.y() * wi.y();
    const double wi_x = wi.x() * given.along.x() + wi.y() * given.along.y();
    const double wi_y = wi.y() * given.along.x() - wi.x() * given.along.y();
    const FoldedAzimuth of_wi = FoldedAzimuth::of(wi_x, wi_y, std::sqrt(radius2));
    azimuth = of_wi.s;
    measure = of_wi.slope * wi.z();
  }
};

/// |m|^2 as the coordinate in [0,1] in which margins are tabulated: about |m|^2 up to core^2, about log |m| from there,
/// so that lobes of any width above core^2 have knots. With core a, spread v, g^4 = a^4 + (1 - a^4) |m|^2, y = g - a:
///     coordinate = (1 + v / (1 - a)) y / (v + y).
struct DiskWarp {
  double spread, core, core4, scale;
  double above_core;  ///< 1 / (1 - core4)

  /// @param spread in (0,1].
  explicit DiskWarp(double spread_)
      : spread(spread_),
        core(kCore * spread),
        core4((core * core) * (core * core)),
        scale(1 + spread / (1 - core)),
        above_core(1 / (1 - core4)) {}

  struct Place {
    double coordinate;
    double slope;  ///< dcoordinate / d|m|^2
  };
  [[nodiscard]] Place of(double disk2) const {
    const double g2 = std::sqrt(core4 + (1 - core4) * disk2), g = std::sqrt(g2), y = g - core;
    const double inverse = 1 / (spread + y);
    return {std::clamp(scale * y * inverse, 0.0, 1.0),
            scale * spread * (0.25 * (1 - core4)) * (inverse * inverse) / (g2 * g)};
  }

  /// |m|^2 at the coordinate part / whole.
  [[nodiscard]] double disk2(double part, double whole) const {
    const double y = part * spread / (scale * whole - part);
    const double g = core + y;  // g^4 - core^4 without cancellation
    return y * (core + g) * (core * core + g * g) * above_core;
  }

 private:
  static constexpr double kCore = 0.2;
};

}  // namespace sklar::brdf
