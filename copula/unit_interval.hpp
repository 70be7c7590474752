#pragma once
/// A fast check of many numbers.

#include "copula/types.hpp"

namespace sklar {

/// Whether none of the numbers is below 0 or above 1; NaN is neither.
[[nodiscard]] bool none_outside_unit_interval(const double* numbers, Index count);

}  // namespace sklar
