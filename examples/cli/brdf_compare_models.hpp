#pragma once
/// `brdf compare --models`: models of every kind.

#include <string>
#include <vector>

#include "brdf/data/measured_table.hpp"

namespace sklar::cli {

struct ModelCompareOptions {
  std::vector<std::string> materials;  ///< files; empty: the built-in material
  std::string models;                  ///< "all" or names with commas
  std::vector<double> budgets;         ///< bytes
  std::string folder;
  brdf::Provenance provenance = brdf::Provenance::unknown;
};

/// Prints the summary and the paths of what it wrote; with `json` the rows as JSON. Goes on where an interrupted run
/// into the same folder stopped.
void compare_models(const ModelCompareOptions& options, bool json);

}  // namespace sklar::cli
