#pragma once
/// The shapes of the points of a plot.

namespace sklar::plot {

/// The signs of points in a plot.
enum class Marker { none, circle, square, triangle, diamond };

}  // namespace sklar::plot
