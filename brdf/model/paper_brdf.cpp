#include "brdf/model/paper_brdf.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "brdf/data/measured_table.hpp"
#include "copula/error.hpp"

namespace sklar::brdf {

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr std::array<const char*, 3> kAxes = {"theta_h", "theta_d", "phi_d"};

void require_slice(const PaperSlice& slice, int slices) {
  const std::array<int, 3> bins = {Grid::theta_h, Grid::theta_d / slices, Grid::phi_d};
  if (!(slice.scale >= 0) || !std::isfinite(slice.scale)) {
    throw std::domain_error("paper model: scale must be finite and >= 0, got " + sklar::to_text(double{slice.scale}));
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int expected = slice.scale > 0 ? bins[axis] : 0;
    if (slice.masses[axis].size() != static_cast<std::size_t>(expected)) {
      throw std::invalid_argument("paper model: a slice of scale " + sklar::to_text(double{slice.scale}) + " has " +
                                  std::to_string(expected) + " masses of " + kAxes[axis] + ", got " +
                                  std::to_string(slice.masses[axis].size()));
    }
  }
}

HistogramMarginal histogram(const std::vector<float>& masses) {
  std::vector<double> edges(masses.size() + 1);
  std::iota(edges.begin(), edges.end(), 0.0);
  return {std::move(edges), {masses.begin(), masses.end()}};
}

std::array<double, 2> centres_with_mass(const std::vector<float>& masses) {
  const auto holds = [](float mass) { return mass > 0; };
  const auto first = std::find_if(masses.begin(), masses.end(), holds) - masses.begin();
  const auto last = masses.rend() - std::find_if(masses.rbegin(), masses.rend(), holds) - 1;
  return {static_cast<double>(first) + 0.5, static_cast<double>(last) + 0.5};
}

int bin_of(double position, int bins) {
  return std::clamp(static_cast<int>(position), 0, bins - 1);
}

}  // namespace

std::string_view to_text(CellMeasure measure) {
  return measure == CellMeasure::per_cell ? "cell" : "solid-angle";
}

double cell_measure(int theta_h_bin, int theta_d_bin) {
  const auto edge = [](int bin) { return std::pow(bin / double{Grid::theta_h}, 2) * std::numbers::pi / 2; };
  const double theta_d = Grid::theta_d_centre(theta_d_bin);
  const double omega_h = 2 * std::numbers::pi * (std::cos(edge(theta_h_bin)) - std::cos(edge(theta_h_bin + 1)));
  return 4 * std::cos(theta_d) * omega_h * std::sin(theta_d) / (kDegrees * kDegrees);
}

PaperBrdf::PaperBrdf(const FamilyInfo& family, CellMeasure measure, std::array<std::vector<PaperSlice>, 3> channels)
    : family_(family.name), definition_(family.definition), measure_(measure), channels_(std::move(channels)) {
  const std::size_t count = channels_[0].size();
  if (count == 0 || Grid::theta_d % count != 0) {
    throw std::invalid_argument("paper model: the number of slices must divide " + std::to_string(Grid::theta_d) +
                                ", got " + std::to_string(count));
  }
  for (std::size_t channel = 0; channel < 3; ++channel) {
    if (channels_[channel].size() != count) {
      throw std::invalid_argument("paper model: the channels have " + std::to_string(count) + " and " +
                                  std::to_string(channels_[channel].size()) + " slices; they must agree");
    }
    for (const PaperSlice& slice : channels_[channel]) {
      require_slice(slice, slices());
      densities_[channel].push_back(make_density(family, slice));
    }
  }
}

PaperBrdf::Density PaperBrdf::make_density(const FamilyInfo& family, const PaperSlice& slice) {
  Density density;
  if (slice.scale == 0) return density;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    density.margins.push_back(histogram(slice.masses[axis]));
    density.inside[axis] = centres_with_mass(slice.masses[axis]);
  }
  density.copula = family.make(kPaperDimension, slice.theta);
  density.log_scale = std::log(double{slice.scale});
  return density;
}

PaperBrdf::Place PaperBrdf::locate(const HalfDifference& coordinates) const {
  const double theta_h = Grid::theta_h * std::sqrt(coordinates.theta_h * 2 / std::numbers::pi);
  const double theta_d = coordinates.theta_d * kDegrees;
  const int row = bin_of(theta_d, Grid::theta_d);
  const int width = Grid::theta_d / slices();
  const int slice = row / width;
  const double measure = measure_ == CellMeasure::per_cell ? 1 : cell_measure(bin_of(theta_h, Grid::theta_h), row);
  return {slice, {theta_h, theta_d - slice * width, coordinates.phi_d * kDegrees}, measure};
}

double PaperBrdf::Density::place(const Place& place, std::array<double, 3>& u) const {
  double log_value = log_scale - std::log(place.measure);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double position = std::clamp(place.bins[axis], inside[axis][0], inside[axis][1]);
    u[axis] = margins[axis].cdf(position);
    log_value += margins[axis].log_pdf(position);
  }
  return log_value;
}

Rgb PaperBrdf::at(const HalfDifference& coordinates) const {
  const Place place = locate(coordinates);
  Rgb value = Rgb::Zero();
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const Density& density = densities_[channel][static_cast<std::size_t>(place.slice)];
    if (density.margins.empty()) continue;
    std::array<double, 3> u;
    const double log_value = density.place(place, u);
    if (!std::isfinite(log_value)) continue;
    value[static_cast<Eigen::Index>(channel)] = std::exp(log_value + density.copula->log_pdf_at(u));
  }
  return value;
}

Rgb PaperBrdf::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  return at(half_difference(wo, wi));
}

void PaperBrdf::eval_batch(const DirectionsRef& wo, const DirectionsRef& wi, Eigen::Ref<RgbRows> out) const {
  out.setZero();
  std::vector<PlacedRows> rows(static_cast<std::size_t>(slices()));
  for (Eigen::Index row = 0; row < wo.rows(); ++row) {
    if (!(wo(row, 2) > 0 && wi(row, 2) > 0)) continue;
    const Place place = locate(half_difference(Vec3(wo.row(row).transpose()), Vec3(wi.row(row).transpose())));
    rows[static_cast<std::size_t>(place.slice)].emplace_back(row, place);
  }
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t slice = 0; slice < rows.size(); ++slice) {
      eval_rows(densities_[channel][slice], rows[slice], out.col(static_cast<Eigen::Index>(channel)));
    }
  }
}

void PaperBrdf::eval_rows(const Density& density, const PlacedRows& rows, Eigen::Ref<Eigen::ArrayXd> out) {
  if (density.margins.empty() || rows.empty()) return;
  const auto count = static_cast<Eigen::Index>(rows.size());
  Points u(count, 3);
  Column log_value(count);
  std::array<double, 3> point;
  for (Eigen::Index i = 0; i < count; ++i) {
    log_value(i) = density.place(rows[static_cast<std::size_t>(i)].second, point);
    u.row(i) = Eigen::Map<const Eigen::Array3d>(point.data()).transpose();
  }
  const Column log_copula = density.copula->log_pdf(u);
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!std::isfinite(log_value(i))) continue;
    out(rows[static_cast<std::size_t>(i)].first) = std::exp(log_value(i) + log_copula(i));
  }
}

std::size_t PaperBrdf::bytes() const {
  std::size_t numbers = 0;
  for (const auto& channel : channels_) {
    for (const PaperSlice& slice : channel) {
      for (const auto& masses : slice.masses) numbers += masses.size();
      numbers += slice.theta.size() + 1;
    }
  }
  return numbers * sizeof(float);
}

}  // namespace sklar::brdf
