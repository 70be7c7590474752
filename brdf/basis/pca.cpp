#include "brdf/basis/pca.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <stdexcept>

#include "brdf/basis/fill.hpp"
#include "brdf/basis/fit_cells.hpp"

namespace sklar::brdf {
namespace {

constexpr double kFloor = 1e-3;  ///< w and e of the mapping

double cosines(const Vec3& wo, const Vec3& wi) {
  return std::max(wo.z() * wi.z(), kFloor);
}

/// The eight cells around a position and their shares.
struct Corners {
  std::array<std::size_t, 8> cell;
  std::array<double, 8> share;

  Corners(const CellGrid& grid, const CellPosition& at) : cell{}, share{} {
    std::size_t n = 0;
    for (const bool i : {false, true}) {
      for (const bool j : {false, true}) {
        for (const bool k : {false, true}) {
          cell[n] = static_cast<std::size_t>(grid.index(i ? at.theta_h.high : at.theta_h.low,
                                                        j ? at.theta_d.high : at.theta_d.low,
                                                        k ? at.phi_d.high : at.phi_d.low));
          share[n++] = (i ? at.theta_h.share : 1 - at.theta_h.share) * (j ? at.theta_d.share : 1 - at.theta_d.share) *
                       (k ? at.phi_d.share : 1 - at.phi_d.share);
        }
      }
    }
  }

  [[nodiscard]] double of(const HalfArray& values) const {
    double sum = 0;
    for (std::size_t n = 0; n < cell.size(); ++n) sum += share[n] * values[cell[n]];
    return sum;
  }
};

}  // namespace

PcaBrdf::PcaBrdf(const CellGrid& grid, HalfArray base, std::vector<HalfArray> components,
                 std::array<std::vector<float>, 3> coefficients)
    : grid_(grid), base_(std::move(base)), components_(std::move(components)), coefficients_(std::move(coefficients)) {
  bool sound = base_.size() == static_cast<std::size_t>(grid_.cells());
  for (const HalfArray& component : components_) sound = sound && component.size() == base_.size();
  for (const auto& channel : coefficients_) sound = sound && channel.size() == components_.size();
  if (!sound) throw std::invalid_argument("PcaBrdf: the sizes of grid, components and coefficients do not agree");
}

Rgb PcaBrdf::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  const Corners corners(grid_, grid_.position(half_difference(wo, wi)));
  Rgb log = Rgb::Constant(corners.of(base_));
  for (std::size_t k = 0; k < components_.size(); ++k) {
    const double here = corners.of(components_[k]);
    for (std::size_t c = 0; c < 3; ++c) log[static_cast<int>(c)] += static_cast<double>(coefficients_[c][k]) * here;
  }
  return (log.exp() - kFloor) / cosines(wo, wi);
}

