#pragma once
/// Drawing in PNG and SVG: the only user of Cairo.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "copula/plot/axis.hpp"
#include "copula/plot/bytes.hpp"
#include "copula/plot/marker.hpp"

namespace sklar::plot {

/// How text is drawn.
struct Font {
  double size = 12;
  bool bold = false;
  Colour colour{0.13, 0.13, 0.13};
};

/// A place on the sheet.
struct Point {
  double x, y;
};

/// A rectangle from its upper left corner.
struct Box {
  double x, y, width, height;
};

/// A white sheet; units from the top left corner, y down.
class Canvas {
 public:
  /// @param path ends in .png or .svg. @param pixels of a PNG along a unit.
  /// @throws std::invalid_argument for another ending.
  Canvas(const std::filesystem::path& path, double width, double height, double pixels);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void fill(const Box& box, const Colour& colour);
  void stroke(const Box& box, const Colour& colour, double width);
  void line(const std::vector<Point>& points, const Colour& colour, double width, bool dashed = false);
  void area(const std::vector<Point>& corners, const Colour& colour);
  void marker(Point centre, Marker marker, const Colour& colour);
  void picture(Point corner, const Bytes& bytes);

  /// Text on a baseline at `at`; align is the share of the width left of it. `_{...}` is lowered, `^{...}` raised.
  /// Upright text reads upwards when `vertical`.
  void text(Point at, const std::string& text, const Font& font, double align = 0, bool vertical = false);
  [[nodiscard]] double text_width(const std::string& text, const Font& font);

  /// Restricts drawing to a box, until unclip.
  void clip(const Box& box);
  void unclip();

  /// Writes the file. @throws FileError
  void save();

 private:
  struct Sheet;
  std::unique_ptr<Sheet> sheet_;
};

}  // namespace sklar::plot
