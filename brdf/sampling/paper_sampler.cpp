#include "brdf/sampling/paper_sampler.hpp"

#include <tbb/parallel_for.h>

#include <array>
#include <numbers>
#include <stdexcept>

#include "brdf/geometry/frame.hpp"
#include "brdf/luminance.hpp"
#include "copula/inference/fit.hpp"

namespace sklar::brdf {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFloor = 1e-4;  // of the mean mass of a bin: no direction is left out

struct Axis {
  Index bins;
  double end;

  [[nodiscard]] double centre(Index i) const {
    return (static_cast<double>(i) + 0.5) * end / static_cast<double>(bins);
  }
};

std::vector<Axis> axes(PaperCoordinates coordinates) {
  constexpr double kRight = kPi / 2;
  if (coordinates == PaperCoordinates::isotropic) return {{45, kRight}, {45, kRight}, {90, kPi}};
  return {{18, kRight}, {24, 2 * kPi}, {18, kRight}, {24, 2 * kPi}};
}

/// Cells of the grid, the last axis fastest.
struct Cells {
  std::vector<Index> shape{};
  Column mass;
};

Cells tabulated(const Brdf& brdf, const std::vector<Axis>& grid, PaperTarget target) {
  Cells cells;
  Index count = 1;
  for (const Axis& axis : grid) {
    cells.shape.push_back(axis.bins);
    count *= axis.bins;
  }
  cells.mass.resize(count);
  const bool full = grid.size() == 4;
  const Index rows = count / grid.back().bins;
  tbb::parallel_for(Index{0}, rows, [&](Index row) {
    const Axis &azimuth = grid.back(), &polar = grid[grid.size() - 2];
    const Index i = row % polar.bins, before = row / polar.bins;
    const double phi_o = full ? grid[1].centre(before % grid[1].bins) : 0.0;
    const double theta_o = grid[0].centre(full ? before / grid[1].bins : before), theta_i = polar.centre(i);
    const Vec3 wo = spherical_direction(theta_o, phi_o);
    const double factor = target == PaperTarget::reflected_light ? std::cos(theta_i) * std::sin(theta_i) : 1.0;
    for (Index k = 0; k < azimuth.bins; ++k) {
      const Rgb f = brdf.eval(wo, spherical_direction(theta_i, azimuth.centre(k)));
      cells.mass(row * azimuth.bins + k) = factor * luminance(f);
    }
  });
  return cells;
}

/// Masses of one axis (Eq. 11), none 0.
std::vector<double> margin(const Cells& cells, std::size_t axis) {
  Index inner = 1;
  for (std::size_t k = axis + 1; k < cells.shape.size(); ++k) inner *= cells.shape[k];
  std::vector<double> sums(static_cast<std::size_t>(cells.shape[axis]));
  for (Index cell = 0; cell < cells.mass.size(); ++cell) {
    sums[static_cast<std::size_t>(cell / inner % cells.shape[axis])] += cells.mass(cell);
  }
  const double mean = cells.mass.sum() / static_cast<double>(sums.size());
  for (double& sum : sums) sum += mean > 0 ? kFloor * mean : 1.0;
  return sums;
}

Theta fit_theta(const Cells& cells, const FamilyInfo& family) {
  if (!(cells.mass.sum() > 0)) return family.examples.front();
  CellTable table = cell_table(cells.mass, cells.shape);
  table.u = table.u.min(std::nextafter(1.0, 0.0));
  const FitResult fit = fit_least_squares(family, table, {.tolerance = 1e-5, .standard_errors = false});
  if (fit.status == FitStatus::failed) throw std::runtime_error("PaperSampledBrdf: " + fit.message);
  return fit.theta;
}

double azimuth_of(const Vec3& w) {
  const double phi = std::atan2(w.y(), w.x());
  return phi < 0 ? phi + 2 * kPi : phi;
}

}  // namespace

