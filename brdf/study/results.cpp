#include "brdf/study/results.hpp"

#include <cmath>
#include <fstream>
#include <thread>

#include "brdf/study/table_text.hpp"
#include "copula/json_fields.hpp"

namespace sklar::brdf {

namespace {

using json::Json;

struct Figure {
  const char* name;
  const char* heading;
  const char* format;  // of the Markdown table
  double CompareRow::*value;
};

constexpr std::array<Figure, 8> kFigures = {{
    {"fit_s", "fit s", "%.1f", &CompareRow::fit_s},
    {"eval_ns", "ns/eval", "%.0f", &CompareRow::eval_ns},
    {"log1p_mae", "log1p_mae", "%.4f", &CompareRow::log1p_mae},
    {"logrel_mae", "logrel_mae", "%.4f", &CompareRow::logrel_mae},
    {"cuberoot_rms", "cuberoot_rms", "%.4f", &CompareRow::cuberoot_rms},
    {"rel_l2", "rel_l2", "%.4f", &CompareRow::rel_l2},
    {"sphere_psnr_linear_db", "sphere dB", "%.1f", &CompareRow::sphere_psnr_linear_db},
    {"albedo_max", "albedo max", "%.3f", &CompareRow::albedo_max},
}};

Json row_to_json(const CompareRow& row) {
  Json json = {{"material", row.material}, {"provenance", to_text(row.provenance)},
               {"model", row.model},       {"family", row.family},
               {"mode", row.mode},         {"bytes", row.bytes}};
  for (const Figure& figure : kFigures) json[figure.name] = row.*figure.value;
  json["theta"] = row.theta;
  if (!row.error.empty()) json["error"] = row.error;
  return json;
}

std::string theta_to_csv(const CompareRow& row) {
  std::string text;
  for (std::size_t channel = 0; channel < row.theta.size(); ++channel) {
    if (channel > 0) text += '|';
    for (std::size_t slice = 0; slice < row.theta[channel].size(); ++slice) {
      if (slice > 0) text += ';';
      const Theta& theta = row.theta[channel][slice];
      for (std::size_t i = 0; i < theta.size(); ++i) text += (i > 0 ? " " : "") + sklar::to_text(theta[i]);
    }
  }
  return text;
}

}  // namespace

std::string machine_name() {
  std::ifstream file("/proc/cpuinfo");
  std::string name = "unknown processor";
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos) {
      name = line.substr(line.find(": ") + 2);
      break;
    }
  }
  return name + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads";
}

std::string to_json(std::span<const CompareRow> rows) {
  Json json = {{"version", 1}, {"machine", machine_name()}, {"rows", Json::array()}};
  for (const CompareRow& row : rows) json["rows"].push_back(row_to_json(row));
  return json.dump(1) + "\n";
}

std::string to_csv(std::span<const CompareRow> rows) {
  std::string text = "material,provenance,model,family,mode,bytes";
  for (const Figure& figure : kFigures) text += std::string(",") + figure.name;
  text += ",theta,error\n";
  for (const CompareRow& row : rows) {
    text += csv_field(row.material) + "," + to_text(row.provenance) + "," + row.model + "," + csv_field(row.family) +
            "," + row.mode + "," + std::to_string(row.bytes);
    for (const Figure& figure : kFigures) text += "," + printed("%.17g", row.*figure.value);
    text += "," + theta_to_csv(row) + "," + csv_field(row.error) + "\n";
  }
  return text;
}

std::string to_markdown(std::span<const CompareRow> rows) {
  std::vector<std::vector<std::string>> lines = {{"material", "family", "mode", "bytes"}};
  for (const Figure& figure : kFigures) lines[0].emplace_back(figure.heading);
  for (const CompareRow& row : rows) {
    auto& line =
        lines.emplace_back(std::vector<std::string>{row.material, row.family, row.mode, std::to_string(row.bytes)});
    for (const Figure& figure : kFigures) line.push_back(printed(figure.format, row.*figure.value));
  }
  std::vector<std::size_t> widths(lines[0].size());
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    text += "|";
    for (std::size_t i = 0; i < widths.size(); ++i) {
      const std::string padding(widths[i] - lines[n][i].size(), ' ');
      text += i < 3 ? " " + lines[n][i] + padding + " |" : " " + padding + lines[n][i] + " |";
    }
    text += "\n";
    if (n > 0) continue;
    text += "|";
    for (std::size_t i = 0; i < widths.size(); ++i) {
      text += i < 3 ? " " + std::string(widths[i], '-') + " |" : " " + std::string(widths[i] - 1, '-') + ": |";
    }
    text += "\n";
  }
  return text;
}

}  // namespace sklar::brdf
