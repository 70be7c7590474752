#pragma once
/// What tests of analytic reflectance models against their formulas as printed share.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/geometry/frame.hpp"
#include "tests/support/sampler_check.hpp"

namespace sklar::test {

constexpr double kVisible = 1e-100;   ///< below it a lobe's rounding error, which grows with its exponent, is let go
constexpr double kQuadrature = 1e-5;  ///< error of an albedo
constexpr double kEps = 1e-15;        ///< a few roundings

/// Grazing, opposite each other, with cosines at which values end at the largest.
inline const brdf::Vec3 kGrazing(1, 0, 1e-210), kOpposite(-1, 0, 1e-210);

/// @param theta, phi degrees.
inline brdf::Vec3 degrees(double theta, double phi = 30) {
  return brdf::spherical_direction(theta * std::numbers::pi / 180, phi * std::numbers::pi / 180);
}

inline brdf::Vec3 random_direction(Rng& rng) {
  const double theta = std::acos(uniform(rng));
  return brdf::spherical_direction(theta, 2 * std::numbers::pi * uniform(rng));
}

/// Angles of a pair of directions, as the sources have them.
struct Angles {
  double theta_i, theta_o, phi_i, phi_o;
  double theta_h, phi_h;
  double theta_d;  ///< between the half vector and either direction
  double alpha;    ///< between wi and the mirror direction of wo

  Angles(const brdf::Vec3& wo, const brdf::Vec3& wi) {
    const brdf::Vec3 h = (wi + wo).normalized();
    theta_i = std::acos(wi.z());
    theta_o = std::acos(wo.z());
    phi_i = std::atan2(wi.y(), wi.x());
    phi_o = std::atan2(wo.y(), wo.x());
    theta_h = std::acos(std::min(h.z(), 1.0));
    phi_h = std::atan2(h.y(), h.x());
    theta_d = std::acos(std::min(h.dot(wi), 1.0));
    alpha = std::acos(std::clamp(wi.dot(2 * wo.z() * brdf::Vec3::UnitZ() - wo), -1.0, 1.0));
  }
};

/// Calls check(wo, wi) for random pairs.
template <typename Check>
void for_pairs(const Check& check) {
  Rng rng(seed_of_this_test());
  for (int n = 0; n < 3000; ++n) {
    const brdf::Vec3 wo = random_direction(rng);
    check(wo, random_direction(rng));
  }
}

/// Integral of f over the hemisphere, by solid angle.
template <typename Function>
double hemisphere(const Function& f) {
  double sum = 0;
  constexpr int kCells = 16;
  for (int cell = 0; cell < kCells * kCells; ++cell) {
    const int row = cell / kCells;
    const int column = cell % kCells;
    const double theta = std::numbers::pi / 2 / kCells * row;
    const double phi = 2 * std::numbers::pi / kCells * column;
    sum += integrate([&](double t, double p) { return f(brdf::spherical_direction(t, p)) * std::sin(t); }, theta,
                     theta + std::numbers::pi / 2 / kCells, phi, phi + 2 * std::numbers::pi / kCells,
                     1e-6 / kCells / kCells);
  }
  return sum;
}

/// Directional albedo of the first channel.
inline double albedo(const brdf::Brdf& model, const brdf::Vec3& wo) {
  return hemisphere([&](const brdf::Vec3& wi) { return model.eval(wo, wi)[0] * wi.z(); });
}

/// The integral of pdf: the share of draws above the horizon.
inline double share_above(const brdf::Brdf& model, const brdf::Vec3& wo) {
  return hemisphere([&](const brdf::Vec3& wi) { return model.pdf(wo, wi); });
}

}  // namespace sklar::test