PaperSampledBrdf::PaperSampledBrdf(BrdfPtr brdf, const FamilyInfo& family, PaperTarget target,
                                   PaperCoordinates coordinates)
    : brdf_(std::move(brdf)) {
  if (!brdf_) throw std::invalid_argument("PaperSampledBrdf: no reflectance given");
  if (coordinates == PaperCoordinates::isotropic && !brdf_->traits().isotropic) {
    throw std::invalid_argument("PaperSampledBrdf: an anisotropic reflectance needs the full coordinates");
  }
  const std::vector<Axis> grid = axes(coordinates);
  const Cells cells = tabulated(*brdf_, grid, target);
  double volume = 1;
  for (std::size_t axis = 0; axis < grid.size(); ++axis) {
    std::vector<double> edges;
    for (Index i = 0; i <= grid[axis].bins; ++i) {
      edges.push_back(grid[axis].end * static_cast<double>(i) / static_cast<double>(grid[axis].bins));
    }
    volume *= grid[axis].end / static_cast<double>(grid[axis].bins);
    margins_.emplace_back(std::move(edges), margin(cells, axis));
  }
  theta_ = fit_theta(cells, family);
  copula_ = family.make(static_cast<int>(grid.size()), theta_);
  if (given() == 2) copula_of_wo_ = family.make(2, theta_);
  log_scale_ = std::log(cells.mass.sum() * volume);
}

std::size_t PaperSampledBrdf::bytes() const {
  std::size_t numbers = theta_.size();
  for (const HistogramMarginal& margin : margins_) numbers += margin.masses().size();
  return brdf_->bytes() + sizeof(float) * numbers;
}

PaperSampledBrdf::Point PaperSampledBrdf::place(const Vec3& wo, const Vec3& wi) const {
  Point point{};
  const double phi_o = azimuth_of(wo), phi_i = azimuth_of(wi);
  if (given() == 2) {
    point.angle = {polar_angle(wo), phi_o, polar_angle(wi), phi_i};
  } else {
    const double apart = std::abs(phi_i - phi_o);
    point.angle = {polar_angle(wo), polar_angle(wi), apart > kPi ? 2 * kPi - apart : apart, 0};
  }
  for (std::size_t k = 0; k < margins_.size(); ++k) point.u[k] = margins_[k].cdf(point.angle[k]);
  return point;
}

double PaperSampledBrdf::log_given(const Point& point) const {
  double sum = given() == 2 ? copula_of_wo_->log_pdf_at({point.u.data(), 2}) : 0.0;
  for (std::size_t k = 0; k < given(); ++k) sum += margins_[k].log_pdf(point.angle[k]);
  return sum;
}

double PaperSampledBrdf::log_joint(const Point& point) const {
  double sum = copula_->log_pdf_at({point.u.data(), margins_.size()});
  for (std::size_t k = 0; k < margins_.size(); ++k) sum += margins_[k].log_pdf(point.angle[k]);
  return sum;
}

double PaperSampledBrdf::pdf(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return 0;
  const double sine = std::sqrt(wi.x() * wi.x() + wi.y() * wi.y());
  if (sine == 0) return 0;  // a point; the density grows without bound towards it
  const Point point = place(wo, wi);
  const double sides = given() == 2 ? 1 : 2;
  return std::exp(log_joint(point) - log_given(point)) / (sides * sine);
}

double PaperSampledBrdf::modelled(const Vec3& wo, const Vec3& wi) const {
  return std::exp(log_scale_ + log_joint(place(wo, wi)));
}

double PaperSampledBrdf::printed_weight(const Vec3& wo, const Vec3& wi) const {
  const double sides = given() == 2 ? 1 : 2;
  const double sine = std::sqrt(wi.x() * wi.x() + wi.y() * wi.y());
  return sides * std::exp(log_scale_ + log_given(place(wo, wi))) * wi.z() * sine;
}

Vec3 PaperSampledBrdf::sample_direction(const Vec3& wo, const Vec2& uniforms) const {
  if (!(wo.z() > 0)) return Brdf::sample_direction(wo, uniforms);
  const bool full = given() == 2;
  const double turned = full ? uniforms.y() : 2 * uniforms.y() - 1;
  const double phi_o = azimuth_of(wo);
  Points fixed(1, static_cast<Index>(given())), w(1, 2);
  fixed(0) = margins_[0].cdf(polar_angle(wo));
  if (full) fixed(1) = margins_[1].cdf(phi_o);
  w << uniforms.x(), std::abs(turned);
  const Points u = copula_->inverse_rosenblatt(w, fixed);
  const double theta_i = margins_[given()].quantile(u(0, u.cols() - 2));
  const double phi = margins_[given() + 1].quantile(u(0, u.cols() - 1));
  return spherical_direction(theta_i, full ? phi : phi_o + std::copysign(phi, turned));
}

}  // namespace sklar::brdf
