#include "copula/plot/plot.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "copula/plot/canvas.hpp"

namespace sklar::plot {
namespace {

constexpr Colour kInk{0.13, 0.13, 0.13};
constexpr Colour kGrid{0.90, 0.90, 0.90};
constexpr Colour kEmpty{0.88, 0.88, 0.88};
constexpr double kMargin = 14;
constexpr double kBar = 12;  ///< thickness of a colour bar
const Font kTitle{.size = 16, .bold = true};
const Font kHeading{.size = 13, .bold = true};
constexpr double kLabelSize = 12;
const Font kLabel{.size = kLabelSize};
const Font kTickFont{.size = 11};

double height_of(const std::string& text, const Font& font) {
  return text.empty() ? 0 : font.size + 10;
}

double widest(Canvas& canvas, const std::vector<Tick>& ticks) {
  double width = 0;
  for (const Tick& tick : ticks) width = std::max(width, canvas.text_width(tick.text, kTickFont));
  return width;
}

/// Text that would not fit is set smaller.
void draw_fitted(Canvas& canvas, Point at, const std::string& text, Font font, double width, bool vertical = false) {
  font.size *= std::min(1.0, width / std::max(canvas.text_width(text, font), 1.0));
  canvas.text(at, text, font, 0.5, vertical);
}

/// The axis as it is drawn: its range found, its label with the unit.
Axis drawn(const Axis& axis, const std::vector<double>& values) {
  Axis result = fitted(axis, values);
  result.label = axis_label(result);
  return result;
}

/// Ticks along a width, as many as stand apart.
std::vector<Tick> ticks_across(Canvas& canvas, const Axis& axis, double width) {
  constexpr double kGap = 6;
  const auto half = [&](const Tick& tick) { return canvas.text_width(tick.text, kTickFont) / 2; };
  const auto touch = [&](const Tick& left, const Tick& right) {
    return (right.position - left.position) * width < half(left) + half(right) + kGap;
  };
  for (int parts = kTickParts;; --parts) {
    std::vector<Tick> ticks = axis_ticks(axis, parts);
    if (parts == 1 || std::adjacent_find(ticks.begin(), ticks.end(), touch) == ticks.end()) return ticks;
  }
}

/// The box of the data inside a panel, after title, labels and ticks have their room.
Box data_box(Canvas& canvas, const Box& panel, const std::string& title, const Axis& x, const Axis& y, double right) {
  const double left = kLabel.size + 14 + widest(canvas, axis_ticks(y));
  const double top = height_of(title, kHeading);
  const double bottom = kTickFont.size + 8 + height_of(x.label, kLabel);
  return {panel.x + left, panel.y + top, panel.width - left - right, panel.height - top - bottom};
}

void draw_title(Canvas& canvas, const Box& data, const std::string& title) {
  draw_fitted(canvas, {data.x + data.width / 2, data.y - 8}, title, kHeading, data.width);
}

/// Ticks, their texts and both labels outside the box; lines across it where `lines`.
void draw_axes(Canvas& canvas, const Box& box, const Axis& x, const Axis& y, bool lines) {
  const double bottom = box.y + box.height;
  for (const Tick& tick : ticks_across(canvas, x, box.width)) {
    const double at = box.x + tick.position * box.width;
    if (lines) canvas.line({{at, box.y}, {at, bottom}}, kGrid, 0.8);
    canvas.line({{at, bottom}, {at, bottom + 4}}, kInk, 1);
    canvas.text({at, bottom + 6 + kTickFont.size}, tick.text, kTickFont, 0.5);
  }
  for (const Tick& tick : axis_ticks(y)) {
    const double at = bottom - tick.position * box.height;
    if (lines) canvas.line({{box.x, at}, {box.x + box.width, at}}, kGrid, 0.8);
    canvas.line({{box.x - 4, at}, {box.x, at}}, kInk, 1);
    canvas.text({box.x - 7, at + 0.36 * kTickFont.size}, tick.text, kTickFont, 1);
  }
  draw_fitted(canvas, {box.x + box.width / 2, bottom + 12 + kTickFont.size + kLabel.size}, x.label, kLabel, box.width);
  const double left = box.x - 14 - widest(canvas, axis_ticks(y));
  draw_fitted(canvas, {left, box.y + box.height / 2}, y.label, kLabel, box.height, true);
}

void fill_below(Canvas& canvas, std::vector<Point> corners, const Colour& colour, double bottom) {
  if (corners.empty()) return;
  constexpr double kPale = 0.4;
  const auto pale = [](double channel) { return 1 - kPale * (1 - channel); };
  corners.insert(corners.begin(), {corners.front().x, bottom});
  corners.push_back({corners.back().x, bottom});
  canvas.area(corners, {pale(colour.red), pale(colour.green), pale(colour.blue)});
}

void draw_lines(Canvas& canvas, const Box& box, const LinePlot& plot, const Axis& x, const Axis& y) {
  canvas.clip(box);
  for (const Line& line : plot.lines) {
    std::vector<Point> points;
    const auto flush = [&] {
      if (line.filled) fill_below(canvas, points, line.colour, box.y + box.height);
      if (line.width > 0) canvas.line(points, line.colour, line.width, line.dashed);
      for (const Point& point : points) canvas.marker(point, line.marker, line.colour);
      points.clear();
    };
    for (std::size_t n = 0; n < line.x.size(); ++n) {
      const double across = axis_position(x, line.x[n]);
      const double up = axis_position(y, line.y[n]);
      if (std::isfinite(across) && std::isfinite(up)) {
        points.push_back({box.x + across * box.width, box.y + (1 - up) * box.height});
      } else {
        flush();
      }
    }
    flush();
  }
  canvas.unclip();
}

void draw(Canvas& canvas, const Box& panel, const LinePlot& plot) {
  std::vector<double> all_x;
  std::vector<double> all_y;
  for (const Line& line : plot.lines) {
    if (line.x.size() != line.y.size()) {
      throw std::invalid_argument("write_page: line '" + line.label + "' has " + std::to_string(line.x.size()) +
                                  " x and " + std::to_string(line.y.size()) + " y");
    }
    all_x.insert(all_x.end(), line.x.begin(), line.x.end());
    all_y.insert(all_y.end(), line.y.begin(), line.y.end());
  }
  const Axis x = drawn(plot.x, all_x);
  const Axis y = drawn(plot.y, all_y);
  const Box box = data_box(canvas, panel, plot.title, x, y, std::max(12.0, widest(canvas, axis_ticks(x)) / 2));
  draw_title(canvas, box, plot.title);
  draw_axes(canvas, box, x, y, true);
  draw_lines(canvas, box, plot, x, y);
  canvas.stroke(box, kInk, 1);
}

/// A bar of viridis, rising to the right or upwards; ticks are left to the caller.
void draw_bar(Canvas& canvas, const Box& box, bool upright) {
  constexpr int kSteps = 128;
  for (int n = 0; n < kSteps; ++n) {
    const Colour colour = viridis((n + 0.5) / kSteps);
    const double from = static_cast<double>(n) / kSteps;
    const double rest = 1 - from;  // each step covers all that follow: no seams
    if (upright) {
      canvas.fill({box.x, box.y, box.width, box.height * rest}, colour);
    } else {
      canvas.fill({box.x + box.width * from, box.y, box.width * rest, box.height}, colour);
    }
  }
  canvas.stroke(box, kInk, 1);
}

void draw_cells(Canvas& canvas, const Box& box, const HeatMap& map, const Axis& x, const Axis& y, const Axis& colour) {
  const auto column = [&](std::size_t n) { return box.x + axis_position(x, map.x_edges[n]) * box.width; };
  const auto row = [&](std::size_t n) { return box.y + (1 - axis_position(y, map.y_edges[n])) * box.height; };
  canvas.clip(box);
  canvas.fill(box, kEmpty);
  constexpr double kOverlap = 0.3;  // units by which a cell reaches under its neighbours: no seams
  for (std::size_t i = 0; i + 1 < map.y_edges.size(); ++i) {
    for (std::size_t j = 0; j + 1 < map.x_edges.size(); ++j) {
      const double share =
          axis_position(colour, map.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
      if (!std::isfinite(share)) continue;
      canvas.fill({column(j), row(i + 1), column(j + 1) - column(j) + kOverlap, row(i) - row(i + 1) + kOverlap},
                  viridis(share));
    }
  }
  canvas.unclip();
}

void draw(Canvas& canvas, const Box& panel, const HeatMap& map) {
  if (map.values.rows() + 1 != static_cast<Eigen::Index>(map.y_edges.size()) ||
      map.values.cols() + 1 != static_cast<Eigen::Index>(map.x_edges.size())) {
    throw std::invalid_argument("write_page: heat map '" + map.title +
                                "' needs one edge more than it has rows and columns");
  }
  const Axis x = drawn(map.x, map.x_edges);
  const Axis y = drawn(map.y, map.y_edges);
  const Axis colour = drawn(map.colour, {map.values.data(), map.values.data() + map.values.size()});
  const std::vector<Tick> ticks = axis_ticks(colour);
  const double right = 12 + kBar + 10 + widest(canvas, ticks) + (colour.label.empty() ? 0 : kLabel.size + 8);
  const Box box = data_box(canvas, panel, map.title, x, y, right);
  draw_title(canvas, box, map.title);
  draw_axes(canvas, box, x, y, false);
  draw_cells(canvas, box, map, x, y, colour);
  canvas.stroke(box, kInk, 1);
  const Box bar{box.x + box.width + 12, box.y, kBar, box.height};
  draw_bar(canvas, bar, true);
  for (const Tick& tick : ticks) {
    const double at = bar.y + (1 - tick.position) * bar.height;
    canvas.line({{bar.x + kBar, at}, {bar.x + kBar + 3, at}}, kInk, 1);
    canvas.text({bar.x + kBar + 6, at + 0.36 * kTickFont.size}, tick.text, kTickFont);
  }
  draw_fitted(canvas, {panel.x + panel.width - 2, bar.y + bar.height / 2}, colour.label, kLabel, bar.height, true);
}

/// One entry for each label, in order of appearance.
std::vector<Line> legend_of(const std::vector<Panel>& panels) {
  std::vector<Line> entries;
  for (const Panel& panel : panels) {
    const auto* plot = std::get_if<LinePlot>(&panel);
    if (plot == nullptr) continue;
    for (const Line& line : plot->lines) {
      const bool known =
          std::any_of(entries.begin(), entries.end(), [&](const Line& e) { return e.label == line.label; });
      if (line.label.empty() || known) continue;
      entries.push_back({line.label, {}, {}, line.colour, line.dashed, line.width, line.marker});
    }
  }
  return entries;
}

constexpr double kLegendGap = 22;
constexpr double kLegendLine = kLabelSize + 6;

double sample_width(const Line& entry) {
  return entry.width > 0 ? 26 : 9;
}

double entry_width(Canvas& canvas, const Line& entry) {
  return sample_width(entry) + 6 + canvas.text_width(entry.label, kLabel) + kLegendGap;
}

/// Entries in lines that are no wider than the page.
std::vector<std::vector<Line>> legend_lines(Canvas& canvas, const std::vector<Line>& entries, double width) {
  std::vector<std::vector<Line>> lines;
  double left = 0;
  for (const Line& entry : entries) {
    const double own = entry_width(canvas, entry);
    if (lines.empty() || own > left) {
      lines.emplace_back();
      left = width + kLegendGap;
    }
    lines.back().push_back(entry);
    left -= own;
  }
  return lines;
}

void draw_legend(Canvas& canvas, Point centre, const std::vector<Line>& entries) {
  double width = -kLegendGap;
  for (const Line& entry : entries) width += entry_width(canvas, entry);
  double x = centre.x - width / 2;
  for (const Line& entry : entries) {
    const double y = centre.y - 0.35 * kLabel.size;
    const double sample = sample_width(entry);
    if (entry.width > 0) canvas.line({{x, y}, {x + sample, y}}, entry.colour, entry.width, entry.dashed);
    canvas.marker({x + sample / 2, y}, entry.marker, entry.colour);
    canvas.text({x + sample + 6, centre.y}, entry.label, kLabel);
    x += entry_width(canvas, entry);
  }
}

void require_grid(const ImageGrid& grid) {
  if (grid.rows.empty() || grid.rows.front().empty()) throw std::invalid_argument("write_grid: no pictures");
  const Bytes& first = grid.rows.front().front().picture;
  for (const auto& row : grid.rows) {
    for (const Tile& tile : row) {
      const Bytes& bytes = tile.picture;
      const auto size = static_cast<std::size_t>(bytes.width) * static_cast<std::size_t>(bytes.height) * 3;
      if (bytes.width != first.width || bytes.height != first.height || bytes.rgb.size() != size) {
        throw std::invalid_argument("write_grid: pictures must all have one size");
      }
    }
    if (!grid.column_labels.empty() && grid.column_labels.size() != row.size()) {
      throw std::invalid_argument("write_grid: every row needs a picture for each of the column labels");
    }
  }
  if (!grid.row_labels.empty() && grid.row_labels.size() != grid.rows.size()) {
    throw std::invalid_argument("write_grid: there must be one row label for each row");
  }
}

double caption_height(const std::vector<Tile>& row) {
  const bool any = std::any_of(row.begin(), row.end(), [](const Tile& tile) { return !tile.caption.empty(); });
  return any ? kTickFont.size + 4 : 0;
}

/// Draws all tiles from a corner and returns the lower end.
double draw_tiles(Canvas& canvas, Point corner, const ImageGrid& grid) {
  const double width = grid.rows.front().front().picture.width;
  const double height = grid.rows.front().front().picture.height;
  const auto left = [&](std::size_t column) { return corner.x + static_cast<double>(column) * (width + kMargin); };
  for (std::size_t c = 0; c < grid.column_labels.size(); ++c) {
    draw_fitted(canvas, {left(c) + width / 2, corner.y - 8}, grid.column_labels[c], kHeading, width);
  }
  double y = corner.y;
  for (std::size_t r = 0; r < grid.rows.size(); ++r) {
    if (!grid.row_labels.empty()) {
      canvas.text({corner.x - 10, y + height / 2}, grid.row_labels[r], kHeading, 0.5, true);
    }
    for (std::size_t c = 0; c < grid.rows[r].size(); ++c) {
      const Tile& tile = grid.rows[r][c];
      canvas.picture({left(c), y}, tile.picture);
      draw_fitted(canvas, {left(c) + width / 2, y + height + kTickFont.size + 3}, tile.caption, kTickFont, width);
    }
    y += height + caption_height(grid.rows[r]) + kMargin;
  }
  return y;
}

}  // namespace

void write_page(const std::filesystem::path& path, const Page& page) {
  if (page.panels.empty() || page.columns < 1) throw std::invalid_argument("write_page: no panels");
  const int columns = std::min(page.columns, static_cast<int>(page.panels.size()));
  const int rows = (static_cast<int>(page.panels.size()) + columns - 1) / columns;
  const double title = height_of(page.title, kTitle);
  const double width = 2 * kMargin + columns * page.panel_width + (columns - 1) * kMargin;
  Canvas ruler(path, 1, 1, 1);  // measures text, is never saved
  const auto legend = legend_lines(ruler, legend_of(page.panels), width - 2 * kMargin);
  const double top = kMargin + title + (legend.empty() ? 0 : static_cast<double>(legend.size()) * kLegendLine + 8);
  Canvas canvas(path, width, top + rows * (page.panel_height + kMargin), 2);
  draw_fitted(canvas, {width / 2, kMargin + kTitle.size}, page.title, kTitle, width - 2 * kMargin);
  double baseline = kMargin + title + kLabel.size + 2;
  for (const std::vector<Line>& line : legend) {
    draw_legend(canvas, {width / 2, baseline}, line);
    baseline += kLegendLine;
  }
  for (std::size_t n = 0; n < page.panels.size(); ++n) {
    const int row = static_cast<int>(n) / columns;
    const int column = static_cast<int>(n) % columns;
    const Box box{kMargin + column * (page.panel_width + kMargin), top + row * (page.panel_height + kMargin),
                  page.panel_width, page.panel_height};
    std::visit([&](const auto& panel) { draw(canvas, box, panel); }, page.panels[n]);
  }
  canvas.save();
}

void write_grid(const std::filesystem::path& path, const ImageGrid& grid) {
  require_grid(grid);
  const Bytes& first = grid.rows.front().front().picture;
  const Point corner{kMargin + (grid.row_labels.empty() ? 0 : kHeading.size + 12),
                     kMargin + height_of(grid.title, kTitle) + (grid.column_labels.empty() ? 0 : kHeading.size + 10)};
  std::size_t columns = 0;
  double height = corner.y;
  for (const auto& row : grid.rows) {
    columns = std::max(columns, row.size());
    height += first.height + caption_height(row) + kMargin;
  }
  if (grid.colour_bar) height += kBar + kTickFont.size + 2 * kLabel.size;
  const double width = corner.x + static_cast<double>(columns) * (first.width + kMargin);
  Canvas canvas(path, width, height, 1);
  draw_fitted(canvas, {width / 2, kMargin + kTitle.size}, grid.title, kTitle, width - 2 * kMargin);
  const double bottom = draw_tiles(canvas, corner, grid);
  if (grid.colour_bar) {
    const double span = std::min(320.0, width - corner.x - kMargin);
    const Box bar{corner.x + (width - corner.x - kMargin - span) / 2, bottom, span, kBar};
    draw_bar(canvas, bar, false);
    for (const Tick& tick : axis_ticks(*grid.colour_bar)) {
      canvas.text({bar.x + tick.position * span, bottom + kBar + kTickFont.size + 3}, tick.text, kTickFont, 0.5);
    }
    canvas.text({bar.x + span / 2, bottom + kBar + kTickFont.size + kLabel.size + 8}, axis_label(*grid.colour_bar),
                kLabel, 0.5);
  }
  canvas.save();
}

}  // namespace sklar::plot
