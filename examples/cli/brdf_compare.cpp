#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include "brdf/study/efficiency.hpp"
#include "brdf/study/results.hpp"
#include "copula/file.hpp"
#include "examples/cli/brdf_compare_models.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/fit_options.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/report.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

constexpr double kUsualBytes = 1024;

struct Options {
  std::vector<std::string> materials;
  std::string families = "all";
  FitOptions fit;
  std::string folder = "out";
  std::string models;  // empty: families
  std::vector<double> budgets = {1024, 4096, 16384};
};

// The results so far, so that an interrupted run keeps what is finished.
void write_results(const std::filesystem::path& folder, const std::vector<brdf::CompareRow>& rows) {
  write_file(folder / "results.json", to_json(rows));
  write_file(folder / "results.csv", to_csv(rows));
  write_file(folder / "results.md", to_markdown(rows));
}

/// In refined mode the largest structure of the ladder within --max-bytes, for every family.
std::vector<brdf::FamilyFitOptions> modes(const FitOptions& options) {
  std::vector<brdf::FamilyFitOptions> result;
  if (options.is_paper()) result.emplace_back(options.paper);
  if (!options.is_refined()) return result;
  brdf::RefinedFitOptions refined = options.refined;
  const double most = std::isinf(options.budget.max_bytes) ? kUsualBytes : options.budget.max_bytes;
  refined.bits = options.bits.value_or(brdf::kLadderBits);
  refined.structure = brdf::largest_structure(most, refined.bits);
  result.emplace_back(refined);
  return result;
}

void run(const Options& options, bool json) {
  const auto families = parse_families(options.families);
  const int dimension = options.fit.is_paper() ? brdf::kPaperDimension : 2;
  for (const FamilyInfo* family : families) family->require_dimension(dimension);
  std::vector<std::string> materials = options.materials;
  if (materials.empty()) materials.emplace_back();
  std::vector<brdf::CompareRow> rows;
  std::vector<brdf::Comparison> comparisons;
  std::vector<brdf::SamplerEfficiency> samplers;
  std::vector<std::filesystem::path> files;
  const StepLine steps;
  for (const std::string& material : materials) {
    const auto table = load_table(material, options.fit.provenance);
    make_folder(options.folder);  // a refused material leaves none
    brdf::Comparison comparison = brdf::compare_families(table, families, modes(options.fit), options.folder,
                                                         [&](const auto& what) { steps.show(what); });
    rows.insert(rows.end(), comparison.rows.begin(), comparison.rows.end());
    files.insert(files.end(), comparison.figures.begin(), comparison.figures.end());
    write_results(options.folder, rows);
    comparisons.push_back(std::move(comparison));
    steps.show(table->name + ": samplers");
    const auto measured = sampling_efficiency(table->name, std::make_shared<const brdf::TableBrdf>(table));
    samplers.insert(samplers.end(), measured.begin(), measured.end());
    write_file(std::filesystem::path(options.folder) / "efficiency.csv", efficiency_csv(samplers));
  }
  if (comparisons.size() > 1) {
    const auto sheets = brdf::write_sphere_sheets(comparisons, options.folder);
    files.insert(files.end(), sheets.begin(), sheets.end());
  }
  write_report(options.folder, rows, comparisons);
  if (json) {
    std::cout << to_json(rows);
    return;
  }
  std::cout << to_markdown(rows) << '\n';
  for (const brdf::CompareRow& row : rows) {
    if (!row.error.empty()) std::cout << row.material << ", " << row.family << ": " << row.error << '\n';
  }
  std::cout << "Relative standard deviation of one sample in a white furnace, by theta_o in degrees:\n\n"
            << efficiency_markdown(samplers) << '\n';
  for (const char* name : {"results.json", "results.csv", "results.md", "efficiency.csv", "report.html"}) {
    files.push_back(std::filesystem::path(options.folder) / name);
  }
  for (const auto& file : files) std::cout << file.string() << '\n';
}

}  // namespace

void add_brdf_compare(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("compare", "fit, measure and draw families on materials");
  const auto options = std::make_shared<Options>();
  command->add_option("MATERIAL", options->materials,
                      "isotropic material files (.binary, .bsdf); omitted: the built-in material");
  command->add_option("--families", options->families, kFamiliesHelp)->capture_default_str();
  command->add_option("--out", options->folder, "folder for tables and pictures")->capture_default_str();
  command->add_option("--models", options->models,
                      "compare models of every kind instead of families: all, or names with commas");
  command->add_option("--budgets", options->budgets, "with --models: sizes in bytes of those that come in any size")
      ->delimiter(',')
      ->capture_default_str();
  add_fit_options(*command, options->fit, {"paper", "refined", "both"});
  finish_command(*command, common, [command, options, &common] {
    settle_fit_options(*command, options->fit);
    if (options->models.empty()) return run(*options, common.json);
    compare_models({.materials = options->materials,
                    .models = options->models,
                    .budgets = options->budgets,
                    .folder = options->folder,
                    .provenance = options->fit.provenance},
                   common.json);
  });
}

}  // namespace sklar::cli
