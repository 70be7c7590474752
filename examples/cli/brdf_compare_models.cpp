#include "examples/cli/brdf_compare_models.hpp"

#include <filesystem>
#include <iostream>

#include "brdf/analytic/not_computable.hpp"
#include "brdf/analytic/registry.hpp"
#include "brdf/study/model_comparison.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/report.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

using Tables = std::vector<std::shared_ptr<const brdf::MeasuredTable>>;

Tables load_tables(const ModelCompareOptions& options) {
  Tables tables;
  if (options.materials.empty()) tables.push_back(load_table(""));
  for (const std::string& material : options.materials) {
    tables.push_back(load_table(material, options.provenance));
    for (std::size_t n = 0; n + 1 < tables.size(); ++n) {
      if (tables[n]->name != tables.back()->name) continue;
      throw FileError(material, "has the name of another material, " + tables[n]->name + "; names must differ");
    }
  }
  return tables;
}

Tables without(Tables tables, std::size_t n) {
  tables.erase(tables.begin() + static_cast<std::ptrdiff_t>(n));
  return tables;
}

/// Why some models that one would look for have no row. @param all not only those that were named.
std::string not_compared(bool all) {
  std::string text = "| not compared | why |\n| --- | --- |\n";
  for (const brdf::AnalyticInfo& info : brdf::analytic::all()) {
    if (!all || info.isotropic_form.empty()) continue;
    text.append("| ").append(info.title).append(" | On isotropic materials, the only ones here, it is ");
    text.append(info.isotropic_form).append(" above. |\n");
  }
  for (const auto& model : brdf::analytic::kNotComputable) {
    text += "| " + std::string(model.name) + " | " + std::string(model.why) + " |\n";
  }
  return text +
         "| Wang, Tran and Luebke 2004; Sun and others 2007 | As reflectance they are separable forms by singular "
         "values, "
         "separable_svd above, and its tensor form over a set of materials; what they add is the relighting of a scene "
         "by "
         "the factors and the editing of materials within the set. |\n";
}

}  // namespace

void compare_models(const ModelCompareOptions& options, bool json) {
  const bool all = options.models == "all";
  const auto contenders =
      all ? brdf::all_contenders(options.budgets) : brdf::find_contenders(split_csv(options.models), options.budgets);
  const Tables tables = load_tables(options);
  const std::filesystem::path folder = options.folder;
  const StepLine steps;
  std::vector<brdf::ModelRow> rows;
  std::vector<brdf::ModelComparison> comparisons;
  std::vector<std::filesystem::path> files;
  for (std::size_t n = 0; n < tables.size(); ++n) {
    const Tables others = without(tables, n);
    comparisons.push_back(brdf::compare_models({.table = tables[n], .others = others}, contenders, folder,
                                               [&](const auto& what) { steps.show(what); }));
    const brdf::ModelComparison& comparison = comparisons.back();
    rows.insert(rows.end(), comparison.rows.begin(), comparison.rows.end());
    files.push_back(brdf::write_model_sheet(comparison, folder));
    write_file(folder / "models.json", to_json(rows));
    write_file(folder / "models.csv", to_csv(rows));
    write_file(folder / "models.md", to_markdown(rows) + "\n" + summary_markdown(rows) + "\n" + not_compared(all));
  }
  write_report(folder, rows, comparisons);
  if (json) {
    std::cout << to_json(rows);
    return;
  }
  std::cout << summary_markdown(rows) << '\n';
  for (const brdf::ModelRow& row : rows) {
    if (!row.error.empty()) std::cout << row.material << ", " << row.model << ": " << row.error << '\n';
  }
  for (const char* name : {"models.json", "models.csv", "models.md", "report.html"}) files.push_back(folder / name);
  for (const auto& file : files) {
    if (!file.empty()) std::cout << file.string() << '\n';
  }
}

}  // namespace sklar::cli
