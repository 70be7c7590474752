#pragma once
/// The vector kernel that evaluates a refined model, in single precision, in the widest instruction set of the machine.

#include <cstddef>
#include <vector>

namespace sklar::brdf {

/// Coefficients as evaluation reads them: the components side by side, kMostComponents numbers each, those beyond the
/// model's with a density of e^-80.
struct RefinedTables {
  int half, difference, colour_half, colour_difference, azimuth, azimuth_difference;
  float width;
  std::vector<float> shape{};     ///< [difference][half][component]
  std::vector<float> red{};       ///< [colour_difference][colour_half][component]
  std::vector<float> blue{};      ///<
  std::vector<float> powers{};    ///< [azimuth_difference][azimuth][component]
  std::vector<float> coupling{};  ///< [difference][half][azimuth][component] on the CouplingLattice; empty without one
};

/// Rows of directions: coordinate k of row i at first[k * stride + i].
struct DirectionRows {
  const double* first;
  std::ptrdiff_t stride;
};

/// f_r of count pairs of unit directions above the horizon, red green blue of row i at out[i], out[stride + i] and
/// out[2 stride + i]. What a row gives does not depend on the others.
void evaluate_refined(const RefinedTables& tables, const DirectionRows& wo, const DirectionRows& wi,
                      std::ptrdiff_t count, double* out, std::ptrdiff_t stride);

}  // namespace sklar::brdf
