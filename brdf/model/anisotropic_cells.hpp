#pragma once
/// The cells of an anisotropic table as a fit sees them.

#include <Eigen/Core>
#include <vector>

#include "brdf/data/anisotropic_table.hpp"
#include "brdf/model/anisotropic_loss.hpp"
#include "brdf/model/paper_brdf.hpp"

namespace sklar::brdf {

struct AnisotropicCells {
  std::vector<AnisotropicSlice> slices;  ///< one a theta_d bin
  double scale = 1;                      ///< what the values were multiplied by; 1 unless they are all tiny
  double total_weight = 0;               ///< of all cells and channels
};

/// Of each bin of theta_h and theta_d at most `samples` valid cells, spread over all of phi_h and phi_d, weighted with
/// their share of the valid ones; cells with an angle beyond 80 degrees count a tenth, those with a cosine below 0.02
/// not at all. @throws std::invalid_argument as fit_anisotropic.
[[nodiscard]] AnisotropicCells anisotropic_cells(const AnisotropicTable& table, const AnisotropicStructure& structure,
                                                 CellMeasure measure, int samples);

}  // namespace sklar::brdf
