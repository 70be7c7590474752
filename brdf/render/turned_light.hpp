#pragma once
/// The vector kernel of render_sphere, in the widest instruction set of the machine; the same bits in each.

#include <array>
#include <cstddef>

namespace sklar::brdf {

/// ring[a] += share[0] upper[a] + share[1] upper[a+1] + share[2] lower[a] + share[3] lower[a+1] for a < count, in
/// single precision.
/// @param upper, lower count + 1 values. @param count a multiple of 16.
void add_turned_light(const float* upper, const float* lower, const std::array<double, 4>& share, std::size_t count,
                      float* ring);

}  // namespace sklar::brdf
