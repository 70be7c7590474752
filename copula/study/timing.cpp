#include "copula/study/timing.hpp"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace sklar {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr double kBudget = 0.1;

}  // namespace

double median_seconds(const std::function<void()>& work) {
  std::vector<double> times;
  oneapi::tbb::task_arena one_thread(1);
  one_thread.execute([&] {
    work();
    const auto start = Clock::now();
    do {
      const auto begin = Clock::now();
      work();
      times.push_back(seconds_since(begin));
    } while (seconds_since(start) < kBudget);
  });
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

}  // namespace sklar
