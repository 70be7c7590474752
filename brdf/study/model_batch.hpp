#pragma once
/// Many materials: models fitted to each, in parallel, every finished one kept.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "brdf/study/model_comparison.hpp"

namespace sklar::brdf {

/// A material before it is read.
struct BatchMaterial {
  std::string name;                             ///< of the table; names its folder
  Provenance provenance = Provenance::unknown;  ///< of the rows where it cannot be read
  std::function<std::string()> inputs = {};     ///< ContenderData::inputs
  std::function<std::shared_ptr<const MeasuredTable>()> load = {};
};

/// How far a batch is, in jobs: a job is one model on one material.
struct BatchState {
  std::size_t jobs = 0;    ///< all
  std::size_t kept = 0;    ///< found finished
  std::size_t done = 0;    ///< by this run
  std::size_t failed = 0;  ///< of kept and done
};

/// What is done with jobs that failed before, and who is told.
struct BatchOptions {
  bool retry_failed = false;  ///< otherwise a job that failed is a job finished
  /// Told of each job before it begins, never by two threads at once. Where it throws, the jobs that run are finished
  /// and kept, no other begins, and the caller gets what it threw.
  std::function<void(const BatchState&, const std::string& job)> progress = {};
};

/// Fits and judges every contender on every material and keeps it in FOLDER/MATERIAL, as ModelJobs. What is there
/// already, made from the same inputs, is not done again. Materials are worked on in their order, at most as many at a
/// time as there are threads; each is read once, and not at all where nothing is left to do. Contenders have no others
/// to learn from.
/// @param materials with different names.
/// @return a row for each contender on the first material, on the second and so on; but for fit_s and eval_ns the same
/// whatever the number of threads. A material that cannot be read is an error in its rows.
/// @throws FileError for what cannot be written, and for a damaged row, naming it.
[[nodiscard]] std::vector<ModelRow> fit_batch(std::span<const BatchMaterial> materials,
                                              std::span<const Contender> contenders,
                                              const std::filesystem::path& folder, const BatchOptions& options = {});

}  // namespace sklar::brdf
