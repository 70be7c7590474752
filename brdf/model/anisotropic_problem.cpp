#include "brdf/model/anisotropic_problem.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "brdf/model/anisotropic_model.hpp"
#include "brdf/model/spline.hpp"

namespace sklar::brdf {
namespace {

using Matrix = Eigen::MatrixXd;

constexpr double kRidge = 0.01;  // of the sum of squares, beside the sum over cells

constexpr double kFence = 30;

/// Beyond this distance from the start the square of what is more counts kFence: parts that could cancel each other do
/// not grow without bound, and models stay far from where their values are not finite.
double room_of(AnisotropicPart part) {
  constexpr double kShape = 8, kOther = 4;
  return part == AnisotropicPart::shape ? kShape : kOther;
}

Eigen::ArrayXd differences(const AnisotropicCells& cells) {
  Eigen::ArrayXd result(static_cast<Eigen::Index>(cells.slices.size()));
  for (std::size_t j = 0; j < cells.slices.size(); ++j) {
    result(static_cast<Eigen::Index>(j)) = cells.slices[j].difference;
  }
  return result;
}

/// Of f c over cells and channels, c the root mean square of both cosines.
double mean_square(const AnisotropicCells& cells) {
  double sum = 0;
  for (const AnisotropicSlice& slice : cells.slices) {
    for (const std::vector<float>& plane : slice.measured) {
      for (std::size_t n = 0; n < plane.size(); ++n) {
        const float cosines = slice.cos_i[n] * slice.cos_i[n] + slice.cos_o[n] * slice.cos_o[n];
        sum += static_cast<double>(slice.weight[n] * plane[n] * plane[n] * cosines / 2);
      }
    }
  }
  return sum / cells.total_weight;
}

}  // namespace

AnisotropicProblem::AnisotropicProblem(const AnisotropicStructure& structure, AnisotropicCells cells)
    : structure_(structure),
      cells_(std::move(cells)),
      layout_(structure),
      difference_(spline_basis(differences(cells_), structure.difference)),
      start_(anisotropic_start(structure, cells_, difference_)) {
  const double square = mean_square(cells_);
  if (square > 0) image_scale_ = 1 / square;
}

LossWeights AnisotropicProblem::scaled(LossWeights weights) const {
  weights.image *= static_cast<float>(image_scale_);
  return weights;
}

AnisotropicTables AnisotropicProblem::slice_model(const AnisotropicTables& whole, std::size_t slice) const {
  AnisotropicTables model = whole;
  const std::ptrdiff_t half = structure_.half, size = half * structure_.difference;
  model.shape.resize(static_cast<std::size_t>(structure_.components * half));
  const Eigen::VectorXf along = difference_.row(static_cast<Eigen::Index>(slice)).transpose().cast<float>();
  for (int k = 0; k < structure_.components; ++k) {
    const Eigen::Map<const Eigen::MatrixXf> shape(whole.shape.data() + k * size, half, structure_.difference);
    Eigen::Map<Eigen::VectorXf>(model.shape.data() + k * half, half) = shape * along;
  }
  return model;
}

double AnisotropicProblem::evaluate(const LossWeights& weights, const std::vector<double>& x,
                                    std::vector<double>& gradient) const {
  const AnisotropicTables whole = anisotropic_tables(structure_, x);
  std::vector<AnisotropicSums> slopes(cells_.slices.size());
  std::vector<double> losses(slopes.size());
  tbb::parallel_for(std::size_t{0}, slopes.size(), [&](std::size_t j) {
    losses[j] = anisotropic_loss(scaled(weights), cells_.slices[j], slice_model(whole, j), slopes[j]);
  });
  gradient = collect(slopes, x, false);
  double loss = 0;
  for (const double part : losses) loss += part;
  for (int k = 0; k < structure_.components; ++k) {
    for (const AnisotropicPart part : kAnisotropicParts) {
      for (int n = 0; n < layout_.count(part); ++n) {
        const auto i = static_cast<std::size_t>(layout_.first(k, part) + n);
        const double away = x[i] - start_[i], room = room_of(part), beyond = away - std::clamp(away, -room, room);
        loss += kRidge * away * away + kFence * beyond * beyond;
        gradient[i] = (gradient[i] + 2 * (kRidge * away + kFence * beyond)) / cells_.total_weight;
      }
    }
  }
  return loss / cells_.total_weight;
}

std::vector<double> AnisotropicProblem::collect(const std::vector<AnisotropicSums>& sums, const std::vector<double>& x,
                                                bool squares) const {
  std::vector<double> result(x.size());
  for (int k = 0; k < structure_.components; ++k) {
    const auto add = [&](AnisotropicPart part, const std::vector<float>& from) {
      const int count = layout_.count(part), to = layout_.first(k, part);
      for (int i = 0; i < count; ++i) {
        result[static_cast<std::size_t>(to + i)] += static_cast<double>(from[static_cast<std::size_t>(k * count + i)]);
      }
    };
    std::array<double, 5> metric{};
    Matrix shape = Matrix::Zero(structure_.half, structure_.difference);
    for (std::size_t j = 0; j < sums.size(); ++j) {
      add(AnisotropicPart::terms, sums[j].terms);
      add(AnisotropicPart::red, sums[j].red);
      add(AnisotropicPart::blue, sums[j].blue);
      for (std::size_t i = 0; i < metric.size(); ++i) {
        metric[i] += static_cast<double>(sums[j].metric[static_cast<std::size_t>(5 * k) + i]);
      }
      const Eigen::Map<const Eigen::VectorXf> across(sums[j].shape.data() + std::ptrdiff_t{k} * structure_.half,
                                                     structure_.half);
      Eigen::RowVectorXd along = difference_.row(static_cast<Eigen::Index>(j));
      if (squares) along = along.cwiseAbs2();
      shape += across.cast<double>() * along;
    }
    std::copy(shape.data(), shape.data() + shape.size(), result.begin() + layout_.first(k, AnisotropicPart::shape));
    const int first = layout_.first(k, AnisotropicPart::metric), count = layout_.count(AnisotropicPart::metric);
    std::array<double, 5> pulled{};
    if (!squares) {
      Metric::pull_back(x.data() + first, structure_.tilted, metric, pulled.data());
    } else {
      for (std::size_t i = 0; i < metric.size(); ++i) {
        std::array<double, 5> one{}, column{};
        one[i] = 1;
        Metric::pull_back(x.data() + first, structure_.tilted, one, column.data());
        for (std::size_t n = 0; n < column.size(); ++n) pulled[n] += column[n] * column[n] * metric[i];
      }
    }
    std::copy_n(pulled.begin(), count, result.begin() + first);
  }
  return result;
}

std::vector<double> AnisotropicProblem::curvature(const LossWeights& weights, const std::vector<double>& x) const {
  constexpr double kLeast = 0.01;  // of the mean
  const AnisotropicTables whole = anisotropic_tables(structure_, x);
  std::vector<AnisotropicSums> sums(cells_.slices.size());
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t j) {
    sums[j] = anisotropic_curvature(scaled(weights), cells_.slices[j], slice_model(whole, j));
  });
  std::vector<double> result = collect(sums, x, true);
  double mean = 0;
  for (const double value : result) mean += value / static_cast<double>(result.size());
  for (double& value : result) value = std::sqrt((value + kLeast * mean + 2 * kRidge) / cells_.total_weight);
  return result;
}

}  // namespace sklar::brdf
