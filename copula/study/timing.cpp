#include "copula/study/timing.hpp"

#include <oneapi/tbb/task_arena.h>
#include <time.h>

#include <chrono>

namespace sklar {
namespace {

/// Of the calling thread.
double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

double seconds_per_call(const std::function<void()>& work) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kBudget{100};
  double seconds = 0;
  oneapi::tbb::task_arena one_thread(1);
  one_thread.execute([&] {
    work();
    const auto end = Clock::now() + kBudget;
    const double begin = processor_seconds();
    int calls = 0;
    do {
      work();
      ++calls;
    } while (Clock::now() < end);
    seconds = (processor_seconds() - begin) / calls;
  });
  return seconds;
}

}  // namespace sklar
