#pragma once
/// The rows of a comparison as files and as a table to read.

#include <span>
#include <string>

#include "brdf/study/compare.hpp"

namespace sklar::brdf {

/// {"version": 1, "machine": .., "rows": [..]} with the names of CompareRow; theta as [channel][slice][parameter]; null
/// for NaN; "error" where there is one.
[[nodiscard]] std::string to_json(std::span<const CompareRow> rows);

/// The same columns with a header; theta as numbers separated by spaces, slices by ';', channels by '|'.
[[nodiscard]] std::string to_csv(std::span<const CompareRow> rows);

/// A Markdown table of the figures, rounded for reading, in aligned columns.
[[nodiscard]] std::string to_markdown(std::span<const CompareRow> rows);

/// Processor and number of threads, as the operating system names them.
[[nodiscard]] std::string machine_name();

}  // namespace sklar::brdf
