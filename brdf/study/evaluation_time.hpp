#pragma once
/// How long an evaluation takes.

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// Nanoseconds of processor time a RGB value in batches of 4096 seeded random direction pairs; see seconds_per_call.
[[nodiscard]] double evaluation_ns(const Brdf& brdf);

/// The same of the same pairs one at a time.
[[nodiscard]] double single_evaluation_ns(const Brdf& brdf);

}  // namespace sklar::brdf
