#pragma once
/// How long a piece of work takes.

#include <chrono>
#include <functional>

namespace sklar {

/// Processor time of one call on one thread, in seconds: the mean of the calls that fit into a tenth of a second, at
/// least one, after one that warms the caches. Other programs on the machine hardly change it.
[[nodiscard]] double seconds_per_call(const std::function<void()>& work);

/// Wall clock since its construction.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace sklar
