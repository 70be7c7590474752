#pragma once
/// How long a piece of work takes.

#include <functional>

namespace sklar {

/// Processor time of one call on one thread, in seconds: the mean of the calls that fit into a tenth of a second, at
/// least one, after one that warms the caches. Other programs on the machine hardly change it.
[[nodiscard]] double seconds_per_call(const std::function<void()>& work);

}  // namespace sklar
