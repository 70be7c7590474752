#pragma once
/// The objective of an anisotropic fit as a function of all coefficients.

#include <vector>

#include "brdf/model/anisotropic_cells.hpp"
#include "brdf/model/anisotropic_structure.hpp"

namespace sklar::brdf {

class AnisotropicProblem {
 public:
  AnisotropicProblem(const AnisotropicStructure& structure, AnisotropicCells cells);

  [[nodiscard]] const AnisotropicLayout& layout() const { return layout_; }

  /// Coefficients that follow the cells along each component's half coordinate: from the ellipse of the brightest lobe
  /// to a broad round one.
  [[nodiscard]] const std::vector<double>& start() const { return start_; }

  /// Mean over cells and channels, with a small weight on the squares of the distances from the start, which
  /// determine the coefficients that no cell sees. Sets the gradient.
  [[nodiscard]] double evaluate(const LossWeights& weights, const std::vector<double>& x,
                                std::vector<double>& gradient) const;

  /// Square roots of the second derivatives by each coefficient, as Gauss and Newton have them; never 0.
  [[nodiscard]] std::vector<double> curvature(const LossWeights& weights, const std::vector<double>& x) const;

 private:
  [[nodiscard]] LossWeights scaled(LossWeights weights) const;
  [[nodiscard]] AnisotropicTables slice_model(const AnisotropicTables& whole, std::size_t slice) const;
  [[nodiscard]] std::vector<double> collect(const std::vector<AnisotropicSums>& sums, const std::vector<double>& x,
                                            bool squares) const;

  AnisotropicStructure structure_;
  AnisotropicCells cells_;
  AnisotropicLayout layout_;
  Eigen::MatrixXd difference_;  ///< slices x coefficients
  double image_scale_ = 1;      ///< 1 / mean of (f c)^2
  std::vector<double> start_;
};

/// AnisotropicProblem::start. @param difference the spline along it at the slices.
[[nodiscard]] std::vector<double> anisotropic_start(const AnisotropicStructure& structure,
                                                    const AnisotropicCells& cells, const Eigen::MatrixXd& difference);

}  // namespace sklar::brdf
