#pragma once
/// How a model is fitted: the options that `brdf fit` and `brdf compare` share.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "brdf/model/paper_fit.hpp"
#include "brdf/model/refined_fit.hpp"
#include "brdf/study/refined_budget.hpp"

namespace sklar::cli {

struct FitOptions {
  std::string mode;  ///< "paper", "refined" or "both"
  brdf::PaperFitOptions paper = {};
  brdf::RefinedFitOptions refined = {};
  std::optional<int> bits = {};
  std::optional<int> evaluations = {};
  brdf::CellMeasure measure = brdf::CellMeasure::per_cell;
  brdf::Budget budget = {};
  brdf::Provenance provenance = brdf::Provenance::unknown;

  [[nodiscard]] bool is_paper() const { return mode != "refined"; }
  [[nodiscard]] bool is_refined() const { return mode != "paper"; }
};

/// Adds --provenance, of MERL-format files, which do not say.
void add_provenance(CLI::App& command, brdf::Provenance& provenance);

/// Adds --mode, the options of either mode, --measure, --max-bytes and --provenance.
/// @param modes the first is that by default
void add_fit_options(CLI::App& command, FitOptions& options, const std::vector<std::string>& modes);

/// Puts --measure and --evaluations where they belong. @throws std::invalid_argument for an option of the other mode.
void settle_fit_options(const CLI::App& command, FitOptions& options);

}  // namespace sklar::cli
