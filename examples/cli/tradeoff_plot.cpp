#include "examples/cli/tradeoff_plot.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace sklar::cli {
namespace {

using plot::Axis;
using plot::Line;
using plot::LinePlot;
using plot::Marker;
using plot::Scale;

constexpr Marker kMarkers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond};
constexpr plot::Colour kInk{0.13, 0.13, 0.13};

/// The different values of a member, in order of appearance.
std::vector<std::string> names(std::span<const TradeoffRow> rows, std::string TradeoffRow::*member) {
  std::vector<std::string> all;
  for (const TradeoffRow& row : rows) {
    if (std::find(all.begin(), all.end(), row.*member) == all.end()) all.push_back(row.*member);
  }
  return all;
}

/// A family's colour in the legend, its faint path from level to level, and its markers with their lines.
struct FamilyLines {
  Line entry, path;
  std::vector<Line> spans, markers;
};

FamilyLines family_lines(std::span<const TradeoffRow> rows, const std::vector<std::string>& levels,
                         const plot::Colour& colour) {
  constexpr double kFaint = 0.4;
  const auto faint = [](double channel) { return 1 - kFaint * (1 - channel); };
  FamilyLines lines;
  lines.entry = {.label = rows.front().family, .colour = colour, .width = 4};
  lines.path = {.colour = {faint(colour.red), faint(colour.green), faint(colour.blue)}, .width = 1};
  for (const TradeoffRow& row : rows) {
    const auto level = std::find(levels.begin(), levels.end(), row.level) - levels.begin();
    lines.path.x.push_back(row.ns);
    lines.path.y.push_back(row.errors.maximum);
    lines.spans.push_back({.x = {row.ns, row.ns}, .y = {row.errors.median, row.errors.maximum}, .colour = colour});
    lines.markers.push_back({.x = {row.ns},
                             .y = {row.errors.maximum},
                             .colour = colour,
                             .width = 0,
                             .marker = kMarkers[static_cast<std::size_t>(level) % std::size(kMarkers)]});
  }
  return lines;
}

LinePlot panel(std::span<const TradeoffRow> rows, const std::string& quantity, const Axis& x, const Axis& y) {
  LinePlot plot{.title = quantity, .x = x, .y = y};
  const std::vector<std::string> families = names(rows, &TradeoffRow::family);
  const std::vector<std::string> levels = names(rows, &TradeoffRow::level);
  std::vector<Line> above;  // drawn over all paths
  for (std::size_t f = 0; f < families.size(); ++f) {
    std::vector<TradeoffRow> own;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(own),
                 [&](const TradeoffRow& row) { return row.family == families[f] && row.quantity == quantity; });
    FamilyLines lines = family_lines(own, levels, plot::series_colour(f));
    plot.lines.push_back(std::move(lines.entry));
    plot.lines.push_back(std::move(lines.path));
    above.insert(above.end(), lines.spans.begin(), lines.spans.end());
    above.insert(above.end(), lines.markers.begin(), lines.markers.end());
  }
  plot.lines.insert(plot.lines.end(), above.begin(), above.end());
  for (std::size_t l = 0; l < levels.size(); ++l) {
    plot.lines.push_back({.label = levels[l], .colour = kInk, .width = 0, .marker = kMarkers[l % std::size(kMarkers)]});
  }
  return plot;
}

}  // namespace

plot::Page tradeoff_page(std::span<const TradeoffRow> rows, const std::string& title) {
  std::vector<TradeoffRow> shown;
  std::vector<double> ns, errors;
  for (const TradeoffRow& row : rows) {
    if (row.theta.empty()) continue;
    shown.push_back(row);
    ns.push_back(row.ns);
    errors.insert(errors.end(), {row.errors.maximum, row.errors.median});
  }
  Axis x = plot::fitted({.label = "ns a row", .scale = Scale::logarithmic}, ns);
  Axis y = plot::fitted({.label = "error: the largest, down to the median", .scale = Scale::digits}, errors);
  x.low /= 2;  // room for the markers
  x.high *= 2;
  y.low = std::pow(y.low, 1.1);
  y.high = std::pow(y.high, 0.9);
  plot::Page page{.title = title, .panel_width = 340, .panel_height = 380};
  for (const std::string& quantity : names(shown, &TradeoffRow::quantity)) {
    page.panels.emplace_back(panel(shown, quantity, x, y));
  }
  return page;
}

}  // namespace sklar::cli