namespace basis::pca {
namespace {

constexpr std::size_t kCells = 30000, kChoosingCells = 10000;
constexpr int kLeastElongation = 2;
constexpr double kRidge = 40;  ///< of Nielsen et al. 2015; for as many cells as a table has

/// The observations on a grid: a column a channel of each material, and the base.
struct Learnt {
  Eigen::MatrixXd relative;  ///< ln((f w + e) / (f_ref w + e)) - mu
  Eigen::VectorXd base;      ///< ln(f_ref w + e) + mu
  Eigen::VectorXd weight;    ///< 1 above the horizon, else 0
};

Learnt learn(const std::vector<TableBrdf>& tables, const CellGrid& grid) {
  const auto observations = static_cast<Eigen::Index>(3 * tables.size());
  Learnt learnt{Eigen::MatrixXd(grid.cells(), observations), Eigen::VectorXd(grid.cells()),
                Eigen::VectorXd(grid.cells())};
  std::vector<double> values(static_cast<std::size_t>(observations));
  for (int cell = 0; cell < grid.cells(); ++cell) {
    const HalfDifference at =
        grid.centre(cell / (grid.phi_d * grid.theta_d), cell / grid.phi_d % grid.theta_d, cell % grid.phi_d);
    const DirectionPair pair = directions(at);
    const double w = std::max(std::max(pair.wo.z(), 0.0) * std::max(pair.wi.z(), 0.0), kFloor);
    for (std::size_t t = 0; t < tables.size(); ++t) {
      const Rgb f = tables[t].at(at);
      for (std::size_t c = 0; c < 3; ++c) values[3 * t + c] = f[static_cast<int>(c)];
    }
    const double reference = std::log(median(values) * w + kFloor);
    for (Eigen::Index n = 0; n < observations; ++n) {
      learnt.relative(cell, n) = std::log(values[static_cast<std::size_t>(n)] * w + kFloor) - reference;
    }
    const double mean = learnt.relative.row(cell).mean();
    learnt.relative.row(cell).array() -= mean;
    learnt.base[cell] = reference + mean;
    learnt.weight[cell] = pair.wo.z() > 0 && pair.wi.z() > 0 ? 1 : 0;
  }
  return learnt;
}

/// The leading components, scaled so that the coefficients of the observations have unit variance.
Eigen::MatrixXd components(const Learnt& learnt, int count) {
  const Eigen::MatrixXd weighted = learnt.relative.array().colwise() * learnt.weight.array();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(learnt.relative.transpose() * weighted);
  const Eigen::MatrixXd leading = solver.eigenvectors().rowwise().reverse().leftCols(count);
  return learnt.relative * leading / std::sqrt(static_cast<double>(learnt.relative.cols()));
}

HalfArray half_array(const Eigen::VectorXd& values) {
  return HalfArray(std::span(values.data(), static_cast<std::size_t>(values.size())));
}

BrdfPtr fit_structure(const std::vector<TableBrdf>& tables, const CellGrid& grid, int count,
                      const std::vector<FitCell>& cells) {
  const Learnt learnt = learn(tables, grid);
  const Eigen::MatrixXd leading = components(learnt, count);
  HalfArray base = half_array(learnt.base);
  std::vector<HalfArray> stored;
  stored.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) stored.push_back(half_array(leading.col(k)));
  const double ridge = kRidge * static_cast<double>(cells.size()) / Grid::cells;
  Eigen::MatrixXd normal = ridge * Eigen::MatrixXd::Identity(count, count);
  Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(count, 3);
  Eigen::VectorXd here(count);
  for (const FitCell& cell : cells) {
    const Corners corners(grid, grid.position(half_difference(cell.wo, cell.wi)));
    for (int k = 0; k < count; ++k) here[k] = corners.of(stored[static_cast<std::size_t>(k)]);
    const Rgb log = (cell.value * cosines(cell.wo, cell.wi) + kFloor).log() - corners.of(base);
    normal.selfadjointView<Eigen::Lower>().rankUpdate(here);
    right += here * log.matrix().transpose();
  }
  const Eigen::MatrixX3d solution = normal.selfadjointView<Eigen::Lower>().ldlt().solve(right);
  std::array<std::vector<float>, 3> coefficients;
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < count; ++k) {
      coefficients[static_cast<std::size_t>(c)].push_back(static_cast<float>(solution(k, c)));
    }
  }
  return std::make_shared<const PcaBrdf>(grid, std::move(base), std::move(stored), std::move(coefficients));
}

/// Most cells a map that fit, twice or four times as many nodes in theta_h as in theta_d and phi_d each.
CellGrid grid_of(double max_bytes, int count, int elongation) {
  const double cells = ((max_bytes - 6 - 12.0 * count) / (count + 1) - 4) / 2;
  if (!(cells >= 8 * elongation)) return {0, 0, 0};
  const int side = std::min(static_cast<int>(std::cbrt(cells / elongation)), Grid::theta_h / elongation);
  return {elongation * side, side, static_cast<int>(std::min(cells / (elongation * side * side), 2.0 * side))};
}

struct Structure {
  CellGrid grid;
  int count;
};

/// Of the budget and parts of it, since more nodes or components are not always better for a material that is not among
/// those learnt from.
std::vector<Structure> structures(double max_bytes, int observations) {
  std::vector<Structure> list;
  for (const double share : {1.0, 0.25, 0.0625}) {
    for (const int count : {1, 2, 3, 5, 8, 13, 20}) {
      if (count >= observations) continue;
      for (const int elongation : {kLeastElongation, 2 * kLeastElongation}) {
        const CellGrid grid = grid_of(share * max_bytes, count, elongation);
        if (grid.cells() > 0) list.push_back({grid, count});
      }
    }
  }
  return list;
}

BrdfPtr fit(const BasisData& data, double max_bytes) {
  require_budget("pca", static_cast<double>(PcaBrdf::bytes(std::size_t{8} * kLeastElongation, 1)), max_bytes);
  std::vector<TableBrdf> tables;
  tables.reserve(data.others.size());
  for (const auto& other : data.others) tables.emplace_back(std::make_shared<const MeasuredTable>(filled(*other)));
  const std::vector<FitCell> cells = spread_cells(data.table, kCells);
  const std::vector<FitCell> choosing = spread_cells(data.table, kChoosingCells);
  const int observations = 3 * static_cast<int>(tables.size());
  return best_structure(structures(max_bytes, observations), choosing, [&](const Structure& structure) {
    return fit_structure(tables, structure.grid, structure.count, cells);
  });
}

}  // namespace

BasisInfo info() {
  return {
      .name = "pca",
      .title = "Principal components",
      .source = "Nielsen, Jensen and Ramamoorthi 2015, On Optimal, Minimal BRDF Sampling for Reflectance Acquisition",
      .learns_from = 2,
      .fit_unchecked = fit};
}

}  // namespace basis::pca
}  // namespace sklar::brdf
