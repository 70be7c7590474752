#include "brdf/basis/homomorphic.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <numbers>
#include <stdexcept>

#include "brdf/basis/fit_cells.hpp"
#include "brdf/data/interpolation.hpp"
#include "brdf/geometry/frame.hpp"

namespace sklar::brdf {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

Between theta_nodes(const Vec3& w, std::size_t nodes) {
  return between_clamped(polar_angle(w) / kRightAngle * (static_cast<double>(nodes) - 1), static_cast<int>(nodes));
}

Between half_nodes(const Vec3& wo, const Vec3& wi, std::size_t nodes) {
  const double x = std::sqrt(polar_angle(wi + wo) / kRightAngle);
  return between_clamped(x * (static_cast<double>(nodes) - 1), static_cast<int>(nodes));
}

double at(const HalfArray& values, const Between& where) {
  return mix(values[static_cast<std::size_t>(where.low)], values[static_cast<std::size_t>(where.high)], where.share);
}

}  // namespace

Homomorphic::Homomorphic(std::array<Channel, 3> channels) : channels_(std::move(channels)) {
  for (const Channel& channel : channels_) {
    if (channel.log_p.size() < 2 || channel.log_p.size() != channels_[0].log_p.size() || channel.log_q.size() < 2 ||
        channel.log_q.size() != channels_[0].log_q.size()) {
      throw std::invalid_argument("Homomorphic: each factor needs the same two or more nodes in every channel");
    }
  }
}

std::size_t Homomorphic::bytes() const {
  std::size_t sum = 0;
  for (const Channel& channel : channels_) sum += channel.log_p.bytes() + channel.log_q.bytes();
  return sum;
}

Rgb Homomorphic::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  const Between of_wo = theta_nodes(wo, channels_[0].log_p.size());
  const Between of_wi = theta_nodes(wi, channels_[0].log_p.size());
  const Between of_half = half_nodes(wo, wi, channels_[0].log_q.size());
  Rgb result;
  for (std::size_t c = 0; c < 3; ++c) {
    const Channel& channel = channels_[c];
    const double log_p = at(channel.log_p, of_wo) + at(channel.log_p, of_wi);
    result[static_cast<int>(c)] = std::exp(log_p + at(channel.log_q, of_half));
  }
  return result;
}

namespace basis::homomorphic {
namespace {

constexpr std::size_t kCells = 200000;
constexpr double kDarkest = 1e-4;     ///< 1/sr, what has no logarithm counts as
constexpr double kSmoothness = 1e-3;  ///< of a second difference, against the cells of a node
constexpr double kGauge = 1e-9;       ///< of the sizes of p and q, whose product alone the cells tell
constexpr std::size_t kMostNodes = 90;

/// Normal equations of ln f = p(wo) + p(wi) + q(h) on `nodes` nodes a factor: p first, then q; a column a channel.
struct NormalEquations {
  Eigen::MatrixXd matrix;
  Eigen::MatrixX3d right;

  explicit NormalEquations(std::size_t nodes)
      : matrix(Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(2 * nodes), static_cast<Eigen::Index>(2 * nodes))),
        right(Eigen::MatrixX3d::Zero(static_cast<Eigen::Index>(2 * nodes), 3)) {}

  void add(const FitCell& cell, std::size_t nodes) {
    const Between where[] = {theta_nodes(cell.wo, nodes), theta_nodes(cell.wi, nodes),
                             half_nodes(cell.wo, cell.wi, nodes)};
    std::array<Eigen::Index, 6> index{};
    std::array<double, 6> share{};
    for (std::size_t n = 0; n < 3; ++n) {
      const Eigen::Index first = n == 2 ? static_cast<Eigen::Index>(nodes) : 0;
      index[2 * n] = first + where[n].low;
      index[2 * n + 1] = first + where[n].high;
      share[2 * n] = 1 - where[n].share;
      share[2 * n + 1] = where[n].share;
    }
    const Eigen::Array3d logs = cell.value.max(kDarkest).log();
    for (std::size_t a = 0; a < 6; ++a) {
      for (std::size_t b = 0; b < 6; ++b) matrix(index[a], index[b]) += share[a] * share[b];
      right.row(index[a]) += (share[a] * logs).matrix().transpose();
    }
  }

  void smooth(std::size_t nodes, double cells) {
    const double weight = kSmoothness * cells / static_cast<double>(nodes);
    for (std::size_t factor = 0; factor < 2; ++factor) {
      for (std::size_t n = 1; n + 1 < nodes; ++n) {
        const auto first = static_cast<Eigen::Index>(factor * nodes + n - 1);
        matrix.block<3, 3>(first, first) += weight * Eigen::Vector3d(1, -2, 1) * Eigen::RowVector3d(1, -2, 1);
      }
    }
    matrix.diagonal().array() += kGauge * cells;
  }
};

BrdfPtr fit(const BasisData& data, double max_bytes) {
  constexpr std::size_t kFewestNodes = 4;
  constexpr double kArrays = 6, kScale = sizeof(float);
  require_budget("homomorphic", kArrays * (kScale + 2 * kFewestNodes), max_bytes);
  const auto nodes =
      static_cast<std::size_t>(std::min((max_bytes / kArrays - kScale) / 2, static_cast<double>(kMostNodes)));
  const std::vector<FitCell> cells = spread_cells(data.table, kCells);
  NormalEquations equations(nodes);
  for (const FitCell& cell : cells) equations.add(cell, nodes);
  equations.smooth(nodes, static_cast<double>(cells.size()));
  const Eigen::MatrixX3d solution = equations.matrix.ldlt().solve(equations.right);
  std::array<Homomorphic::Channel, 3> channels;
  for (std::size_t c = 0; c < 3; ++c) {
    const double* column = solution.col(static_cast<Eigen::Index>(c)).data();
    channels[c] = {HalfArray(std::span(column, nodes)), HalfArray(std::span(column + nodes, nodes))};
  }
  return std::make_shared<const Homomorphic>(std::move(channels));
}

}  // namespace

BasisInfo info() {
  return {.name = "homomorphic",
          .title = "Homomorphic factorisation",
          .source = "McCool, Ang and Ahmad 2001, Homomorphic Factorization of BRDFs for High-Performance Rendering",
          .fit_unchecked = fit};
}

}  // namespace basis::homomorphic
}  // namespace sklar::brdf
