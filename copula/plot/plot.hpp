#pragma once
/// Plots as PNG or SVG: pages of line plots and heat maps, and grids of pictures. Legends of pages break into lines. In
/// every text `_{...}` is lowered and
/// `^{...}` raised.

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "copula/plot/axis.hpp"
#include "copula/plot/bytes.hpp"
#include "copula/plot/marker.hpp"

namespace sklar::plot {

/// A line or points of a plot.
struct Line {
  std::string label = {};  ///< lines with one label share one entry of the legend; empty: none
  std::vector<double> x = {}, y = {};
  Colour colour{0, 0, 0};
  bool dashed = false;
  double width = 1.6;  ///< 0: markers alone
  Marker marker = Marker::none;
  bool filled = false;  ///< the area from the line down to the axis, paler than the line
};

/// Joined points; a point that an axis cannot show breaks its line.
struct LinePlot {
  std::string title = {};
  Axis x = {}, y = {};
  std::vector<Line> lines = {};
};

/// A rectangle of colour for each value; what the scale cannot show stays grey.
struct HeatMap {
  std::string title = {};
  Axis x = {}, y = {};
  std::vector<double> x_edges = {}, y_edges = {};  ///< one more than columns, rows; rising
  Eigen::ArrayXXd values = {};                     ///< rows along y, columns along x
  Axis colour = {};                                ///< of the colour bar
};

/// One plot of a page.
using Panel = std::variant<LinePlot, HeatMap>;

/// The lines on which a function has a value, by marching squares: its values at the points of a grid are joined
/// linearly along the sides of cells, straight across them. A cell with a value that is not finite has no line.
/// @param x, y rising. @param values y.size() rows, x.size() columns.
/// @return x and y of the ends of the pieces, a NaN behind each, all else left to the caller.
/// @throws std::invalid_argument for a grid of another size.
[[nodiscard]] Line contour(const std::vector<double>& x, const std::vector<double>& y, const Eigen::ArrayXXd& values,
                           double level);

/// Plots in rows and columns.
struct Page {
  std::string title = {};
  int columns = 3;
  std::vector<Panel> panels = {};
  double panel_width = 340;  ///< in units of 1/96 inch; a PNG has two pixels a unit
  double panel_height = 270;
};

/// A picture of a grid.
struct Tile {
  Bytes picture;
  std::string caption;  ///< below the picture
};

/// Pictures in rows and columns.
struct ImageGrid {
  std::string title = {};
  std::vector<std::string> column_labels, row_labels;  ///< empty, or one for each column, row
  std::vector<std::vector<Tile>> rows;                 ///< all of one size
  std::optional<Axis> colour_bar;                      ///< a viridis bar below, for rows in false colour
};

/// @param path ends in .png or .svg.
/// @throws std::invalid_argument for another ending, an empty page or arrays that do not fit together; FileError.
void write_page(const std::filesystem::path& path, const Page& page);

/// One pixel of a PNG for each pixel of a picture. Errors as write_page.
void write_grid(const std::filesystem::path& path, const ImageGrid& grid);

}  // namespace sklar::plot
