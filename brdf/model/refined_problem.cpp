#include "brdf/model/refined_problem.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "brdf/model/lattice.hpp"
#include "brdf/model/spline.hpp"

namespace sklar::brdf {
namespace {

using Matrix = Eigen::MatrixXd;
using MatrixIn = Eigen::Map<const Matrix>;
using MatrixOut = Eigen::Map<Matrix>;

constexpr double kRidge = 0.01, kColourRidge = 0.1;  // of the sums of squares, beside the sum over cells

/// log c at the cells of a slice from a plane of the lattice, or, transposed, slopes from there onto the plane.
template <class Action>
void for_each_cell(const RefinedCells& cells, const LossSlice& slice, const Action& action) {
  for (int i = 0; i < kLossRows; ++i) {
    const Between half = on_lattice(cells.half(i), Lattice::half);
    for (int l = 0; l < kLossColumns; ++l) {
      const auto cell = static_cast<std::size_t>(i * kLossColumns + l);
      if (slice.weight[cell] == 0) continue;
      const Between azimuth = on_lattice(static_cast<double>(slice.azimuth[cell]), Lattice::azimuth);
      const auto node = [&](int m, int n, double share) { action(cell, Lattice::index(m, n), share); };
      node(half.low, azimuth.low, (1 - half.share) * (1 - azimuth.share));
      node(half.low, azimuth.high, (1 - half.share) * azimuth.share);
      node(half.high, azimuth.low, half.share * (1 - azimuth.share));
      node(half.high, azimuth.high, half.share * azimuth.share);
    }
  }
}

/// Of f c over cells and channels, c the root mean square of both cosines.
double mean_square(const RefinedCells& cells) {
  double sum = 0;
  for (const LossSlice& slice : cells.slices) {
    for (const auto& plane : slice.measured) {
      for (std::size_t n = 0; n < plane.size(); ++n) {
        const float cosines = slice.cos_i[n] * slice.cos_i[n] + slice.cos_o[n] * slice.cos_o[n];
        sum += static_cast<double>(slice.weight[n] * plane[n] * plane[n] * cosines / 2);
      }
    }
  }
  return sum / cells.total_weight;
}

}  // namespace

struct RefinedProblem::Grids {
  std::vector<std::array<Matrix, 3>> values;  // [component][channel]
  std::vector<Matrix> powers;                 // [component], degree x theta_d
  std::vector<Matrix> planes;                 // [component], lattice plane x theta_d; empty where not coupled

