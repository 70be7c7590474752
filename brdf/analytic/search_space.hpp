#pragma once
/// The free values of an isotropic model as coordinates in which a step of one size changes a reflectance about as much
/// wherever it is taken.

#include <vector>

#include "brdf/analytic/info.hpp"
#include "copula/inference/minimise.hpp"

namespace sklar::brdf {

/// Coordinates of the values but those with isotropic_as, in their order: log(value + 0.01) for a value per channel,
/// which is a reflectance or a strength; by AnalyticParameter::scale for the others: the value itself, log(value), or
/// log(value + 1) where 0 is admissible.
class SearchSpace {
 public:
  /// Coordinates that may be moved together to see what each does: the three of a parameter per channel, or one.
  struct Group {
    std::size_t first;
    std::size_t count;
  };

  /// @param info kept by reference.
  explicit SearchSpace(const AnalyticInfo& info);

  [[nodiscard]] std::size_t size() const { return axes_.size(); }
  [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }

  /// The bounds.
  [[nodiscard]] const Box& box() const { return box_; }

  /// Where searches may start: the coordinates per channel of initial(); for the others the whole interval if linear, a
  /// factor of 30 either side of the default if logarithmic. @param shares of each interval, in [0,1], one a group of
  /// one coordinate, in their order.
  [[nodiscard]] std::vector<double> start(const std::vector<double>& shares) const;

  /// Within the bounds. @param values info.size() of them; those with isotropic_as are not read.
  [[nodiscard]] std::vector<double> coordinates(const AnalyticValues& values) const;

  /// The inverse; within the bounds whatever the rounding.
  [[nodiscard]] AnalyticValues values(const std::vector<double>& coordinates) const;

 private:
  struct Axis {
    std::size_t value;  ///< index into AnalyticValues
    const AnalyticParameter* parameter;
    double offset;  ///< log(value + offset); negative: the value itself

    [[nodiscard]] double to_coordinate(double x) const;
    [[nodiscard]] double to_value(double z) const;
  };

  const AnalyticInfo& info_;
  std::vector<Axis> axes_;
  std::vector<Group> groups_;
  Box box_;
};

}  // namespace sklar::brdf
