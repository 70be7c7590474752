#pragma once
/// The vector kernel that evaluates a refined model, in single precision, in the widest instruction set of the machine.

#include <tbb/cache_aligned_allocator.h>

#include <cstddef>
#include <vector>

#include "brdf/model/refined_structure.hpp"

namespace sklar::brdf {

using AlignedFloats = std::vector<float, tbb::cache_aligned_allocator<float>>;

/// A model as evaluation reads it: the components side by side, kMostComponents numbers each, those beyond the model's
/// with a density of e^-80. Colours, powers and couplings stand at the nodes of the Lattice.
struct RefinedTables {
  int half, difference;  ///< spline coefficients of shape
  int powers_pairs;      ///< half the degree in azimuth, rounded up
  float width;
  AlignedFloats shape{};     ///< [difference][half][component]
  AlignedFloats colour{};    ///< [difference][half][red / green, blue / green][component], not logs
  AlignedFloats powers{};    ///< [difference][power 1, 2, .., an even number][component]
  AlignedFloats coupling{};  ///< [difference][half][azimuth][component] log c; empty without one
};

/// Rows of directions: coordinate k of row i at first[k * stride + i].
struct DirectionRows {
  const double* first;
  std::ptrdiff_t stride;
};

/// f_r of count pairs of unit directions, red green blue of row i at out[i], out[stride + i] and out[2 stride + i]; 0
/// where one of them is not above the horizon. What a row gives does not depend on the others.
void evaluate_refined(const RefinedTables& tables, const DirectionRows& wo, const DirectionRows& wi,
                      std::ptrdiff_t count, double* out, std::ptrdiff_t stride);

}  // namespace sklar::brdf
