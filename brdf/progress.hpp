#pragma once
/// How long work tells its caller how far it is.

#include <functional>
#include <mutex>
#include <utility>

namespace sklar::brdf {

/// Called with the share done, in (0,1], rising, never by two threads at once. What it throws ends the work and reaches
/// the caller: so a caller interrupts.
using Progress = std::function<void(double share)>;

/// Counts finished steps over threads and reports each to an optional Progress.
class ProgressCounter {
 public:
  ProgressCounter(Progress progress, int steps) : progress_(std::move(progress)), steps_(steps) {}

  void step() {
    if (!progress_) return;
    const std::lock_guard lock(mutex_);
    progress_(static_cast<double>(++done_) / steps_);
  }

 private:
  Progress progress_;
  int steps_;
  int done_ = 0;
  std::mutex mutex_;
};

}  // namespace sklar::brdf
