#pragma once
/// Fitting the paper's model to a measured table.

#include "brdf/data/measured_table.hpp"
#include "brdf/model/paper_brdf.hpp"
#include "brdf/progress.hpp"
#include "copula/inference/fit.hpp"

namespace sklar::brdf {

/// How the paper's model is fitted.
struct PaperFitOptions {
  int slices = 6;                               ///< equal theta_d intervals; a divisor of 90
  FitMethod method = FitMethod::least_squares;  ///< Eq. 17; maximum_likelihood is Eq. 16
  CellMeasure measure = CellMeasure::per_cell;
};

struct PaperFit {
  std::shared_ptr<const PaperBrdf> brdf;
  std::array<std::vector<FitResult>, 3> fits;  ///< one a channel and slice; message "black" where nothing was fitted
};

/// Cells below the horizon count as mass 0, as in the paper. Each slice of each channel is normalised (Eqs. 9, 10),
/// gives its margins (Eq. 11) and its copula parameter; K makes the summed mass of the slice equal the table's.
/// @throws std::invalid_argument if slices does not divide 90 or the table fails require_table; std::runtime_error if a
/// slice cannot be fitted, saying which and why.
[[nodiscard]] PaperFit fit_paper(const MeasuredTable& table, const FamilyInfo& family,
                                 const PaperFitOptions& options = {}, const Progress& progress = {});

}  // namespace sklar::brdf
