#pragma once
/// The shapes of the points of a plot.

namespace sklar::plot {

/// The signs of points in a plot; a dot is small and without a rim.
enum class Marker { none, dot, circle, square, triangle, diamond };

}  // namespace sklar::plot
