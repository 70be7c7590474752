#include "copula/plot/canvas.hpp"

#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <stdexcept>

#include "copula/error.hpp"
#include "copula/file.hpp"

namespace sklar::plot {
namespace {

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

struct Run {
  std::string text;
  int level;  ///< -1 lowered, 0, 1 raised
};

/// Splits text at `_{...}` and `^{...}`.
std::vector<Run> runs(const std::string& text) {
  std::vector<Run> all;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = std::min(text.find("_{", at), text.find("^{", at));
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos) {  // `open` may be npos, and then so is `close`
      all.push_back({text.substr(at), 0});
      break;
    }
    all.push_back({text.substr(at, open - at), 0});
    all.push_back({text.substr(open + 2, close - open - 2), text[open] == '_' ? -1 : 1});
    at = close + 1;
  }
  return all;
}

}  // namespace

struct Canvas::Sheet {
  std::filesystem::path path;
  std::string svg;
  cairo_surface_t* surface = nullptr;
  cairo_t* cairo = nullptr;

  ~Sheet() {
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
  }

  void colour(const Colour& c) { cairo_set_source_rgb(cairo, c.red, c.green, c.blue); }

  /// Selects the font of a run and gives its advance.
  double select(const Run& run, const Font& font) {
    cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           font.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, run.level == 0 ? font.size : 0.72 * font.size);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, run.text.c_str(), &extents);
    return extents.x_advance;
  }
};

Canvas::Canvas(const std::filesystem::path& path, double width, double height, double pixels)
    : sheet_(std::make_unique<Sheet>()) {
  sheet_->path = path;
  if (path.extension() == ".png") {
    const auto size = [pixels](double units) { return static_cast<int>(std::lround(units * pixels)); };
    sheet_->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, size(width), size(height));
    cairo_surface_set_device_scale(sheet_->surface, pixels, pixels);
  } else if (path.extension() == ".svg") {
    constexpr double kPoints = 0.75;  // Cairo's unit is 1/72 inch
    sheet_->surface = cairo_svg_surface_create_for_stream(append, &sheet_->svg, width * kPoints, height * kPoints);
    cairo_surface_set_device_scale(sheet_->surface, kPoints, kPoints);
  } else {
    throw std::invalid_argument(path.string() + ": a plot must end in .png or .svg");
  }
  sheet_->cairo = cairo_create(sheet_->surface);
  fill({0, 0, width, height}, {1, 1, 1});
}

Canvas::~Canvas() = default;

void Canvas::fill(const Box& box, const Colour& colour) {
  sheet_->colour(colour);
  cairo_rectangle(sheet_->cairo, box.x, box.y, box.width, box.height);
  cairo_fill(sheet_->cairo);
}

void Canvas::stroke(const Box& box, const Colour& colour, double width) {
  sheet_->colour(colour);
  cairo_set_line_width(sheet_->cairo, width);
  cairo_rectangle(sheet_->cairo, box.x, box.y, box.width, box.height);
  cairo_stroke(sheet_->cairo);
}

