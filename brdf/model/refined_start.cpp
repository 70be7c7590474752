#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "brdf/model/lattice.hpp"
#include "brdf/model/refined_problem.hpp"
#include "brdf/model/spline.hpp"

namespace sklar::brdf {
namespace {

using Matrix = Eigen::MatrixXd;

/// The tensor spline nearest to values on a grid, with a small weight on the differences of neighbouring coefficients:
/// beyond the grid it goes on as it is at its edge.
Matrix least_squares(const Matrix& across, const Matrix& along, const Matrix& values) {
  constexpr double kSmoothing = 1;
  const auto normal = [&](const Matrix& basis) {
    const Eigen::Index count = basis.cols();
    const Matrix steps =
        Matrix::Identity(count, count).bottomRows(count - 1) - Matrix::Identity(count, count).topRows(count - 1);
    return Matrix(basis.transpose() * basis + kSmoothing * steps.transpose() * steps);
  };
  const Matrix left = normal(across).ldlt().solve(across.transpose() * values * along);
  return normal(along).ldlt().solve(left.transpose()).transpose();
}

/// How many cells of a bin of theta_h and theta_d were measured.
Eigen::ArrayXXd measured_counts(const RefinedCells& cells) {
  Eigen::ArrayXXd counts = Eigen::ArrayXXd::Zero(Grid::theta_h, Grid::theta_d);
  for (int j = 0; j < Grid::theta_d; ++j) {
    const std::vector<float>& weight = cells.slices[static_cast<std::size_t>(j)].weight;
    for (int cell = 0; cell < Grid::theta_h * kLossColumns; ++cell) {
      if (weight[static_cast<std::size_t>(cell)] > 0) counts(cell / kLossColumns, j) += 1;
    }
  }
  return counts;
}

/// Bins without a measurement take the value of the last one before them along theta_h, or the first there is; slices
/// without any that of the nearest slice.
void fill_gaps(const Eigen::ArrayXXd& counts, Matrix& mean) {
  const auto has_any = [&](int j) { return j >= 0 && j < Grid::theta_d && (counts.col(j) > 0).any(); };
  for (int j = 0; j < Grid::theta_d; ++j) {
    int last = -1;
    for (int i = 0; i < Grid::theta_h && last < 0; ++i) last = counts(i, j) > 0 ? i : -1;
    for (int i = 0; i < Grid::theta_h && last >= 0; ++i) {
      if (counts(i, j) > 0) last = i;
      mean(i, j) = mean(last, j);
    }
  }
  for (int j = 0; j < Grid::theta_d; ++j) {
    for (int away = 0; away < Grid::theta_d; ++away) {
      const int from = has_any(j - away) ? j - away : j + away;
      if (!has_any(from)) continue;
      if (away > 0) mean.col(j) = mean.col(from);
      break;
    }
  }
}

/// Logs of the means over azimuth by channel.
std::array<Matrix, 3> log_means(const RefinedCells& cells) {
  constexpr double kLowest = 1e-4;
  const Eigen::ArrayXXd counts = measured_counts(cells);
  std::array<Matrix, 3> means;
  for (std::size_t c = 0; c < 3; ++c) {
    Eigen::ArrayXXd sums = Eigen::ArrayXXd::Zero(Grid::theta_h, Grid::theta_d);
    for (int j = 0; j < Grid::theta_d; ++j) {
      const LossSlice& slice = cells.slices[static_cast<std::size_t>(j)];
      for (int cell = 0; cell < Grid::theta_h * kLossColumns; ++cell) {
        const auto n = static_cast<std::size_t>(cell);
        if (slice.weight[n] > 0) sums(cell / kLossColumns, j) += static_cast<double>(slice.measured[c][n]);
      }
    }
    means[c] = (counts > 0).select((sums / counts.max(1.0)).max(kLowest).log(), 0.0);
    fill_gaps(counts, means[c]);
  }
  return means;
}

}  // namespace

std::vector<double> refined_start(const RefinedStructure& structure, const RefinedLayout& layout,
                                  const RefinedCells& cells) {
  constexpr double kTilt = 3;  // of the log shares of the first and the last component over theta_h
  const std::array<Matrix, 3> means = log_means(cells);
  const Matrix half = spline_basis(cells.half, structure.half);
  const Matrix difference = spline_basis(cells.difference, structure.difference);
  const Matrix colour_half = lattice_basis(cells.half, Lattice::half, structure.colour_half);
  const Matrix colour_difference = lattice_basis(cells.difference, Lattice::difference, structure.colour_difference);
  const Matrix red = least_squares(colour_half, colour_difference, means[0] - means[1]);
  const Matrix blue = least_squares(colour_half, colour_difference, means[2] - means[1]);
  std::vector<double> x(static_cast<std::size_t>(layout.size()));
  const int components = structure.components;
  for (int k = 0; k < components; ++k) {
    Matrix log_part = means[1];
    for (int i = 0; i < Grid::theta_h; ++i) {
      const double position = (i + 0.5) / Grid::theta_h - 0.5;
      const auto tilt = [&](int r) { return components > 1 ? (2.0 * r / (components - 1) - 1) * kTilt : 0.0; };
      double sum = 0;
      for (int r = 0; r < components; ++r) sum += std::exp(tilt(r) * position);
      log_part.row(i).array() += tilt(k) * position - std::log(sum);
    }
    const auto put = [&](RefinedPart part, const Matrix& values) {
      std::copy_n(values.data(), values.size(), x.begin() + layout.first(k, part));
    };
    put(RefinedPart::shape, least_squares(half, difference, log_part));
    put(RefinedPart::red, red);
    put(RefinedPart::blue, blue);
  }
  return x;
}

}  // namespace sklar::brdf
