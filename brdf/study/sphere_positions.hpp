#pragma once
/// The vector kernel of sphere_pixels, in the widest instruction set of the machine.

#include <cstddef>

namespace sklar::brdf {

/// Where unit vectors given by their coordinates sin(theta_h) cos(phi_d), sin(theta_h) sin(phi_d), cos(theta_h) > 0
/// stand on the axes of Grid: in cells, 0 at the first centre. Vectors with theta_h not below 90 degrees get numbers
/// without meaning. Absolute errors below 1e-12, in phi_d 1e-12 / sin(theta_h).
/// @param x, y, z count values, a multiple of 8. @param phi_d of the reciprocal pair of [0,pi).
void sphere_positions(const double* x, const double* y, const double* z, std::size_t count, double* theta_h,
                      double* phi_d);

}  // namespace sklar::brdf
