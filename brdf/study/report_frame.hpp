#pragma once
/// What all pages that a browser shows without a network have in common.

#include <string>
#include <string_view>

namespace sklar::brdf {

/// What a page is of: its sections and scripts.
enum class ReportKind {
  comparison,  ///< see report_page
  fit,         ///< copula families fitted to data
  cost         ///< error against cost: what `sklar tradeoff --json` prints and "kind", a name in report/cost_kinds.js
};

/// The page: style, scripts and data in one file, which loads nothing.
/// @param title HTML. @param data a JSON document, as the scripts of the kind read it.
/// @throws std::invalid_argument for data that is no JSON.
[[nodiscard]] std::string report_file(ReportKind kind, std::string_view title, std::string_view data);

}  // namespace sklar::brdf