void Canvas::line(const std::vector<Point>& points, const Colour& colour, double width, bool dashed) {
  if (points.empty()) return;
  sheet_->colour(colour);
  cairo_set_line_width(sheet_->cairo, width);
  cairo_set_line_join(sheet_->cairo, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(sheet_->cairo, dashed ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);  // no gaps between pieces
  constexpr double kDashes[] = {5, 3};
  cairo_set_dash(sheet_->cairo, kDashes, dashed ? 2 : 0, 0);
  cairo_new_path(sheet_->cairo);
  for (const Point& point : points) cairo_line_to(sheet_->cairo, point.x, point.y);
  cairo_stroke(sheet_->cairo);
  cairo_set_dash(sheet_->cairo, nullptr, 0, 0);
}

void Canvas::area(const std::vector<Point>& corners, const Colour& colour) {
  sheet_->colour(colour);
  cairo_new_path(sheet_->cairo);
  for (const Point& point : corners) cairo_line_to(sheet_->cairo, point.x, point.y);
  cairo_fill(sheet_->cairo);
}

void Canvas::marker(Point centre, Marker marker, const Colour& colour) {
  constexpr double kRadius = 4.2;  // of the circle; the others have about its area
  const auto polygon = [&](std::initializer_list<Point> corners) {
    for (const Point& p : corners) cairo_line_to(sheet_->cairo, centre.x + p.x * kRadius, centre.y + p.y * kRadius);
  };
  cairo_new_path(sheet_->cairo);
  switch (marker) {
    case Marker::none:
      return;
    case Marker::dot: {
      constexpr double kDot = 1.6;
      cairo_arc(sheet_->cairo, centre.x, centre.y, kDot, 0, 2 * std::numbers::pi);
      sheet_->colour(colour);
      cairo_fill(sheet_->cairo);
      return;
    }
    case Marker::circle:
      cairo_arc(sheet_->cairo, centre.x, centre.y, kRadius, 0, 2 * std::numbers::pi);
      break;
    case Marker::square:
      polygon({{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}});
      break;
    case Marker::triangle:
      polygon({{0, -1.3}, {1.2, 0.85}, {-1.2, 0.85}});
      break;
    case Marker::diamond:
      polygon({{0, -1.35}, {1.15, 0}, {0, 1.35}, {-1.15, 0}});
      break;
  }
  cairo_close_path(sheet_->cairo);
  sheet_->colour(colour);
  cairo_fill_preserve(sheet_->cairo);
  sheet_->colour({1, 1, 1});  // a rim keeps markers apart where they overlap
  cairo_set_line_width(sheet_->cairo, 0.8);
  cairo_stroke(sheet_->cairo);
}

void Canvas::picture(Point corner, const Bytes& bytes) {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, bytes.width, bytes.height);
  cairo_surface_flush(surface);
  unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int row = 0; data != nullptr && row < bytes.height; ++row) {
    auto* pixel = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(row) * stride);
    const std::uint8_t* rgb = bytes.rgb.data() + static_cast<std::ptrdiff_t>(row) * bytes.width * 3;
    for (int column = 0; column < bytes.width; ++column, rgb += 3) {
      pixel[column] = static_cast<std::uint32_t>(rgb[0] << 16 | rgb[1] << 8 | rgb[2]);
    }
  }
  cairo_surface_mark_dirty(surface);
  cairo_set_source_surface(sheet_->cairo, surface, corner.x, corner.y);
  cairo_paint(sheet_->cairo);
  cairo_surface_destroy(surface);
}

double Canvas::text_width(const std::string& text, const Font& font) {
  double width = 0;
  for (const Run& run : runs(text)) width += sheet_->select(run, font);
  return width;
}

void Canvas::text(Point at, const std::string& text, const Font& font, double align, bool vertical) {
  cairo_t* cairo = sheet_->cairo;
  cairo_save(cairo);
  cairo_translate(cairo, at.x, at.y);
  if (vertical) cairo_rotate(cairo, -std::numbers::pi / 2);
  double x = -align * text_width(text, font);
  sheet_->colour(font.colour);
  for (const Run& run : runs(text)) {
    const double advance = sheet_->select(run, font);
    cairo_move_to(cairo, x, run.level < 0 ? 0.22 * font.size : -0.36 * font.size * run.level);
    cairo_show_text(cairo, run.text.c_str());
    x += advance;
  }
  cairo_restore(cairo);
}

void Canvas::clip(const Box& box) {
  cairo_save(sheet_->cairo);
  cairo_rectangle(sheet_->cairo, box.x, box.y, box.width, box.height);
  cairo_clip(sheet_->cairo);
}

void Canvas::unclip() {
  cairo_restore(sheet_->cairo);
}

void Canvas::save() {
  std::string png;
  cairo_status_t status = cairo_status(sheet_->cairo);
  const bool vector = sheet_->path.extension() == ".svg";
  if (status == CAIRO_STATUS_SUCCESS) {
    if (vector) {
      cairo_surface_finish(sheet_->surface);
      status = cairo_surface_status(sheet_->surface);
    } else {
      status = cairo_surface_write_to_png_stream(sheet_->surface, append, &png);
    }
  }
  if (status != CAIRO_STATUS_SUCCESS) {
    throw FileError(sheet_->path.string(), std::string("cannot be drawn: ") + cairo_status_to_string(status));
  }
  write_file(sheet_->path, vector ? sheet_->svg : png);
}

}  // namespace sklar::plot
