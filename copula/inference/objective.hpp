#pragma once
/// What a fit minimises: sums over rows, in chunks, so that memory does not grow with the number of rows and the result
/// does not depend on the number of threads.

#include <limits>

#include "copula/copula.hpp"
#include "copula/inference/cells.hpp"
#include "copula/inference/joint.hpp"

namespace sklar {

/// In what pieces rows are evaluated.
struct Chunking {
  Index rows = 8192;     ///< rows a call of the copula: one column of them is 64 KiB
  bool parallel = true;  ///< chunks on the threads of oneTBB, added up in the order of the rows
};

/// A sum over the rows that have a finite term, and what the others would have counted for.
struct RowSum {
  double value = 0;
  Index nonfinite = 0;          ///< rows of positive weight without a finite term
  double nonfinite_weight = 0;  ///< their weight

  RowSum& operator+=(const RowSum& other);

  /// The value, or -inf where rows are left out of it.
  [[nodiscard]] double or_nothing() const noexcept {
    return nonfinite == 0 ? value : -std::numeric_limits<double>::infinity();
  }
};

/// sum w_i log c(u_i), the copula part of the log likelihood (paper Eq. 16). Rows of weight 0 do not count.
/// @param u n x d. @param weights n, or none for one each.
[[nodiscard]] RowSum log_likelihood(const Copula& copula, const PointsRef& u, const ColumnRef& weights,
                                    const Chunking& chunking);

/// The same of margins and copula together, the sum of w_i log h(x_i). @param x n x d.
[[nodiscard]] RowSum log_likelihood(const JointDensity& joint, const PointsRef& x, const ColumnRef& weights,
                                    const Chunking& chunking);

/// sum w_i (b_i - c(u_i) g_i)^2 (paper Eq. 17), weights as in CellTable.
[[nodiscard]] RowSum squared_error(const Copula& copula, const CellTable& cells, const Chunking& chunking);

}  // namespace sklar
