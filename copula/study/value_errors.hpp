#pragma once
/// How far computed values are from exact ones.

#include <span>

#include "copula/big_float.hpp"

namespace sklar {

/// What counts as the error of a value v for the exact e.
enum class ErrorMeasure {
  relative,  ///< |v - e| / |e|
  logarithm  ///< |v - e| / max(1, |e|)
};

struct ValueErrors {
  double maximum;
  double median;
};

/// Of one value or more, and as many exact ones. Equal infinities have error 0; a NaN, and what is not 0 where the
/// exact value is, have an infinite one.
[[nodiscard]] ValueErrors value_errors(ErrorMeasure measure, std::span<const BigFloat> values,
                                       std::span<const BigFloat> exact);

}  // namespace sklar
