#pragma once
/// The coordinates of wi given wo that samplers work in, all algebraic in the components.
///
/// Of the half vector: slope2 = tan^2(theta_h) and the azimuth phi_h - phi_o, folded at the plane of incidence, with
/// dwi = 4 (wo.h) dwh. wi is above the horizon exactly where slope2 < slope2_most:
///     tan(theta_h) < (R - B) / cos(theta_o),  B = -sin(theta_o) cos(phi_h - phi_o),  R = sqrt(cos^2(theta_o) + B^2).
/// Of wi itself: radius2 = sin^2(theta_i) and phi_i - phi_o, folded too; a uniform radius2 is the cosine hemisphere.

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
    return {x < 0 ? 1 - tangent / 2 : tangent / 2, (1 + tangent * tangent) / 4};
  }

  /// Unit vector at s.
  [[nodiscard]] static Vec2 direction(double s) {
    const bool behind = s > 0.5;
    const double tangent = 2 * (behind ? 1 - s : s);
    const double scale = 1 / (1 + tangent * tangent);
    const double x = (1 - tangent * tangent) * scale;
    return {behind ? -x : x, 2 * tangent * scale};
  }
};

/// What the coordinates need of wo, above the horizon.
struct Outgoing {
  explicit Outgoing(const Vec3& wo) : sine(std::sqrt(wo.x() * wo.x() + wo.y() * wo.y())), cosine(wo.z()) {
    constexpr double kNormal = 1e-100;  // below, the plane of incidence has no meaning left, and none is needed
    if (sine > kNormal) along = Vec2(wo.x(), wo.y()) * (1 / sine);
  }

  /// slope2 where wi meets the horizon. @param cos_phi of phi_h - phi_o.
  [[nodiscard]] double slope2_most(double cos_phi) const {
    constexpr double kLeast = 1e-12;  // the cosine below which nothing changes any more, so that all stays finite
    const double a = std::max(cosine, kLeast), b = -sine * cos_phi, r = std::sqrt(a * a + b * b);
    const double slope = b > 0 ? a / (r + b) : (r - b) / a;
    return slope * slope;
  }

  double sine, cosine;      ///< of theta_o
  Vec2 along = Vec2(1, 0);  ///< unit, wo's direction in the plane of the surface
};

struct WiCoordinates {
  double slope2;        ///< tan^2(theta_h)
  double slope2_most;   ///< see above
  double half_azimuth;  ///< FoldedAzimuth of phi_h - phi_o
  double half_measure;  ///< dslope2 dhalf_azimuth / dwi, half of it for each side of the plane of incidence
  double radius2;       ///< sin^2(theta_i)
  double azimuth;       ///< FoldedAzimuth of phi_i - phi_o
  double measure;       ///< dradius2 dazimuth / dwi, half of it for each side

  /// @param wo, wi unit, above the horizon. @param given of wo.
  WiCoordinates(const Outgoing& given, const Vec3& wo, const Vec3& wi) {
    const Vec3 sum = wi + wo;
    const double across2 = sum.x() * sum.x() + sum.y() * sum.y(), across = std::sqrt(across2);
    const double x = sum.x() * given.along.x() + sum.y() * given.along.y();
    const double y = sum.y() * given.along.x() - sum.x() * given.along.y();
    const FoldedAzimuth of_half = FoldedAzimuth::of(x, y, across);
    const double inverse = 1 / sum.z(), inverse2 = inverse * inverse;
    slope2 = across2 * inverse2;
    slope2_most = given.slope2_most(across > 0 ? x / across : 0.0);
    half_azimuth = of_half.s;
    half_measure = of_half.slope * (1 + slope2) * inverse / 2;

    radius2 = wi.x() * wi.x() + wi.y() * wi.y();
    const double wi_x = wi.x() * given.along.x() + wi.y() * given.along.y();
    const double wi_y = wi.y() * given.along.x() - wi.x() * given.along.y();
    const FoldedAzimuth of_wi = FoldedAzimuth::of(wi_x, wi_y, std::sqrt(radius2));
    azimuth = of_wi.s;
    measure = of_wi.slope * wi.z();
  }
};

}  // namespace sklar::brdf