  Grids(int components, int degree)
      : values(static_cast<std::size_t>(components)), powers(values.size()), planes(values.size()) {
    for (auto& channels : values) channels.fill(Matrix::Zero(Grid::theta_h, Grid::theta_d));
    for (Matrix& power : powers) power = Matrix::Zero(degree, Grid::theta_d);
  }
};

RefinedProblem::RefinedProblem(const RefinedStructure& structure, const std::vector<FamilyInfo>& families,
                               RefinedCells cells)
    : structure_(structure),
      cells_(std::move(cells)),
      layout_(structure, coupled(families)),
      lattice_(structure),
      start_(refined_start(structure, layout_, cells_)),
      half_(spline_basis(cells_.half, structure.half)),
      difference_(spline_basis(cells_.difference, structure.difference)),
      colour_half_(lattice_basis(cells_.half, Lattice::half, structure.colour_half)),
      colour_difference_(lattice_basis(cells_.difference, Lattice::difference, structure.colour_difference)),
      azimuth_difference_(lattice_basis(cells_.difference, Lattice::difference, structure.azimuth_difference)),
      bernstein_(bernstein_powers(structure.azimuth)),
      half_shares_(lattice_shares(cells_.half, Lattice::half)),
      difference_shares_(lattice_shares(cells_.difference, Lattice::difference)) {
  for (const FamilyInfo& family : families) {
    couplings_.push_back(family.parameters.empty() ? std::nullopt : std::optional(Coupling(family)));
  }
  const double square = mean_square(cells_);
  if (square > 0) image_scale_ = 1 / square;
}

LossWeights RefinedProblem::scaled(LossWeights weights) const {
  weights.image *= static_cast<float>(image_scale_);
  return weights;
}

namespace {

MatrixIn matrix(const std::vector<double>& x, const RefinedLayout& layout, int k, RefinedPart part, int rows) {
  return {x.data() + layout.first(k, part), rows, rows > 0 ? layout.count(k, part) / rows : 0};
}

MatrixOut matrix(std::vector<double>& x, const RefinedLayout& layout, int k, RefinedPart part, int rows) {
  return {x.data() + layout.first(k, part), rows, rows > 0 ? layout.count(k, part) / rows : 0};
}

std::vector<double> numbers(const std::vector<double>& x, const RefinedLayout& layout, int k, RefinedPart part) {
  const auto first = x.begin() + layout.first(k, part);
  return {first, first + layout.count(k, part)};
}

CouplingInput input_of(const RefinedStructure& structure, const std::vector<double>& x, const RefinedLayout& layout,
                       int k) {
  return coupling_input(structure, numbers(x, layout, k, RefinedPart::shape),
                        numbers(x, layout, k, RefinedPart::azimuth), numbers(x, layout, k, RefinedPart::coupling));
}

}  // namespace

RefinedProblem::ColourRatio RefinedProblem::colour_ratio(const std::vector<double>& x, int component,
                                                         RefinedPart colour) const {
  const Matrix nodes = (lattice_.colour_half * matrix(x, layout_, component, colour, structure_.colour_half) *
                        lattice_.colour_difference.transpose())
                           .array()
                           .exp();
  return {nodes, half_shares_ * nodes * difference_shares_.transpose()};
}

void RefinedProblem::add_colour(const std::vector<double>& x, int component, RefinedPart colour, const Matrix& slopes,
                                std::vector<double>& gradient) const {
  const ColourRatio ratio = colour_ratio(x, component, colour);
  const Matrix by_grid = slopes.array() / ratio.grid.array();
  const Matrix by_log_nodes = (half_shares_.transpose() * by_grid * difference_shares_).array() * ratio.nodes.array();
  matrix(gradient, layout_, component, colour, structure_.colour_half) +=
      lattice_.colour_half.transpose() * by_log_nodes * lattice_.colour_difference;
}

RefinedProblem::Grids RefinedProblem::grids(const std::vector<double>& x) const {
  Grids result(structure_.components, structure_.azimuth);
  tbb::parallel_for(0, structure_.components, [&](int k) {
    const auto at = static_cast<std::size_t>(k);
    const auto colour = [&](RefinedPart part) { return Matrix(colour_ratio(x, k, part).grid.array().log()); };
    const Matrix green = half_ * matrix(x, layout_, k, RefinedPart::shape, structure_.half) * difference_.transpose();
    result.values[at] = {green + colour(RefinedPart::red), green, green + colour(RefinedPart::blue)};
    result.powers[at] =
        bernstein_ * matrix(x, layout_, k, RefinedPart::azimuth, structure_.azimuth) * azimuth_difference_.transpose();
    if (!couplings_[at]) return;
    result.planes[at] = couplings_[at]->values(input_of(structure_, x, layout_, k)) * difference_shares_.transpose();
  });
  return result;
}

LossModel RefinedProblem::slice_model(const Grids& grids, int j) const {
  const auto components = static_cast<std::size_t>(structure_.components);
  const auto degree = static_cast<std::size_t>(structure_.azimuth);
  LossModel model{.components = structure_.components,
                  .degree = structure_.azimuth,
                  .log_value = std::vector<float>(3 * components * kLossRows),
                  .powers = std::vector<float>(components * degree),
                  .coupling = {}};
  constexpr std::size_t kCells = static_cast<std::size_t>(kLossRows) * kLossColumns;
  for (std::size_t k = 0; k < components; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      Eigen::Map<Eigen::VectorXf>(model.log_value.data() + (c * components + k) * kLossRows, kLossRows) =
          grids.values[k][c].col(j).cast<float>();
    }
    Eigen::Map<Eigen::VectorXf>(model.powers.data() + k * degree, structure_.azimuth) =
        grids.powers[k].col(j).cast<float>();
    if (!couplings_[k]) continue;
    model.coupling.resize(components * kCells);
    for_each_cell(cells_, cells_.slices[static_cast<std::size_t>(j)], [&](std::size_t cell, int node, double share) {
      model.coupling[k * kCells + cell] += static_cast<float>(share * grids.planes[k](node, j));
    });
  }
  return model;
}

