#include "examples/cli/report.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "brdf/study/report_frame.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {

void write_cost_report(const std::string& path, std::string_view title, std::string_view kind,
                       nlohmann::ordered_json document) {
  document["kind"] = kind;
  write_output(path, brdf::report_file(brdf::ReportKind::cost, title, document.dump()));
}

}  // namespace sklar::cli
