#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "brdf/model/anisotropic_problem.hpp"
#include "brdf/model/spline.hpp"

namespace sklar::brdf {
namespace {

using Matrix = Eigen::MatrixXd;

/// A cell with something measured.
struct Cell {
  double h_x, h_y, h_z, weight;
  std::array<double, 3> f;
};

/// action(cell) for those of a slice.
template <class Action>
void for_each_cell(const AnisotropicSlice& slice, const Action& action) {
  for (std::size_t n = 0; n < slice.weight.size(); ++n) {
    if (slice.weight[n] == 0) continue;
    const float* h = slice.points.values.data() +
                     n / kPointBlock * static_cast<std::size_t>(slice.points.numbers * kPointBlock) + n % kPointBlock;
    Cell cell{.h_x = static_cast<double>(h[0]),
              .h_y = static_cast<double>(h[kPointBlock]),
              .h_z = static_cast<double>(h[std::size_t{2} * kPointBlock]),
              .weight = static_cast<double>(slice.weight[n]),
              .f = {}};
    for (std::size_t c = 0; c < 3; ++c) cell.f[c] = static_cast<double>(slice.measured[c][n]);
    action(cell);
  }
}

/// Where the slopes of the half vectors are that reflect most: centre and scatter of Cauchy's distribution (Kent and
/// Tyler 1991), each cell weighted with f^2 and its solid angle of half vectors.
struct Ellipse {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Identity() * 0.1;
};

Ellipse brightest(const AnisotropicCells& cells, bool tilted) {
  constexpr int kSteps = 60;
  constexpr double kLeast = 1e-6;
  Ellipse ellipse;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Matrix2d inverse = ellipse.scatter.inverse();
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    double total = 0, shares = 0;
    for (const AnisotropicSlice& slice : cells.slices) {
      for_each_cell(slice, [&](const Cell& cell) {
        const Eigen::Vector2d slope(cell.h_x / cell.h_z, cell.h_y / cell.h_z);
        const double sine = std::hypot(cell.h_x, cell.h_y);
        const double f = cell.f[0] + cell.f[1] + cell.f[2];
        const double weight = cell.weight * f * f * sine * std::sqrt(sine);  // bins of theta_h are even in its root
        const Eigen::Vector2d away = slope - ellipse.centre;
        const double share = weight * 3 / (1 + away.dot(inverse * away));
        total += weight;
        shares += share;
        centre += share * slope;
        scatter += share * away * away.transpose();
      });
    }
    if (!(total > 0)) return {};
    ellipse.scatter = scatter / total + kLeast * Eigen::Matrix2d::Identity();
    if (tilted) ellipse.centre = centre / shares;
  }
  return ellipse;
}

/// The coefficients of the metric that is the inverse of the scatter: its logarithm.
std::array<double, 5> metric_of(const Ellipse& ellipse) {
  const double trace = ellipse.scatter.trace() / 2, determinant = ellipse.scatter.determinant();
  const double radius = std::sqrt(std::max(trace * trace - determinant, 0.0));
  const double over = radius > 0 ? -std::log((trace + radius) / (trace - radius)) / (2 * radius) : 0;
  return {-std::log(determinant) / 2, over * (ellipse.scatter(0, 0) - ellipse.scatter(1, 1)) / 2,
          over * ellipse.scatter(0, 1), ellipse.centre.x(), ellipse.centre.y()};
}

/// The tensor spline along half of a metric and difference that is nearest to the log of green, times the share of a
/// component, with a small weight on the differences of neighbouring coefficients.
Matrix nearest_shape(const AnisotropicStructure& structure, const AnisotropicCells& cells, const Matrix& difference,
                     const Metric& metric, const std::function<double(double)>& log_share) {
  constexpr double kLowest = 1e-4, kSmoothing = 1;
  const int half = structure.half, size = half * structure.difference;
  Matrix normal = Matrix::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  for (std::size_t j = 0; j < cells.slices.size(); ++j) {
    Matrix across = Matrix::Zero(half, half);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(half);
    for_each_cell(cells.slices[j], [&](const Cell& cell) {
      const SplineWeights weights = spline_weights(metric.half(cell.h_x, cell.h_y, cell.h_z), half);
      const double value = std::log(std::max(cell.f[1], kLowest)) + log_share(std::hypot(cell.h_x, cell.h_y));
      const Eigen::Map<const Eigen::Vector4d> w(weights.weight.data());
      across.block<4, 4>(weights.first, weights.first) += cell.weight * w * w.transpose();
      values.segment<4>(weights.first) += cell.weight * value * w;
    });
    const Eigen::VectorXd along = difference.row(static_cast<Eigen::Index>(j)).transpose();
    for (Eigen::Index a = 0; a < structure.difference; ++a) {
      if (along(a) == 0) continue;
      right.segment(a * half, half) += along(a) * values;
      for (Eigen::Index b = 0; b < structure.difference; ++b) {
        normal.block(a * half, b * half, half, half) += along(a) * along(b) * across;
      }
    }
  }
  const auto join = [&](int a, int b) {
    normal(a, a) += kSmoothing;
    normal(b, b) += kSmoothing;
    normal(a, b) -= kSmoothing;
    normal(b, a) -= kSmoothing;
  };
  for (int n = 0; n < size; ++n) {
    if (n % half != 0) join(n - 1, n);
    if (n >= half) join(n - half, n);
  }
  normal.diagonal().array() += 1e-6;
  const Eigen::VectorXd solution = normal.ldlt().solve(right);
  return Eigen::Map<const Matrix>(solution.data(), half, structure.difference);
}

/// Logs of red / green and blue / green over all cells.
std::array<double, 2> mean_colours(const AnisotropicCells& cells) {
  constexpr double kLeast = 1e-6;
  std::array<double, 3> sums = {kLeast, kLeast, kLeast};
  for (const AnisotropicSlice& slice : cells.slices) {
    for_each_cell(slice, [&](const Cell& cell) {
      for (std::size_t c = 0; c < 3; ++c) sums[c] += cell.weight * cell.f[c];
    });
  }
  return {std::log(sums[0] / sums[1]), std::log(sums[2] / sums[1])};
}

}  // namespace

