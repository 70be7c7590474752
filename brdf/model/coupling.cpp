#include "brdf/model/coupling.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "brdf/model/spline.hpp"

namespace sklar::brdf {
namespace {

constexpr double kStrongest = 0.8;  ///< |tau|
constexpr double kUniform = 1e-4;   ///< share of uniform in a margin

double logistic(double x) {
  return 1 / (1 + std::exp(-x));
}

/// A cdf at the middle of each node's mass.
struct Cdf {
  Eigen::ArrayXd mass, at;
  double total;

  explicit Cdf(const Eigen::ArrayXd& log_density)
      : mass((log_density - log_density.maxCoeff()).exp()), at(mass.size()), total(0) {
    const double uniform = kUniform * mass.sum() / static_cast<double>(mass.size());
    for (Eigen::Index i = 0; i < mass.size(); ++i) {
      at(i) = total + (mass(i) + uniform) / 2;
      total += mass(i) + uniform;
    }
    at /= total;
  }

  /// Derivatives by the log density from those by the cdf.
  [[nodiscard]] Eigen::ArrayXd gradient(const Eigen::ArrayXd& slopes) const {
    const double mean = (slopes * at).sum();
    Eigen::ArrayXd result(mass.size());
    double above = 0;
    for (Eigen::Index i = mass.size() - 1; i >= 0; --i) {
      result(i) = (above + slopes(i) / 2 - mean) / total;
      above += slopes(i);
    }
    const double uniform = kUniform * (result.sum()) / static_cast<double>(mass.size());
    return (result + uniform) * mass;
  }
};

/// All pairs of nodes, azimuth fastest.
Points grid(const Eigen::ArrayXd& u, const Eigen::ArrayXd& v) {
  Points points(Lattice::plane, 2);
  for (int i = 0; i < Lattice::half; ++i) {
    points.col(0).segment(Lattice::index(i, 0), Lattice::azimuth).setConstant(u(i));
    points.col(1).segment(Lattice::index(i, 0), Lattice::azimuth) = v;
  }
  return points;
}

Eigen::ArrayXd step_of(const Eigen::ArrayXd& u) {
  constexpr double kStep = 1e-4;
  return kStep * u.min(1 - u);
}

Column log_density(const FamilyInfo& family, double tau, const Points& points) {
  return family.make(2, family.theta_from_tau(tau))->log_pdf(points);
}

bool is_dense(const FamilyInfo& family, double tau) {
  const Eigen::ArrayXd u = Eigen::ArrayXd::LinSpaced(Lattice::half, kUniform, 1 - kUniform);
  const Eigen::ArrayXd v = Eigen::ArrayXd::LinSpaced(Lattice::azimuth, kUniform, 1 - kUniform);
  return log_density(family, tau, grid(u, v)).isFinite().all();
}

}  // namespace

std::vector<bool> coupled(const std::vector<FamilyInfo>& families) {
  std::vector<bool> result(families.size());
  std::transform(families.begin(), families.end(), result.begin(),
                 [](const FamilyInfo& family) { return !family.parameters.empty(); });
  return result;
}

LatticeBases::LatticeBases(const RefinedStructure& structure) {
  const Eigen::ArrayXd along = Eigen::ArrayXd::LinSpaced(Lattice::difference, 0, 1);
  const Eigen::ArrayXd across = Eigen::ArrayXd::LinSpaced(Lattice::half, 0, 1);
  half = spline_basis(across, structure.half);
  colour_half = spline_basis(across, structure.colour_half);
  colour_difference = spline_basis(along, structure.colour_difference);
  difference = spline_basis(along, structure.difference);
  azimuth_difference = spline_basis(along, structure.azimuth_difference);
  coupling_difference = spline_basis(along, structure.coupling_difference);
  azimuth.resize(Lattice::azimuth, structure.azimuth);
  const Eigen::ArrayXd z = Eigen::ArrayXd::LinSpaced(Lattice::azimuth, 0, 1);
  for (int m = 0; m < structure.azimuth; ++m) azimuth.col(m) = z.pow(m + 1);
  azimuth = azimuth * bernstein_powers(structure.azimuth);
}

CouplingInput coupling_input(const RefinedStructure& structure, const std::vector<double>& shape,
                             const std::vector<double>& azimuth, const std::vector<double>& coupling) {
  using Matrix = Eigen::Map<const Eigen::MatrixXd>;
  const LatticeBases bases(structure);
  const Matrix a(shape.data(), structure.half, structure.difference);
  const Matrix p(azimuth.data(), structure.azimuth, structure.azimuth_difference);
  const Eigen::Map<const Eigen::VectorXd> e(coupling.data(), structure.coupling_difference);
  return {.half = bases.half * a * bases.difference.transpose(),
          .azimuth = bases.azimuth * p * bases.azimuth_difference.transpose(),
          .dependence = bases.coupling_difference * e};
}

Coupling::Coupling(const FamilyInfo& family) : family_(family) {
  if (family.parameters.size() != 1 || !family.theta_from_tau) {
    throw std::invalid_argument("refined model: " + family.name +
                                " cannot couple; allowed are families of one parameter that tau determines");
  }
  const Interval range = family.tau_range(2);
  lowest_ = kStrongest * range.lowest;
  highest_ = kStrongest * range.highest;
  if (lowest_ < 0 && !is_dense(family, lowest_)) lowest_ = 0;
  if (highest_ > 0 && !is_dense(family, highest_)) highest_ = 0;
  constexpr double kWeak = 3;  // the logistic function of -kWeak is 0.05
  const double share = -lowest_ / (highest_ - lowest_);
  start_ = share > 0 && share < 1 ? std::log(share / (1 - share)) : share >= 1 ? kWeak : -kWeak;
}

double Coupling::tau(double dependence) const {
  return lowest_ + (highest_ - lowest_) * logistic(dependence + start_);
}

double Coupling::dependence(double tau) const {
  constexpr double kEdge = 0.005;
  const double share = std::clamp((tau - lowest_) / (highest_ - lowest_), kEdge, 1 - kEdge);
  return std::log(share / (1 - share)) - start_;
}

double Coupling::tau_slope(double dependence) const {
  const double share = logistic(dependence + start_);
  return (highest_ - lowest_) * share * (1 - share);
}

CouplingValues Coupling::values(const CouplingInput& input) const {
  CouplingValues result(Lattice::plane, Lattice::difference);
  for (int p = 0; p < Lattice::difference; ++p) {
    const Cdf u(input.half.col(p)), v(input.azimuth.col(p));
    result.col(p) = log_density(family_, tau(input.dependence(p)), grid(u.at, v.at));
  }
  return result;
}

CouplingInput Coupling::gradient(const CouplingInput& input, const CouplingValues& slopes) const {
  CouplingInput result{Eigen::MatrixXd(Lattice::half, Lattice::difference),
                       Eigen::MatrixXd(Lattice::azimuth, Lattice::difference), Eigen::VectorXd(Lattice::difference)};
  using Plane = Eigen::Map<Eigen::ArrayXXd>;
  for (int p = 0; p < Lattice::difference; ++p) {
    const Cdf u(input.half.col(p)), v(input.azimuth.col(p));
    const double centre = tau(input.dependence(p));
    const CopulaPtr copula = family_.make(2, family_.theta_from_tau(centre));
    const Eigen::ArrayXd du = step_of(u.at), dv = step_of(v.at);
    Column by_u = copula->log_pdf(grid(u.at + du, v.at)) - copula->log_pdf(grid(u.at - du, v.at));
    Column by_v = copula->log_pdf(grid(u.at, v.at + dv)) - copula->log_pdf(grid(u.at, v.at - dv));
    by_u *= slopes.col(p).array();
    by_v *= slopes.col(p).array();
    const Eigen::ArrayXd u_slopes =
        Plane(by_u.data(), Lattice::azimuth, Lattice::half).colwise().sum().transpose() / (2 * du);
    const Eigen::ArrayXd v_slopes = Plane(by_v.data(), Lattice::azimuth, Lattice::half).rowwise().sum() / (2 * dv);
    result.half.col(p) = u.gradient(u_slopes);
    result.azimuth.col(p) = v.gradient(v_slopes);
    const double step = 1e-4 * std::min(centre - lowest_, highest_ - centre);
    const Points points = grid(u.at, v.at);
    const Column by_tau = log_density(family_, centre + step, points) - log_density(family_, centre - step, points);
    result.dependence(p) = (by_tau * slopes.col(p).array()).sum() / (2 * step) * tau_slope(input.dependence(p));
  }
  return result;
}

}  // namespace sklar::brdf
