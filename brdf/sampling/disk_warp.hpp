#pragma once
/// The polar coordinate of the half vector's disk in which margins are tabulated.

#include <algorithm>
#include <cmath>

namespace sklar::brdf {

/// |m|^2 as the coordinate in [0,1] in which margins are tabulated: about |m|^2 up to core^2, about log |m| from there,
/// so that lobes of any width above core^2 have knots. With core a, spread v, g^4 = a^4 + (1 - a^4) |m|^2, y = g - a:
///     coordinate = (1 + v / (1 - a)) y / (v + y).
struct DiskWarp {
  double spread, core, core4, scale;
  double above_core;  ///< 1 / (1 - core4)

  /// @param spread_ in (0,1].
  explicit DiskWarp(double spread_)
      : spread(spread_),
        core(kCore * spread),
        core4((core * core) * (core * core)),
        scale(1 + spread / (1 - core)),
        above_core(1 / (1 - core4)) {}

  /// A coordinate and its slope.
  struct Place {
    double coordinate;
    double slope;  ///< dcoordinate / d|m|^2
  };
  [[nodiscard]] Place of(double disk2) const {
    const double g2 = std::sqrt(core4 + (1 - core4) * disk2), g = std::sqrt(g2), y = g - core;
    const double inverse = 1 / (spread + y);
    return {std::clamp(scale * y * inverse, 0.0, 1.0),
            scale * spread * (0.25 * (1 - core4)) * (inverse * inverse) / (g2 * g)};
  }

  /// |m|^2 at the coordinate part / whole.
  [[nodiscard]] double disk2(double part, double whole) const {
    const double y = part * spread / (scale * whole - part);
    const double g = core + y;  // g^4 - core^4 without cancellation
    return y * (core + g) * (core * core + g * g) * above_core;
  }

 private:
  static constexpr double kCore = 0.2;
};

}  // namespace sklar::brdf
