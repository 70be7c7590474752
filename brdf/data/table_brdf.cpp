#include "brdf/data/table_brdf.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace sklar::brdf {

CellPosition cell_position(const HalfDifference& coordinates) {
  constexpr double kDegree = std::numbers::pi / 180;
  return {
      .theta_h = between_clamped(Grid::theta_h * std::sqrt(coordinates.theta_h / (90 * kDegree)) - 0.5, Grid::theta_h),
      .theta_d = between_clamped(coordinates.theta_d / kDegree - 0.5, Grid::theta_d),
      .phi_d = between_periodic(coordinates.phi_d / kDegree - 0.5, Grid::phi_d)};
}

TableBrdf::TableBrdf(std::shared_ptr<const MeasuredTable> table) : table_(std::move(table)) {
  if (!table_) throw std::invalid_argument("TableBrdf: no table given");
  require_table("TableBrdf", *table_);
}

Rgb TableBrdf::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  return at(half_difference(wo, wi));
}

Rgb TableBrdf::at(const HalfDifference& coordinates) const {
  const CellPosition position = cell_position(coordinates);
  const Between& i = position.theta_h;
  const Between& j = position.theta_d;
  const Between& k = position.phi_d;
  Rgb result;
  for (int channel = 0; channel < 3; ++channel) {
    const double* plane = table_->values[static_cast<std::size_t>(channel)].data();
    const auto along_phi = [&](int row, int column) {
      return mix(plane[Grid::index(row, column, k.low)], plane[Grid::index(row, column, k.high)], k.share);
    };
    result[channel] = mix(mix(along_phi(i.low, j.low), along_phi(i.low, j.high), j.share),
                          mix(along_phi(i.high, j.low), along_phi(i.high, j.high), j.share), i.share);
  }
  return result;
}

}  // namespace sklar::brdf
