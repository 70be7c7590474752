#include "brdf/data/anisotropic_brdf.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "brdf/data/interpolation.hpp"

namespace sklar::brdf {

AnisotropicTableBrdf::AnisotropicTableBrdf(std::shared_ptr<const AnisotropicTable> table) : table_(std::move(table)) {
  if (!table_) throw std::invalid_argument("AnisotropicTableBrdf: no table given");
  require_table("AnisotropicTableBrdf", *table_);
}

Rgb AnisotropicTableBrdf::eval(const Vec3& wo, const Vec3& wi) const {
  if (!(wo.z() > 0 && wi.z() > 0)) return Rgb::Zero();
  return at(half_difference4(wo, wi)).value;
}

AnisotropicTableBrdf::Reading AnisotropicTableBrdf::at(const HalfDifference4& coordinates) const {
  using std::numbers::pi;
  const AnisotropicGrid& grid = table_->grid;
  const std::array<Between, 4> axes = {
      between_clamped(grid.theta_h * std::sqrt(coordinates.theta_h / (pi / 2)) - 0.5, grid.theta_h),
      between_periodic(grid.phi_h * coordinates.phi_h / (2 * pi) - 0.5, grid.phi_h),
      between_clamped(grid.theta_d * coordinates.theta_d / (pi / 2) - 0.5, grid.theta_d),
      between_periodic(grid.phi_d * coordinates.phi_d / pi - 0.5, grid.phi_d)};
  Reading sum{Rgb::Zero(), 0};
  for (unsigned corner = 0; corner < 16; ++corner) {
    std::array<int, 4> cell{};
    double weight = 1;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const bool high = (corner >> axis & 1U) != 0;
      cell[axis] = high ? axes[axis].high : axes[axis].low;
      weight *= high ? axes[axis].share : 1 - axes[axis].share;
    }
    const std::size_t index = grid.index(cell[0], cell[1], cell[2], cell[3]);
    if (weight == 0 || !table_->valid[index]) continue;
    sum.coverage += weight;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      sum.value[static_cast<int>(channel)] += weight * static_cast<double>(table_->values[channel][index]);
    }
  }
  if (sum.coverage > 0) sum.value /= sum.coverage;
  return sum;
}

}  // namespace sklar::brdf
