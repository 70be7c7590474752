#include "brdf/analytic/fit_cells.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "brdf/data/cell_directions.hpp"
#include "brdf/data/fit_weight.hpp"

namespace sklar::brdf {
namespace {

constexpr int kFolded = Grid::phi_d / 2;
constexpr int kThetaDBlock = 6, kPhiDBlock = 18;  // cells
constexpr double kFloor = 1e-3;                   // of w and of the ratio
constexpr double kLog1pWeight = 4, kImageWeight = 2;
constexpr double kRelativeSoftness = 4;  // times that of log1p
static_assert(Grid::theta_d % kThetaDBlock == 0 && kFolded % kPhiDBlock == 0);

struct Cell {
  DirectionPair pair;
  std::size_t one, other;  ///< both halves of phi_d
  double weight;
};

/// The cells of a block that count.
void collect(const MeasuredTable& table, int i, int first_j, int first_k, std::vector<Cell>& block) {
  block.clear();
  for (int j = first_j; j < first_j + kThetaDBlock; ++j) {
    for (int k = first_k; k < first_k + kPhiDBlock; ++k) {
      const auto one = static_cast<std::size_t>(Grid::index(i, j, k));
      const auto other = static_cast<std::size_t>(Grid::index(i, j, Grid::phi_d - 1 - k));
      const int valid = table.valid[one] + table.valid[other];
      if (valid == 0) continue;
      const DirectionPair pair = cell_directions(i, j, k);
      const double counts = fit_weight(pair);
      if (counts > 0) block.push_back({pair, one, other, valid * counts});
    }
  }
}

/// One cell of each block that has any; which one moves from block to block by the golden section.
std::vector<Cell> chosen_cells(const MeasuredTable& table, std::size_t& in_table) {
  std::vector<Cell> chosen, block;
  double fraction = 0;
  for (int i = 0; i < Grid::theta_h; ++i) {
    for (int j = 0; j < Grid::theta_d; j += kThetaDBlock) {
      for (int k = 0; k < kFolded; k += kPhiDBlock) {
        collect(table, i, j, k, block);
        if (block.empty()) continue;
        fraction = std::fmod(fraction + std::numbers::phi, 1.0);
        Cell& cell = chosen.emplace_back(block[static_cast<std::size_t>(fraction * static_cast<double>(block.size()))]);
        cell.weight = 0;
        for (const Cell& of_block : block) {
          cell.weight += of_block.weight;
          in_table += static_cast<std::size_t>(table.valid[of_block.one] + table.valid[of_block.other]);
        }
      }
    }
  }
  return chosen;
}

/// sqrt(x^2 + e^2) - e.
Eigen::ArrayXd soft_absolute(const Eigen::ArrayXd& x, double softness) {
  return (x.square() + softness * softness).sqrt() - softness;
}

}  // namespace

FitCells fit_cells(const MeasuredTable& table) {
  require_table("fit_cells", table);
  FitCells cells;
  cells.scale = fit_scale(table.values, table.valid_cells());
  const std::vector<Cell> chosen = chosen_cells(table, cells.in_table);
  if (chosen.empty()) {
    throw std::invalid_argument("fit_cells: table '" + table.name +
                                "' has no valid cell with cosines of at least 0.02");
  }
  const auto n = static_cast<Eigen::Index>(chosen.size());
  cells.wo.resize(n, 3);
  cells.wi.resize(n, 3);
  cells.weight.resize(n);
  for (auto& plane : cells.measured) plane.resize(n);
  for (Eigen::Index row = 0; row < n; ++row) {
    const Cell& cell = chosen[static_cast<std::size_t>(row)];
    cells.wo.row(row) = cell.pair.wo.transpose().array();
    cells.wi.row(row) = cell.pair.wi.transpose().array();
    cells.weight(row) = cell.weight;
    const int valid = table.valid[cell.one] + table.valid[cell.other];
    for (std::size_t c = 0; c < 3; ++c) {
      cells.measured[c](row) = cells.scale * (table.values[c][cell.one] + table.values[c][cell.other]) / valid;
    }
  }
  cells.weight /= cells.weight.sum();
  const Eigen::ArrayXd square = 0.5 * (cells.wo.col(2).square() + cells.wi.col(2).square());
  for (const auto& plane : cells.measured) cells.mean_square += (cells.weight * square * plane.square()).sum() / 3;
  return cells;
}

BalancedError::BalancedError(FitCells cells)
    : cells_(std::move(cells)),
      cos_i_(cells_.scale * cells_.wi.col(2)),
      cos_o_(cells_.scale * cells_.wo.col(2)),
      both_(cells_.scale * (cells_.wi.col(2) * cells_.wo.col(2)).max(kFloor)) {
  square_ = 0.5 * (cells_.wi.col(2).square() + cells_.wo.col(2).square());
  if (cells_.mean_square > 0) square_ /= cells_.mean_square;
  for (std::size_t c = 0; c < 3; ++c) {
    const Eigen::ArrayXd measured = cells_.measured[c] / cells_.scale;
    log_i_[c] = (1 + measured * cos_i_).log();
    log_o_[c] = (1 + measured * cos_o_).log();
    log_w_[c] = (kFloor + measured * both_).log();
  }
}

Rgb BalancedError::operator()(const Brdf& model, double softness) const {
  const RgbRows values = model.eval(cells_.wo, cells_.wi);
  Rgb result;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto g = values.col(static_cast<Eigen::Index>(c));
    const Eigen::ArrayXd of_i = (1 + g * cos_i_).log() - log_i_[c];
    const Eigen::ArrayXd of_o = (1 + g * cos_o_).log() - log_o_[c];
    const Eigen::ArrayXd relative = (kFloor + g * both_).log() - log_w_[c];
    const Eigen::ArrayXd error = 0.5 * kLog1pWeight * (soft_absolute(of_i, softness) + soft_absolute(of_o, softness)) +
                                 soft_absolute(relative, kRelativeSoftness * softness) +
                                 kImageWeight * square_ * (cells_.scale * g - cells_.measured[c]).square();
    result[static_cast<Eigen::Index>(c)] = (cells_.weight * error).sum();
  }
  return result;
}

}  // namespace sklar::brdf
