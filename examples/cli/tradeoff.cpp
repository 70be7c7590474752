#include "copula/study/tradeoff.hpp"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "brdf/model/paper_brdf.hpp"
#include "brdf/study/results.hpp"
#include "copula/error.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/report.hpp"
#include "examples/cli/text.hpp"
#include "examples/cli/tradeoff_brdf.hpp"
#include "examples/cli/tradeoff_plot.hpp"

namespace sklar::cli {
namespace {

/// Of the copulas: all; of the models, each of which is fitted a dozen times, two.
constexpr const char* kModelFamilies = "independence,frank";

struct Options {
  std::string families;
  TradeoffOptions measure;
  bool models = false;
  std::string material;
  std::vector<int> slices = brdf::ModelTradeoffOptions().slices;
  double max_bytes = std::numeric_limits<double>::infinity();
  std::string csv;
  std::string picture;
  std::string report;
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

/// Of a material: what its models cost and how near they come.
void run_models(const Options& options, bool json) {
  const std::vector<const FamilyInfo*> families =
      parse_families(options.families.empty() ? kModelFamilies : options.families);
  for (const FamilyInfo* family : families) family->require_dimension(brdf::kPaperDimension);
  brdf::ModelTradeoffOptions measure{.slices = options.slices};
  std::erase_if(measure.ladder, [&](const brdf::RefinedStructure& structure) {
    return static_cast<double>(brdf::stored_bytes(structure, measure.refined.bits, true)) > options.max_bytes;
  });
  const auto table = load_table(options.material);
  std::vector<brdf::ModelTradeoffRow> rows;
  {
    const StepLine steps;
    rows = brdf::measure_model_tradeoff(*table, families, measure, [&](const auto& what) { steps.show(what); });
  }
  if (!options.csv.empty()) write_output(options.csv, to_csv(rows, table->name));
  if (!options.picture.empty()) plot::write_page(options.picture, to_page(rows, table->name));
  if (!options.report.empty()) {
    write_cost_report(options.report, "Models: error against cost", "models", to_json(rows, table->name));
  }
  if (json) return print_json(to_json(rows, table->name));
  write_output("", to_table(rows));
}

void run(Options options, const Common& common) {
  require_folder(options.csv);
  require_folder(options.report);
  require_picture(options.picture);
  if (options.models) return run_models(options, common.json);
  options.measure.seed = common.seed;
  const std::vector<const FamilyInfo*> families = parse_families(options.families.empty() ? "all" : options.families);
  for (const FamilyInfo* family : families) family->require_dimension(options.measure.dim);
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
    plot::write_page(options.picture, tradeoff_page(rows, title));
  }
  if (!options.report.empty()) {
    write_cost_report(options.report, "Copulas: error against cost", "copulas", json_of(rows, options.measure));
  }
  if (common.json) return print_json(json_of(rows, options.measure));
  write_output("", table_of(rows));
}

}  // namespace

void add_tradeoff(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand(
      "tradeoff",
      "measure time and error: of every family, quantity and level of accuracy, or with --brdf of the models of a "
      "material");
  const auto options = std::make_shared<Options>();
  CLI::Option* material =
      command
          ->add_option("--brdf", options->material,
                       "the models of this material, paper and refined, from small to large; without a name the "
                       "built-in one")
          ->expected(0, 1);
  command->add_option("--families", options->families, kFamiliesHelp)
      ->default_str(std::string("all, with --brdf ") + kModelFamilies);
  command->add_option("--slices", options->slices, "theta_d slices of the paper's models, divisors of 90")
      ->delimiter(',')
      ->needs(material)
      ->capture_default_str();
  command->add_option("--max-bytes", options->max_bytes, "bytes of a refined model, at most")->needs(material);
  command->add_option("--dim", options->measure.dim, "dimension")->excludes(material)->capture_default_str();
  command->add_option("--rows", options->measure.rows, "points drawn from each copula")
      ->excludes(material)
      ->capture_default_str();
  command->add_option("--csv", options->csv, "write the figures here too");
  command->add_option("-o", options->picture, "draw them here, a .png or .svg");
  command->add_option("--report", options->report, "write a page for a browser here, with table and plot");
  finish_command(*command, common, [options, material, &common] {
    options->models = material->count() > 0;
    run(*options, common);
  });
}

}  // namespace sklar::cli
