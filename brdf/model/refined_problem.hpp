#pragma once
/// The objective of a refined fit as a function of all coefficients.

#include <optional>
#include <vector>

#include "brdf/model/coupling.hpp"
#include "brdf/model/refined_cells.hpp"
#include "brdf/model/refined_structure.hpp"

namespace sklar::brdf {

/// RefinedProblem::start.
[[nodiscard]] std::vector<double> refined_start(const RefinedStructure& structure, const RefinedLayout& layout,
                                                const RefinedCells& cells);

class RefinedProblem {
 public:
  /// @param families one a component.
  RefinedProblem(const RefinedStructure& structure, const std::vector<FamilyInfo>& families, RefinedCells cells);

  [[nodiscard]] const RefinedLayout& layout() const { return layout_; }

  /// Coefficients that follow the mean over azimuth, split over the components by theta_h.
  [[nodiscard]] const std::vector<double>& start() const { return start_; }

  /// Mean over cells and channels, with a small weight on the squares of the distances from the start, which
  /// determine the coefficients that no cell sees. Sets the gradient.
  [[nodiscard]] double evaluate(const LossWeights& weights, const std::vector<double>& x,
                                std::vector<double>& gradient) const;

  /// Square roots of the second derivatives by each coefficient, as Gauss and Newton have them; never 0.
  [[nodiscard]] std::vector<double> curvature(const LossWeights& weights, const std::vector<double>& x) const;

 private:
  [[nodiscard]] LossWeights scaled(LossWeights weights) const;
  struct Grids;  // the log densities of a component on the grid of the table
  [[nodiscard]] Grids grids(const std::vector<double>& x) const;
  [[nodiscard]] LossModel slice_model(const Grids& grids, int j) const;
  /// Adds the slopes of the ridge and divides all by the weight of the cells. @return the ridge.
  double add_ridge(const std::vector<double>& x, std::vector<double>& gradient) const;
  void add_coupling(const std::vector<double>& x, const Grids& slopes, std::vector<double>& gradient) const;

  /// A colour over green, at the nodes of the lattice and on the grid of the table.
  struct ColourRatio {
    Eigen::MatrixXd nodes, grid;
  };
  [[nodiscard]] ColourRatio colour_ratio(const std::vector<double>& x, int component, RefinedPart colour) const;
  void add_colour(const std::vector<double>& x, int component, RefinedPart colour, const Eigen::MatrixXd& slopes,
                  std::vector<double>& gradient) const;

  RefinedStructure structure_;
  RefinedCells cells_;
  RefinedLayout layout_;
  std::vector<std::optional<Coupling>> couplings_;
  LatticeBases lattice_;
  std::vector<double> start_;
  double image_scale_ = 1;  // 1 / mean of (f c)^2
  Eigen::MatrixXd half_, difference_, colour_half_, colour_difference_, azimuth_difference_, bernstein_;
  Eigen::MatrixXd half_shares_, difference_shares_;  // of the nodes of the lattice
};

}  // namespace sklar::brdf
