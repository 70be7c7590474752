#pragma once
/// The vector kernels of the anisotropic model, in single precision, in the widest instruction set of the machine.

#include <cstddef>
#include <vector>

#include "brdf/model/anisotropic_structure.hpp"
#include "brdf/model/direction_rows.hpp"

namespace sklar::brdf {

/// Coefficients as evaluation reads them: [component] of each part, shape in the order [difference][half].
struct AnisotropicTables {
  AnisotropicStructure structure;
  int shared = 0, colours = 0;  ///< shared_terms, colour_terms
  std::vector<float> shape{}, terms{}, red{}, blue{};
  std::vector<float> metric{};  ///< [component][5], the fields of Metric
};

/// f_r of count pairs of unit directions above the horizon, red green blue of row i at out[i], out[stride + i] and
/// out[2 stride + i]. What a row gives does not depend on the others, nor on which direction is called wo.
void evaluate_anisotropic(const AnisotropicTables& tables, const DirectionRows& wo, const DirectionRows& wi,
                          std::ptrdiff_t count, double* out, std::ptrdiff_t stride);

inline constexpr int kPointBlock = 16;  ///< pairs side by side in AnisotropicPoints

/// What the model sees of pairs of directions: h_x, h_y, h_z, the shared terms and those of the colours, [block of
/// kPointBlock pairs][number][pair]. The last block is filled up with the last pair.
struct AnisotropicPoints {
  int numbers = 0;  ///< a pair
  std::vector<float> values{};
};
/// @param count of the pairs, the first of the rows.
[[nodiscard]] AnisotropicPoints anisotropic_points(const AnisotropicStructure& structure, const DirectionRows& wo,
                                                   const DirectionRows& wi, std::ptrdiff_t count);

}  // namespace sklar::brdf
