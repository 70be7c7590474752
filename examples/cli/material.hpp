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

/// A material file, or the built-in material where path is empty.
/// @param binary_provenance of a MERL-format file, which does not say. @throws FileError
[[nodiscard]] std::shared_ptr<const brdf::MeasuredTable> load_table(
    const std::string& path, brdf::Provenance binary_provenance = brdf::Provenance::unknown);

/// A fitted model (.json), or a material read between its cell centres.
[[nodiscard]] brdf::BrdfPtr load_brdf(const std::string& path);

/// A bar on stderr where that is a terminal, else nothing.
[[nodiscard]] brdf::Progress progress_bar(std::string label);

/// One line on stderr that says what is being done, where that is a terminal; removed at the end.
class StepLine {
 public:
  StepLine();
  ~StepLine();
  StepLine(const StepLine&) = delete;
  StepLine& operator=(const StepLine&) = delete;

  void show(const std::string& what) const;

 private:
  bool visible_;
};

}  // namespace sklar::cli