std::vector<double> anisotropic_start(const AnisotropicStructure& structure, const AnisotropicCells& cells,
                                      const Matrix& difference) {
  constexpr double kTilt = 3;   // of the log shares of the first and the last component over sqrt(theta_h)
  constexpr double kBroad = 1;  // scale of the last component
  const AnisotropicLayout layout(structure);
  const std::array<double, 5> brightest_metric = metric_of(brightest(cells, structure.tilted));
  const std::array<double, 2> colours = mean_colours(cells);
  std::vector<double> x(static_cast<std::size_t>(layout.size()));
  const int components = structure.components;
  for (int k = 0; k < components; ++k) {
    const double broad = components > 1 ? static_cast<double>(k) / (components - 1) : 0.0;
    const auto metric = x.begin() + layout.first(k, AnisotropicPart::metric);
    for (int i = 0; i < layout.count(AnisotropicPart::metric); ++i) {
      const double sharp = brightest_metric[static_cast<std::size_t>(i)];
      metric[i] = sharp + broad * ((i == 0 ? kBroad : 0.0) - sharp);
    }
    const auto log_share = [&](double sine) {
      const double position = std::sqrt(sine) - 0.5;
      const auto tilt = [&](int r) { return components > 1 ? (2.0 * r / (components - 1) - 1) * kTilt : 0.0; };
      double sum = 0;
      for (int r = 0; r < components; ++r) sum += std::exp(tilt(r) * position);
      return tilt(k) * position - std::log(sum);
    };
    const Matrix shape =
        nearest_shape(structure, cells, difference, Metric::from(&*metric, structure.tilted), log_share);
    std::copy(shape.data(), shape.data() + shape.size(), x.begin() + layout.first(k, AnisotropicPart::shape));
    // Bernstein polynomials sum to 1.
    std::fill_n(x.begin() + layout.first(k, AnisotropicPart::red), layout.count(AnisotropicPart::red), colours[0]);
    std::fill_n(x.begin() + layout.first(k, AnisotropicPart::blue), layout.count(AnisotropicPart::blue), colours[1]);
  }
  return x;
}

}  // namespace sklar::brdf