double RefinedProblem::evaluate(const LossWeights& weights, const std::vector<double>& x,
                                std::vector<double>& gradient) const {
  const Grids at = grids(x);
  Grids slopes(structure_.components, structure_.azimuth);
  for (std::size_t k = 0; k < at.planes.size(); ++k) slopes.planes[k].setZero(at.planes[k].rows(), at.planes[k].cols());
  std::vector<double> losses(cells_.slices.size());
  tbb::parallel_for(0, Grid::theta_d, [&](int j) {
    const LossSlice& slice = cells_.slices[static_cast<std::size_t>(j)];
    LossModel by;
    losses[static_cast<std::size_t>(j)] = slice_loss(scaled(weights), slice, slice_model(at, j), by);
    const std::size_t components = slopes.values.size();
    for (std::size_t k = 0; k < components; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        slopes.values[k][c].col(j) =
            Eigen::Map<Eigen::VectorXf>(by.log_value.data() + (c * components + k) * kLossRows, kLossRows)
                .cast<double>();
      }
      slopes.powers[k].col(j) =
          Eigen::Map<Eigen::VectorXf>(by.powers.data() + k * static_cast<std::size_t>(structure_.azimuth),
                                      structure_.azimuth)
              .cast<double>();
      if (!couplings_[k]) continue;
      for_each_cell(cells_, slice, [&](std::size_t cell, int node, double share) {
        const std::size_t first = k * static_cast<std::size_t>(kLossRows) * kLossColumns;
        slopes.planes[k](node, j) += share * static_cast<double>(by.coupling[first + cell]);
      });
    }
  });
  gradient.assign(x.size(), 0.0);
  for (int k = 0; k < structure_.components; ++k) {
    const auto& [red, green, blue] = slopes.values[static_cast<std::size_t>(k)];
    matrix(gradient, layout_, k, RefinedPart::shape, structure_.half) =
        half_.transpose() * (red + green + blue) * difference_;
    add_colour(x, k, RefinedPart::red, red, gradient);
    add_colour(x, k, RefinedPart::blue, blue, gradient);
    matrix(gradient, layout_, k, RefinedPart::azimuth, structure_.azimuth) =
        bernstein_.transpose() * slopes.powers[static_cast<std::size_t>(k)] * azimuth_difference_;
  }
  add_coupling(x, slopes, gradient);
  double loss = 0;
  for (const double part : losses) loss += part;
  return (loss + add_ridge(x, gradient)) / cells_.total_weight;
}

double RefinedProblem::add_ridge(const std::vector<double>& x, std::vector<double>& gradient) const {
  double sum = 0;
  for (int k = 0; k < structure_.components; ++k) {
    for (const RefinedPart part : kRefinedParts) {
      const double weight = part == RefinedPart::red || part == RefinedPart::blue ? kColourRidge : kRidge;
      const auto first = static_cast<std::size_t>(layout_.first(k, part));
      for (std::size_t i = first; i < first + static_cast<std::size_t>(layout_.count(k, part)); ++i) {
        const double away = x[i] - start_[i];
        sum += weight * away * away;
        gradient[i] = (gradient[i] + 2 * weight * away) / cells_.total_weight;
      }
    }
  }
  return sum;
}

void RefinedProblem::add_coupling(const std::vector<double>& x, const Grids& slopes,
                                  std::vector<double>& gradient) const {
  tbb::parallel_for(0, structure_.components, [&](int k) {
    const std::optional<Coupling>& coupling = couplings_[static_cast<std::size_t>(k)];
    if (!coupling) return;
    const CouplingInput by = coupling->gradient(input_of(structure_, x, layout_, k),
                                                slopes.planes[static_cast<std::size_t>(k)] * difference_shares_);
    matrix(gradient, layout_, k, RefinedPart::shape, structure_.half) +=
        lattice_.half.transpose() * by.half * lattice_.difference;
    matrix(gradient, layout_, k, RefinedPart::azimuth, structure_.azimuth) +=
        lattice_.azimuth.transpose() * by.azimuth * lattice_.azimuth_difference;
    matrix(gradient, layout_, k, RefinedPart::coupling, structure_.coupling_difference) +=
        lattice_.coupling_difference.transpose() * by.dependence;
  });
}

