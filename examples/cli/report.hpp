#pragma once
/// The page of a comparison.

#include <filesystem>
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

}  // namespace sklar::cli
