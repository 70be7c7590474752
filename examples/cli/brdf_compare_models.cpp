#include "examples/cli/brdf_compare_models.hpp"

#include <filesystem>
#include <iostream>

#include "brdf/study/model_comparison.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/model_tables.hpp"
#include "examples/cli/report.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

/// Materials, and what tells each from another of its name.
struct Materials {
  std::vector<std::shared_ptr<const brdf::MeasuredTable>> tables = {};
  std::vector<std::string> inputs = {};
};

Materials load_materials(const ModelCompareOptions& options) {
  const std::vector<std::string> builtin = {""};
  Materials materials;
  for (const std::string& path : options.materials.empty() ? builtin : options.materials) {
    const auto table = load_table(path, options.provenance);
    for (const auto& other : materials.tables) {
      if (table->name != other->name) continue;
      throw FileError(path, "has the name of another material, " + table->name + "; names must differ");
    }
    materials.tables.push_back(table);
    materials.inputs.push_back(inputs_of(path, options.provenance));
  }
  return materials;
}

template <class Value>
std::vector<Value> without(std::vector<Value> all, std::size_t n) {
  all.erase(all.begin() + static_cast<std::ptrdiff_t>(n));
  return all;
}

}  // namespace

void compare_models(const ModelCompareOptions& options, bool json) {
  const auto contenders = parse_contenders(options.models, options.budgets);
  const Materials materials = load_materials(options);
  const std::filesystem::path folder = options.folder;
  const StepLine steps;
  std::vector<brdf::ModelRow> rows;
  std::vector<brdf::ModelComparison> comparisons;
  std::vector<std::filesystem::path> files, tables;
  for (std::size_t n = 0; n < materials.tables.size(); ++n) {
    const auto others = without(materials.tables, n);
    std::string inputs_of_others;
    for (const std::string& inputs : without(materials.inputs, n)) inputs_of_others += inputs + "; ";
    comparisons.push_back(brdf::compare_models({.table = materials.tables[n],
                                                .others = others,
                                                .inputs = materials.inputs[n],
                                                .inputs_of_others = inputs_of_others},
                                               contenders, folder, [&](const auto& what) { steps.show(what); }));
    const brdf::ModelComparison& comparison = comparisons.back();
    rows.insert(rows.end(), comparison.rows.begin(), comparison.rows.end());
    files.push_back(brdf::write_model_sheet(comparison, folder));
    tables = write_model_tables(folder, rows, options.models == kAllModels);
  }
  write_report(folder, rows, comparisons);
  if (json) {
    std::cout << to_json(rows);
    return;
  }
  print_models(rows);
  files.insert(files.end(), tables.begin(), tables.end());
  files.push_back(folder / "report.html");
  for (const auto& file : files) {
    if (!file.empty()) std::cout << file.string() << '\n';
  }
}

}  // namespace sklar::cli
