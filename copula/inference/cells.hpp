#pragma once
/// A table of masses seen as a histogram: what least squares fits (paper Eqs. 9 to 12 and 17).

#include <span>
#include <vector>

#include "copula/types.hpp"

namespace sklar {

/// n cells. Equation numbers are the paper's.
struct CellTable {
  Points u;       ///< n x d in [0,1]: the margins' cdf at the centre of the cell, F_k (Eq. 17)
  Column mass;    ///< b, sum 1 (Eq. 9)
  Column margin;  ///< g, the product of the margins' masses f_k (Eqs. 11, 17)
  Column weight;  ///< weight of the cell in the sum of squares, >= 0; none for one each
};

/// The cells of a full d-dimensional table: masses normalised to sum 1, margins by summation, their cdf linear within a
/// bin, so that at its centre it is what lies below and half of the bin.
/// @param masses  one value a cell, >= 0, not all 0, of any scale; the last index runs fastest.
/// @param shape   bins along each of d >= 2 axes, each >= 1.
/// @throws std::invalid_argument (shape, all 0), std::domain_error naming the first mass at fault.
[[nodiscard]] CellTable cell_table(const ColumnRef& masses, std::span<const Index> shape);

/// The cells of points counted into bins^d equal cells of the unit cube.
/// @param u        n x d in [0,1], d >= 2. @param weights n, or none for one each.
/// @param bins     along each axis; at most kMostCells cells in all.
/// @throws std::invalid_argument (shapes, bins, all weights 0), std::domain_error (an entry of u or weights).
[[nodiscard]] CellTable count_cells(const PointsRef& u, const ColumnRef& weights, Index bins);

/// The most cells that count_cells makes.
inline constexpr Index kMostCells = Index{1} << 24;

/// At most `most` cells whose weighted sums estimate those of the whole table: half of them chosen evenly, half by
/// mass, so that a peak of few cells is seen. Always the same ones. A table that is small enough is returned whole.
/// @param most >= 1.
[[nodiscard]] CellTable sample_cells(const CellTable& cells, Index most);

/// The fractional parts of (i + 1/2) times the golden ratio, i < n: positions in [0,1) spread evenly without a period
/// that a grid could share.
[[nodiscard]] std::vector<double> spread_positions(Index n);

}  // namespace sklar
