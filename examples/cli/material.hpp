#pragma once
/// What the `brdf` subcommands work on.

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "brdf/data/table_brdf.hpp"
#include "brdf/progress.hpp"

namespace sklar::cli {

/// Adds the positional MATERIAL; omitted, it is the built-in one.
void add_material(CLI::App& command, std::string& path);

/// A material file, or the built-in material where path is empty. @throws FileError
[[nodiscard]] std::shared_ptr<const brdf::MeasuredTable> load_table(const std::string& path);

/// The same read between its cell centres.
[[nodiscard]] std::shared_ptr<const brdf::TableBrdf> load_brdf(const std::string& path);

/// A bar on stderr where that is a terminal, else nothing.
[[nodiscard]] brdf::Progress progress_bar(std::string label);

}  // namespace sklar::cli
