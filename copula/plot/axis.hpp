#pragma once
/// The arithmetic of plots: scales, ticks, colours.

#include <cstddef>
#include <string>
#include <vector>

namespace sklar::plot {

/// How values are spread along an axis.
enum class Scale {
  linear,
  logarithmic,
  square_root,
  digits  ///< the number of digits -log10(value), logarithmic: errors below 1, from single precision to hundreds of
          ///< digits
};

struct Axis {
  std::string label = {};
  Scale scale = Scale::linear;
  double low = 0;  ///< low == high: from the data
  double high = 0;
  std::vector<double> ticks = {};  ///< empty: chosen
};

/// A mark on an axis with its label.
struct Tick {
  double position;  ///< on the axis, 0 at low, 1 at high
  std::string text;
};

/// The axis with an empty range replaced by that of the values, ignoring what the scale cannot show, and widened where
/// they are all equal. A linear axis is widened to whole ticks.
[[nodiscard]] Axis fitted(Axis axis, const std::vector<double>& values);

/// 0 at low, 1 at high; NaN for a value that the scale cannot show.
[[nodiscard]] double axis_position(const Axis& axis, double value);

/// The most parts into which chosen ticks cut an axis.
inline constexpr int kTickParts = 6;

/// Ticks within the range: round numbers, or decades on a logarithmic axis. Where one of the round numbers would be
/// written with an exponent, all are in the unit that axis_label names. @param axis low < high. @param parts 1 or more,
/// for round numbers and decades.
[[nodiscard]] std::vector<Tick> axis_ticks(const Axis& axis, int parts = kTickParts);

/// The label with the unit of the ticks, a power of 1000, where it is not 1: "loss (in 10^{6})".
/// @param axis low < high.
[[nodiscard]] std::string axis_label(const Axis& axis);

/// sRGB, each in [0,1].
struct Colour {
  double red, green, blue;
};

/// viridis by S. van der Walt and N. Smith (CC0), nine of its colours joined by straight lines in sRGB: dark violet at
/// 0, yellow at 1. @param share clipped to [0,1], NaN as 0.
[[nodiscard]] Colour viridis(double share);

/// Colours told apart by all eyes (Okabe and Ito 2008), without black, repeating after seven.
[[nodiscard]] Colour series_colour(std::size_t index);

}  // namespace sklar::plot
