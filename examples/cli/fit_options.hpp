#pragma once
/// How a model is fitted: the options that `brdf fit` and `brdf compare` share.

#include <CLI/CLI.hpp>

#include "brdf/model/paper_fit.hpp"

namespace sklar::cli {

/// Adds --mode, --slices, --method, --measure and --provenance (of MERL-format files, which do not say).
void add_fit_options(CLI::App& command, brdf::PaperFitOptions& options, brdf::Provenance& provenance);

}  // namespace sklar::cli
