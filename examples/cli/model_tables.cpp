#include "examples/cli/model_tables.hpp"

#include <iostream>

#include "brdf/analytic/not_computable.hpp"
#include "brdf/analytic/registry.hpp"
#include "copula/file.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

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

std::vector<brdf::Contender> parse_contenders(const std::string& models, const std::vector<double>& budgets) {
  return models == kAllModels ? brdf::all_contenders(budgets) : brdf::find_contenders(split_csv(models), budgets);
}

std::vector<std::filesystem::path> write_model_tables(const std::filesystem::path& folder,
                                                      const std::vector<brdf::ModelRow>& rows, bool all) {
  const std::vector<std::filesystem::path> paths = {folder / "models.json", folder / "models.csv",
                                                    folder / "models.md"};
  write_file(paths[0], to_json(rows));
  write_file(paths[1], to_csv(rows));
  write_file(paths[2], to_markdown(rows) + "\n" + summary_markdown(rows) + "\n" + not_compared(all));
  return paths;
}

void print_models(const std::vector<brdf::ModelRow>& rows) {
  std::cout << summary_markdown(rows) << '\n';
  for (const brdf::ModelRow& row : rows) {
    if (!row.error.empty()) std::cout << row.material << ", " << row.model << ": " << row.error << '\n';
  }
}

}  // namespace sklar::cli
