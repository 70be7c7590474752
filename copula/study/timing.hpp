#pragma once
/// How long a piece of work takes.

#include <functional>

namespace sklar {

/// Seconds of wall clock of one call on one thread: the median of the calls that fit into a tenth of a second, at
/// least one, after one that warms the caches.
[[nodiscard]] double median_seconds(const std::function<void()>& work);

}  // namespace sklar
