#include "brdf/study/model_batch.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>

#include "brdf/study/model_job.hpp"
#include "copula/file.hpp"

namespace sklar::brdf {
namespace {

/// What it throws, as text; empty for nothing.
std::string failure_of(const std::function<void()>& step) {
  try {
    step();
  } catch (const std::runtime_error& error) {
    return error.what();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "";
}

class Batch {
 public:
  Batch(std::span<const BatchMaterial> materials, std::span<const Contender> contenders, std::filesystem::path folder,
        const BatchOptions& options)
      : materials_(materials),
        contenders_(contenders),
        folder_(std::move(folder)),
        options_(options),
        state_{.jobs = materials.size() * contenders.size()},
        rows_(state_.jobs) {}

  std::vector<ModelRow> run() {
    const std::size_t threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    tbb::parallel_for(
        std::size_t{0}, std::min(threads, materials_.size()), [&](std::size_t) { work(); }, tbb::simple_partitioner());
    if (failure_) std::rethrow_exception(failure_);
    return std::move(rows_);
  }

 private:
  /// Material after material. No exception leaves the loop: it would cancel the loops of fits that run, in their
  /// middle. Isolated, since a thread that waits within a fit would else begin another material.
  void work() {
    while (const std::optional<std::size_t> material = next()) {
      try {
        tbb::this_task_arena::isolate([&] { work_on(*material); });
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
      }
    }
  }

  std::optional<std::size_t> next() {
    const std::lock_guard lock(mutex_);
    if (failure_ || next_ == materials_.size()) return std::nullopt;
    return next_++;
  }

  void work_on(std::size_t n) {
    const BatchMaterial& material = materials_[n];
    const std::filesystem::path place = folder_ / material.name;
    const std::span<ModelRow> rows = std::span(rows_).subspan(n * contenders_.size(), contenders_.size());
    ContenderData data;
    std::string error = failure_of([&] { data.inputs = material.inputs(); });
    const std::vector<std::size_t> open = unfinished(place, data, rows);
    if (open.empty()) return;
    if (error.empty()) error = failure_of([&] { data.table = material.load(); });
    ModelJobs jobs(data, place);
    for (const std::size_t c : open) {
      if (!begin(material.name + ": " + contenders_[c].name())) return;
      rows[c] = error.empty() ? jobs.run(contenders_[c]) : refuse(n, contenders_[c], data, error);
      count(rows[c], &BatchState::done);
    }
  }

  /// Fills the rows that are finished. @return the contenders of the others.
  std::vector<std::size_t> unfinished(const std::filesystem::path& place, const ContenderData& data,
                                      std::span<ModelRow> rows) {
    std::vector<std::size_t> open;
    for (std::size_t c = 0; c < contenders_.size(); ++c) {
      auto row = finished_row(job_files(place, contenders_[c]), inputs_of_job(data, contenders_[c]));
      if (!row || (options_.retry_failed && !row->error.empty())) {
        open.push_back(c);
        continue;
      }
      rows[c] = std::move(*row);
      count(rows[c], &BatchState::kept);
    }
    return open;
  }

  /// The job of a material that cannot be read has failed.
  ModelRow refuse(std::size_t n, const Contender& contender, const ContenderData& data, const std::string& error) {
    const BatchMaterial& material = materials_[n];
    ModelRow row = empty_row(material.name, material.provenance, contender, inputs_of_job(data, contender));
    row.error = error;
    make_folder(folder_ / material.name);
    write_failure(job_files(folder_ / material.name, contender), row);
    return row;
  }

  /// @return whether the job may begin. @throws what progress throws
  bool begin(const std::string& job) {
    const std::lock_guard lock(mutex_);
    if (failure_) return false;
    if (options_.progress) options_.progress(state_, job);
    return true;
  }

  void count(const ModelRow& row, std::size_t BatchState::*as) {
    const std::lock_guard lock(mutex_);
    ++(state_.*as);
    if (!row.error.empty()) ++state_.failed;
  }

  std::span<const BatchMaterial> materials_;
  std::span<const Contender> contenders_;
  std::filesystem::path folder_;
  const BatchOptions& options_;
  std::mutex mutex_{};  // of the members below, but for rows
  std::size_t next_ = 0;
  std::exception_ptr failure_{};
  BatchState state_;
  std::vector<ModelRow> rows_;
};

}  // namespace

std::vector<ModelRow> fit_batch(std::span<const BatchMaterial> materials, std::span<const Contender> contenders,
                                const std::filesystem::path& folder, const BatchOptions& options) {
  return Batch(materials, contenders, folder, options).run();
}

}  // namespace sklar::brdf