namespace {

/// Second derivative by log g of the error at a cell, without what changes the sign of a slope.
double cell_curvature(const LossWeights& w, double f, double g, double c) {
  const auto of_log = [](double share, double miss, double softness) {
    return share * share / std::sqrt(miss * miss + softness * softness);
  };
  const double floor = 1e-3, both = std::max(c * c, floor), softness = static_cast<double>(w.softness);
  const double root = std::cbrt(g * c);
  return static_cast<double>(w.log1p) * of_log(g * c / (1 + g * c), std::log((1 + f * c) / (1 + g * c)), softness) +
         static_cast<double>(w.log_relative) *
             of_log(g * both / (g * both + floor), std::log((f * both + floor) / (g * both + floor)), 4 * softness) +
         static_cast<double>(w.cube_root) * 2 * root * root / 9 + static_cast<double>(w.likelihood) * g * both +
         static_cast<double>(w.image) * 2 * g * c * g * c;
}

/// What azimuth and copula add to the log of each component at cell n of the slice of theta_d bin j.
std::vector<double> log_factors(const std::vector<Matrix>& powers, const LossModel& model, const LossSlice& slice,
                                int j, std::size_t n) {
  constexpr std::size_t kCells = static_cast<std::size_t>(kLossRows) * kLossColumns;
  const double z = static_cast<double>(slice.azimuth[n]);
  std::vector<double> result(powers.size());
  for (std::size_t k = 0; k < powers.size(); ++k) {
    double sum = 0;
    for (Eigen::Index m = powers[k].rows() - 1; m >= 0; --m) sum = (sum + powers[k](m, j)) * z;
    if (!model.coupling.empty()) sum += static_cast<double>(model.coupling[k * kCells + n]);
    result[k] = sum;
  }
  return result;
}

}  // namespace

std::vector<double> RefinedProblem::curvature(const LossWeights& weights, const std::vector<double>& x) const {
  constexpr double kLeast = 0.01;  // of the mean
  const Grids at = grids(x);
  const auto bernstein_at = [&](double z) {  // the squares of the polynomials
    Eigen::VectorXd powers(structure_.azimuth);
    double power = 1;
    for (int m = 0; m < structure_.azimuth; ++m) powers(m) = power *= z;
    return Eigen::VectorXd((bernstein_.transpose() * powers).array().square());
  };
  Grids second(structure_.components, structure_.azimuth);
  const std::size_t components = at.values.size();
  tbb::parallel_for(0, Grid::theta_d, [&](int j) {
    const LossSlice& slice = cells_.slices[static_cast<std::size_t>(j)];
    const LossModel model = slice_model(at, j);
    for (int cell = 0; cell < kLossRows * kLossColumns; ++cell) {
      const auto n = static_cast<std::size_t>(cell);
      const int i = cell / kLossColumns;
      if (slice.weight[n] == 0) continue;
      const double z = static_cast<double>(slice.azimuth[n]);
      const double cosine = static_cast<double>(slice.cos_i[n] + slice.cos_o[n]) / 2;
      const std::vector<double> factor = log_factors(at.powers, model, slice, j, n);
      for (std::size_t c = 0; c < 3; ++c) {
        double g = 0;
        for (std::size_t k = 0; k < components; ++k) g += std::exp(at.values[k][c](i, j) + factor[k]);
        const double bend = static_cast<double>(slice.weight[n]) *
                            cell_curvature(scaled(weights), static_cast<double>(slice.measured[c][n]), g, cosine);
        for (std::size_t k = 0; k < components; ++k) {
          const double share = std::exp(at.values[k][c](i, j) + factor[k]) / g;
          const double part = bend * share * share;
          second.values[k][c](i, j) += part;
          second.powers[k].col(j) += part * bernstein_at(z);
        }
      }
    }
  });
  const auto square = [](const Matrix& basis) { return Matrix(basis.array().square().matrix()); };
  std::vector<double> result(x.size());
  for (int k = 0; k < structure_.components; ++k) {
    const auto& [red, green, blue] = second.values[static_cast<std::size_t>(k)];
    const Matrix all = red + green + blue;
    matrix(result, layout_, k, RefinedPart::shape, structure_.half) =
        square(half_).transpose() * all * square(difference_);
    matrix(result, layout_, k, RefinedPart::red, structure_.colour_half) =
        square(colour_half_).transpose() * red * square(colour_difference_);
    matrix(result, layout_, k, RefinedPart::blue, structure_.colour_half) =
        square(colour_half_).transpose() * blue * square(colour_difference_);
    matrix(result, layout_, k, RefinedPart::azimuth, structure_.azimuth) =
        second.powers[static_cast<std::size_t>(k)] * square(azimuth_difference_);
    if (!couplings_[static_cast<std::size_t>(k)]) continue;
    constexpr double kSlope = 0.3;  // of log c by the coefficient of the dependence
    const Matrix along = spline_basis(cells_.difference, structure_.coupling_difference);
    matrix(result, layout_, k, RefinedPart::coupling, structure_.coupling_difference) =
        square(kSlope * along).transpose() * all.colwise().sum().transpose();
  }
  double mean = 0;
  for (const double value : result) mean += value / static_cast<double>(result.size());
  for (double& value : result) value = std::sqrt((value + kLeast * mean + 2 * kRidge) / cells_.total_weight);
  return result;
}

}  // namespace sklar::brdf
