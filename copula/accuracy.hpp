#pragma once
/// What a batch call trades for speed.

namespace sklar {

/// fast: single precision where it serves, in dimension 2; errors up to kFastTolerance. standard: see
/// copula/tolerance.hpp. Any number of digits: Copula::exact.
enum class Accuracy { fast, standard };

}  // namespace sklar
