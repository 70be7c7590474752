#include "examples/cli/tradeoff_brdf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "brdf/study/results.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

using Row = brdf::ModelTradeoffRow;

struct Figure {
  const char* name;
  const char* heading;
  const char* format;
  double Row::*value;
};

constexpr std::array<Figure, 5> kFigures = {{{"batch_ns", "ns in a batch", "%.0f", &Row::batch_ns},
                                             {"single_ns", "ns alone", "%.0f", &Row::single_ns},
                                             {"fit_s", "fit s", "%.1f", &Row::fit_s},
                                             {"log1p_mae", "log1p_mae", "%.5f", &Row::log1p_mae},
                                             {"logrel_mae", "logrel_mae", "%.4f", &Row::logrel_mae}}};

std::string printed(const char* format, double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string best_for(const Row& row) {
  if (row.best_for_bytes && row.best_for_ns) return "bytes, ns";
  return row.best_for_bytes ? "bytes" : row.best_for_ns ? "ns" : "";
}

/// What a panel plots the error against.
struct Cost {
  const char* label;
  bool Row::*best;
  double (*value)(const Row&);
};

constexpr std::array<Cost, 2> kCosts = {
    {{"bytes", &Row::best_for_bytes, [](const Row& row) { return static_cast<double>(row.bytes); }},
     {"ns an RGB value, in a batch", &Row::best_for_ns, [](const Row& row) { return row.batch_ns; }}}};

void add_point(plot::Line& line, const Row& row, const Cost& cost) {
  line.x.push_back(cost.value(row));
  line.y.push_back(row.log1p_mae);
}

/// The models of each family and mode, in order.
std::vector<plot::Line> series(std::span<const Row> rows, const Cost& cost) {
  std::vector<plot::Line> lines;
  std::vector<std::string> families;
  for (const Row& row : rows) {
    if (!row.error.empty()) continue;
    const std::string label = row.mode + ", " + row.family;
    const auto line = std::ranges::find(lines, label, &plot::Line::label);
    if (line != lines.end()) {
      add_point(*line, row, cost);
      continue;
    }
    const auto family = std::ranges::find(families, row.family);
    const auto colour = plot::series_colour(static_cast<std::size_t>(family - families.begin()));
    if (family == families.end()) families.push_back(row.family);
    const bool paper = row.mode == "paper";
    lines.push_back({.label = label,
                     .colour = colour,
                     .dashed = paper,
                     .width = 1.2,
                     .marker = paper ? plot::Marker::square : plot::Marker::circle});
    add_point(lines.back(), row, cost);
  }
  return lines;
}

plot::LinePlot panel(std::span<const Row> rows, const Cost& cost) {
  std::vector<Row> best;
  std::vector<double> x, y;
  for (const Row& row : rows) {
    if (!row.error.empty()) continue;
    if (row.*cost.best) best.push_back(row);
    x.push_back(cost.value(row));
    y.push_back(row.log1p_mae);
  }
  std::ranges::sort(best, {}, cost.value);
  plot::Line front{.label = "best for its cost", .width = 2.2, .marker = plot::Marker::diamond};
  for (const Row& row : best) add_point(front, row, cost);
  plot::LinePlot plot{.title = std::string("log1p_mae against ") + cost.label,
                      .x = plot::fitted({.label = cost.label, .scale = plot::Scale::logarithmic}, x),
                      .y = plot::fitted({.label = "log1p_mae", .scale = plot::Scale::logarithmic}, y),
                      .lines = series(rows, cost)};
  for (plot::Axis* axis : {&plot.x, &plot.y}) {  // room for the markers
    axis->low /= 1.3;
    axis->high *= 1.3;
  }
  plot.lines.push_back(std::move(front));
  return plot;
}

}  // namespace

std::string to_table(std::span<const Row> rows) {
  std::vector<Cells> cells{{"mode", "family", "structure", "bytes"}};
  for (const Figure& figure : kFigures) cells[0].emplace_back(figure.heading);
  cells[0].emplace_back("best for");
  for (const Row& row : rows) {
    Cells& line = cells.emplace_back(Cells{row.mode, row.family, row.structure, std::to_string(row.bytes)});
    for (const Figure& figure : kFigures) line.push_back(printed(figure.format, row.*figure.value));
    line.push_back(row.error.empty() ? best_for(row) : row.error);
  }
  return aligned(cells);
}

std::string to_csv(std::span<const Row> rows, const std::string& material) {
  std::string text = "material,mode,family,structure,bytes";
  for (const Figure& figure : kFigures) text += std::string(",") + figure.name;
  text += ",best_for_bytes,best_for_ns,error\n";
  for (const Row& row : rows) {
    text += csv_field(material) + ',' + row.mode + ',' + csv_field(row.family) + ',' + csv_field(row.structure) + ',' +
            std::to_string(row.bytes);
    for (const Figure& figure : kFigures) text += ',' + digits(row.*figure.value);
    text += std::string(row.best_for_bytes ? ",1" : ",0") + (row.best_for_ns ? ",1," : ",0,") + csv_field(row.error);
    text += '\n';
  }
  return text;
}

nlohmann::ordered_json to_json(std::span<const Row> rows, const std::string& material) {
  nlohmann::ordered_json document{{"version", 1}, {"machine", brdf::machine_name()}, {"material", material}};
  for (const Row& row : rows) {
    nlohmann::ordered_json entry{
        {"mode", row.mode}, {"family", row.family}, {"structure", row.structure}, {"bytes", row.bytes}};
    for (const Figure& figure : kFigures) entry[figure.name] = json_number(row.*figure.value);
    entry["best_for_bytes"] = row.best_for_bytes;
    entry["best_for_ns"] = row.best_for_ns;
    if (!row.error.empty()) entry["error"] = row.error;
    document["rows"].push_back(std::move(entry));
  }
  return document;
}

plot::Page to_page(std::span<const Row> rows, const std::string& material) {
  plot::Page page{.title = "Models of " + material, .panel_width = 460, .panel_height = 380};
  for (const Cost& cost : kCosts) page.panels.emplace_back(panel(rows, cost));
  return page;
}

}  // namespace sklar::cli
