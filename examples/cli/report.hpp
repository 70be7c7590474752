#pragma once
/// Pages for a browser.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/study/report.hpp"
#include "copula/file.hpp"

namespace sklar::cli {

/// Writes FOLDER/report.html of the rows of all comparisons, each of one material. @throws FileError
template <class Row, class Comparison>
void write_report(const std::filesystem::path& folder, const std::vector<Row>& rows,
                  const std::vector<Comparison>& comparisons) {
  std::vector<brdf::ReportMaterial> materials;
  for (const Comparison& comparison : comparisons) {
    const Row& first = comparison.rows.front();
    materials.push_back({first.material, first.provenance, comparison.reference, comparison.reference_curves,
                         comparison.spheres, comparison.curves});
  }
  write_file(folder / "report.html", brdf::report_page(to_json(rows), materials));
}

/// A page of error against cost. @param kind a name in brdf/study/report/cost_kinds.js. @param document what the
/// command prints with --json. @throws FileError
void write_cost_report(const std::string& path, std::string_view title, std::string_view kind,
                       nlohmann::ordered_json document);

}  // namespace sklar::cli
