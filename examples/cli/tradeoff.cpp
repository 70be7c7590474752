#include "copula/study/tradeoff.hpp"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "brdf/study/results.hpp"
#include "copula/error.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/text.hpp"
#include "examples/cli/tradeoff_plot.hpp"

namespace sklar::cli {
namespace {

struct Options {
  std::string families = "all";
  TradeoffOptions measure;
  std::string csv;
  std::string picture;
};

std::string rounded(const char* format, double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string table_of(const std::vector<TradeoffRow>& rows) {
  std::vector<Cells> cells{{"family", "quantity", "accuracy", "ns a row", "median error", "largest error"}};
  for (const TradeoffRow& row : rows) {
    cells.push_back({row.family, row.quantity, row.level, rounded(row.ns < 100 ? "%.1f" : "%.0f", row.ns),
                     rounded("%.1e", row.errors.median), rounded("%.1e", row.errors.maximum)});
  }
  return aligned(cells);
}

std::string csv_of(const std::vector<TradeoffRow>& rows, int dim) {
  std::string out = "family,theta,d,quantity,accuracy,ns,median_error,max_error\n";
  for (const TradeoffRow& row : rows) {
    out += csv_field(row.family) + ',' + digits(row.theta) + ',' + std::to_string(dim) + ',' + row.quantity + ',' +
           row.level + ',' + digits(row.ns) + ',' + digits(row.errors.median) + ',' + digits(row.errors.maximum) + '\n';
  }
  return out;
}

nlohmann::ordered_json json_of(const std::vector<TradeoffRow>& rows, const TradeoffOptions& options) {
  nlohmann::ordered_json document{
      {"version", 1}, {"machine", brdf::machine_name()}, {"n", options.rows}, {"seed", options.seed}};
  for (const TradeoffRow& row : rows) {
    document["rows"].push_back({{"family", row.family},
                                {"theta", json_numbers(row.theta)},
                                {"d", options.dim},
                                {"quantity", row.quantity},
                                {"accuracy", row.level},
                                {"ns", row.ns},
                                {"median_error", json_number(row.errors.median)},
                                {"max_error", json_number(row.errors.maximum)}});
  }
  return document;
}

/// What would be found out only after all the measuring. @throws FileError
void require_folder(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) throw FileError(path, "its folder does not exist");
}

/// @throws FileError, std::invalid_argument
void require_picture(const std::string& path) {
  require_folder(path);
  const std::string ending = std::filesystem::path(path).extension().string();
  if (!path.empty() && ending != ".png" && ending != ".svg") {
    throw std::invalid_argument(path + ": a plot must end in .png or .svg");
  }
}

void run(Options options, const Common& common) {
  options.measure.seed = common.seed;
  const std::vector<const FamilyInfo*> families = parse_families(options.families);
  for (const FamilyInfo* family : families) family->require_dimension(options.measure.dim);
  require_folder(options.csv);
  require_picture(options.picture);
  std::vector<TradeoffRow> rows;
  {
    const StepLine steps;
    for (const FamilyInfo* family : families) {
      steps.show(family->name);
      const std::vector<TradeoffRow> more = measure_tradeoff(*family, options.measure);
      rows.insert(rows.end(), more.begin(), more.end());
    }
  }
  if (!options.csv.empty()) write_output(options.csv, csv_of(rows, options.measure.dim));
  if (!options.picture.empty()) {
    const std::string title = "Speed and accuracy, d = " + std::to_string(options.measure.dim);
    brdf::write_page(options.picture, tradeoff_page(rows, title));
  }
  if (common.json) return print_json(json_of(rows, options.measure));
  write_output("", table_of(rows));
}

}  // namespace

void add_tradeoff(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand(
      "tradeoff", "measure time and error of every family, quantity and level of accuracy, on one thread");
  const auto options = std::make_shared<Options>();
  command->add_option("--families", options->families, kFamiliesHelp)->capture_default_str();
  command->add_option("--dim", options->measure.dim, "dimension")->capture_default_str();
  command->add_option("--rows", options->measure.rows, "points drawn from each copula")->capture_default_str();
  command->add_option("--csv", options->csv, "write the figures here too");
  command->add_option("-o", options->picture, "draw them here, a .png or .svg");
  finish_command(*command, common, [options, &common] { run(*options, common); });
}

}  // namespace sklar::cli
