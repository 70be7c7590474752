#pragma once
/// A measured table read between its cell centres.

#include "brdf/data/interpolation.hpp"
#include "brdf/data/measured_table.hpp"
#include "brdf/geometry/coordinates.hpp"

namespace sklar::brdf {

/// Where coordinates lie between the cell centres of Grid, axis by axis.
struct CellPosition {
  Between theta_h, theta_d, phi_d;
};
/// The cells around coordinates.
[[nodiscard]] CellPosition cell_position(const HalfDifference& coordinates);

/// Trilinear interpolation in (90 sqrt(theta_h / 90 deg), theta_d, phi_d) as docs/conventions.md pins it: a cell's
/// value stands at its centre, phi_d is periodic, edges are clamped, masked cells count as 0.
class TableBrdf final : public Brdf {
 public:
  /// @throws std::invalid_argument if the table is null or fails require_table.
  explicit TableBrdf(std::shared_ptr<const MeasuredTable> table);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;

  /// The value at half/difference coordinates, whether or not the directions there are above the horizon.
  [[nodiscard]] Rgb at(const HalfDifference& coordinates) const;

  [[nodiscard]] Traits traits() const override { return {}; }
  [[nodiscard]] std::size_t bytes() const override { return std::size_t{3} * Grid::cells * sizeof(double); }
  [[nodiscard]] const MeasuredTable& table() const { return *table_; }

 private:
  std::shared_ptr<const MeasuredTable> table_;
};

}  // namespace sklar::brdf
