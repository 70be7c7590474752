#include "brdf/basis/separable_svd.hpp"

#include <algorithm>
#include <stdexcept>

#include "brdf/basis/fill.hpp"
#include "brdf/basis/fit_cells.hpp"
#include "brdf/basis/low_rank.hpp"

namespace sklar::brdf {

SeparableSvd::SeparableSvd(const CellGrid& grid, std::vector<Term> terms) : grid_(grid), terms_(std::move(terms)) {
  for (const Term& term : terms_) {
    if (term.half.size() != static_cast<std::size_t>(3 * grid.theta_h) ||
        term.difference.size() != static_cast<std::size_t>(grid.theta_d * grid.phi_d)) {
      throw std::invalid_argument("SeparableSvd: a term is not sized as the grid");
    }
  }
}

std::size_t SeparableSvd::bytes(const CellGrid& grid, int terms) {
  const std::size_t term = HalfArray::bytes(static_cast<std::size_t>(3 * grid.theta_h)) +
                           HalfArray::bytes(static_cast<std::size_t>(grid.theta_d * grid.phi_d));
  return 6 + static_cast<std::size_t>(terms) * term;
}

Rgb SeparableSvd::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  const auto [half, theta, phi] = grid_.position(half_difference(wo, wi));
  const auto low = static_cast<std::size_t>(half.low), high = static_cast<std::size_t>(half.high);
  const auto node = [&](int j, int k) { return static_cast<std::size_t>(k + grid_.phi_d * j); };
  const std::size_t corner[] = {node(theta.low, phi.low), node(theta.low, phi.high), node(theta.high, phi.low),
                                node(theta.high, phi.high)};
  Rgb sum = Rgb::Zero();
  for (const Term& term : terms_) {
    const HalfArray& v = term.difference;
    const double difference =
        mix(mix(v[corner[0]], v[corner[1]], phi.share), mix(v[corner[2]], v[corner[3]], phi.share), theta.share);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const std::size_t first = channel * static_cast<std::size_t>(grid_.theta_h);
      sum[static_cast<int>(channel)] += difference * mix(term.half[first + low], term.half[first + high], half.share);
    }
  }
  return sum;
}

namespace basis::separable_svd {
namespace {

constexpr std::size_t kChoosingCells = 20000;
constexpr int kSweeps = 4;             ///< eight change log1p_mae by less than a tenth, either way
constexpr double kLeastWeight = 1e-3;  ///< cells below the horizon hold continued values that interpolation reads

/// The values on the nodes: rows (channel, theta_h), columns (theta_d, phi_d); and their weights.
struct Nodes {
  Eigen::MatrixXd values, weights;
};

Nodes nodes_of(const TableBrdf& table, const CellGrid& grid) {
  Nodes nodes;
  nodes.values.resize(Eigen::Index{3} * grid.theta_h, Eigen::Index{grid.theta_d} * grid.phi_d);
  nodes.weights.resizeLike(nodes.values);
  for (int i = 0; i < grid.theta_h; ++i) {
    for (int j = 0; j < grid.theta_d; ++j) {
      for (int k = 0; k < grid.phi_d; ++k) {
        const HalfDifference centre = grid.centre(i, j, k);
        const Rgb value = table.at(centre);
        const DirectionPair pair = directions(centre);
        const bool above = pair.wi.z() > 0 && pair.wo.z() > 0;
        const Rgb weight = log_weight(value, above ? std::max(pair.wi.z() * pair.wo.z(), kLeastWeight) : kLeastWeight);
        for (int channel = 0; channel < 3; ++channel) {
          nodes.values(channel * grid.theta_h + i, j * grid.phi_d + k) = value[channel];
          nodes.weights(channel * grid.theta_h + i, j * grid.phi_d + k) = weight[channel];
        }
      }
    }
  }
  return nodes;
}

std::shared_ptr<const SeparableSvd> fit_structure(const TableBrdf& table, const CellGrid& grid, int rank) {
  const Nodes nodes = nodes_of(table, grid);
  const LowRank factors = low_rank(nodes.values, nodes.weights, rank, kSweeps);
  std::vector<SeparableSvd::Term> terms;
  for (int k = 0; k < rank; ++k) {
    const auto column = [&](const Eigen::MatrixXd& matrix) {
      return HalfArray(std::span(matrix.col(k).data(), static_cast<std::size_t>(matrix.rows())));
    };
    terms.push_back({column(factors.rows), column(factors.columns)});
  }
  return std::make_shared<const SeparableSvd>(grid, std::move(terms));
}

struct Structure {
  CellGrid grid;
  int rank;
};

/// For each rank and number of theta_h nodes the finest nodes of v, half as many in theta_d as in phi_d, that fit.
std::vector<Structure> structures(double max_bytes) {
  std::vector<Structure> list;
  for (const int rank : {1, 2, 3, 4, 6, 8, 12, 16}) {
    for (const int theta_h : {12, 23, 45, 90}) {
      const double rest = (max_bytes - 6) / rank - 8 - 6.0 * theta_h;  // of a term, for v
      if (!(rest >= 2 * 18)) continue;
      const double side = std::min(std::sqrt(rest / 4), 60.0);  // theta_d * 2 theta_d * 2 bytes
      const int theta_d = static_cast<int>(side);
      const int phi_d = std::min(static_cast<int>(std::min(rest / (2 * theta_d), 1e6)), 2 * theta_d + 2);
      const CellGrid grid{theta_h, theta_d, phi_d};
      if (rank <= std::min(3 * theta_h, theta_d * phi_d)) list.push_back({grid, rank});
    }
  }
  return list;
}

BrdfPtr fit(const BasisData& data, double max_bytes) {
  const std::vector<Structure> list = structures(max_bytes);
  if (list.empty()) require_budget("separable_svd", 6 + 8 + 6 * 12 + 2 * 18, max_bytes);
  const TableBrdf table(std::make_shared<const MeasuredTable>(filled(data.table)));
  const std::vector<FitCell> cells = spread_cells(data.table, kChoosingCells);
  return best_structure(
      list, cells, [&](const Structure& structure) { return fit_structure(table, structure.grid, structure.rank); });
}

}  // namespace

BasisInfo info() {
  return {.name = "separable_svd",
          .title = "Separable (SVD)",
          .source =
              "Fournier 1995; Kautz and McCool 1999, Interactive Rendering with Arbitrary BRDFs using Separable "
              "Approximations",
          .fit_unchecked = fit};
}

}  // namespace basis::separable_svd
}  // namespace sklar::brdf
