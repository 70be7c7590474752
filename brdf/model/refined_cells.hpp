#pragma once
/// The cells of a measured table as the fit of a refined model sees them.

#include <vector>

#include "brdf/data/measured_table.hpp"
#include "brdf/model/cell_importance.hpp"
#include "brdf/model/paper_brdf.hpp"
#include "brdf/model/refined_loss.hpp"
#include "brdf/model/refined_structure.hpp"

namespace sklar::brdf {

/// Every bin of theta_h and theta_d at kLossColumns of its 90 folded azimuths, staggered from bin to bin.
struct RefinedCells {
  std::vector<LossSlice> slices;  ///< one a theta_d bin
  Eigen::ArrayXd half;            ///< of coordinates, of the theta_h bins
  Eigen::ArrayXd difference;      ///< and of the theta_d bins
  double scale = 1;               ///< what the values were multiplied by; 1 unless they are all tiny
  double total_weight = 0;        ///< of all cells and channels
};

/// Both halves of phi_d are averaged; cells beyond the ranges of the structure have no weight.
/// @param importance factors of the weights, as RefinedFitOptions has them.
/// @throws std::invalid_argument as fit_refined.
[[nodiscard]] RefinedCells refined_cells(const MeasuredTable& table, CellMeasure measure,
                                         const RefinedStructure& structure, const CellImportance* importance = nullptr);

}  // namespace sklar::brdf
