#pragma once
/// The cells of a measured table as the fits of analytic models see them, and the error of a model over them.

#include <array>

#include "brdf/data/measured_table.hpp"

namespace sklar::brdf {

/// One cell of each block of neighbours, with the weight of all of them: every bin of theta_h, where a highlight is,
/// 6 degrees of theta_d, 18 of phi_d folded at 90. Cells count once; those with an angle beyond 80 degrees a tenth,
/// those with a cosine below 0.02 not at all.
struct FitCells {
  Directions wo, wi;                       ///< n x 3
  std::array<Eigen::ArrayXd, 3> measured;  ///< a channel: n, 1/sr times scale, the mean of both halves of phi_d
  Eigen::ArrayXd weight;                   ///< n, their sum is 1
  double scale = 1;          ///< what values are multiplied by: 1 unless they are all tiny, which no measure would see
  double mean_square = 0;    ///< of measured times a cosine; 0 for a black table
  std::size_t in_table = 0;  ///< cells that the n stand for, both halves of phi_d counted

  [[nodiscard]] Eigen::Index size() const { return weight.size(); }
};

/// The same cells for the same table on any number of threads. @throws std::invalid_argument if the table fails
/// require_table or has no valid cell whose cosines are at least 0.02.
[[nodiscard]] FitCells fit_cells(const MeasuredTable& table);

/// Weighted means over cells of 4 log1p + log_relative + 2 image, per channel, with f measured, g the model, c the
/// cosine of either direction, the mean taken over both, w = max(cos_i cos_o, 1e-3) and |x| = sqrt(x^2 + e^2) - e:
///
///     log1p = |ln((1 + g c) / (1 + f c))|                         e = softness
///     log_relative = |ln((g w + 1e-3) / (f w + 1e-3))|            e = 4 softness
///     image = ((g - f) c)^2 / the mean of (f c)^2 over cells and channels, 1 where that is 0
///
/// as the balanced objective of the refined model has them.
class BalancedError {
 public:
  explicit BalancedError(FitCells cells);

  /// @param softness positive. @return per channel; their mean is the objective.
  [[nodiscard]] Rgb operator()(const Brdf& model, double softness) const;

  [[nodiscard]] const FitCells& cells() const { return cells_; }

 private:
  FitCells cells_;
  Eigen::ArrayXd cos_i_, cos_o_, both_;                  ///< times the scale of the table; both_ is w
  Eigen::ArrayXd square_;                                ///< mean square of both cosines over the mean of (f c)^2
  std::array<Eigen::ArrayXd, 3> log_i_, log_o_, log_w_;  ///< the denominators
};

}  // namespace sklar::brdf
