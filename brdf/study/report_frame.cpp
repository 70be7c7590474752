#include "brdf/study/report_frame.hpp"

#include "brdf/study/report_files.hpp"
#include "copula/json_fields.hpp"

namespace sklar::brdf {
namespace {

/// JSON in which no "</script>" or "<!--" can stand.
std::string embedded(std::string_view json) {
  std::string text;
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

std::string filled(std::string page, std::string_view marker, std::string_view text) {
  return page.replace(page.find(marker), marker.size(), text);
}

struct Parts {
  std::string body;
  std::string_view scripts;
};

Parts parts_of(ReportKind kind) {
  switch (kind) {
    case ReportKind::comparison:
      return {filled(std::string(report::compare_html()), "/*sphere*/", report::sphere_glsl()),
              report::compare_scripts()};
    case ReportKind::fit:
      return {std::string(report::fit_html()), report::fit_scripts()};
    case ReportKind::cost:
      return {std::string(report::cost_html()), report::cost_scripts()};
  }
  throw std::logic_error("report_file: no such kind of page");
}

}  // namespace

std::string report_file(ReportKind kind, std::string_view title, std::string_view data) {
  if (!json::Json::accept(data)) throw std::invalid_argument("report_file: the data is no JSON");
  const Parts parts = parts_of(kind);
  std::string page(report::frame_html());
  page = filled(std::move(page), "/*title*/", title);
  page = filled(std::move(page), "/*title*/", title);
  page = filled(std::move(page), "/*style*/", report::page_css());
  page = filled(std::move(page), "/*body*/", filled(parts.body, "/*table*/", report::table_html()));
  page = filled(std::move(page), "/*scripts*/", std::string(report::scripts()) + std::string(parts.scripts));
  return filled(std::move(page), "{\"data\": null}", embedded(data));  // the last, since it may hold any text
}

}  // namespace sklar::brdf
