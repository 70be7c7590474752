#pragma once
/// Values of expressions in double that are right to a stated tolerance, or an error.

#include "copula/symbolic/tape.hpp"
#include "copula/types.hpp"

namespace sklar::symbolic {

/// How exact an evaluation is.
struct EvaluationOptions {
  /// A value v with error bound e is accepted if e <= tolerance * max(|v|, floor).
  double tolerance = 1e-13;
  /// 0 asks for a relative error throughout; 1 suits logarithms.
  double floor = 0.0;
  /// Most decimal digits to try before giving up.
  int max_digits = 3200;
};

/// Values, and what they took.
struct Evaluation {
  Points values;        ///< rows x outputs, each exact value rounded to double: 0 below 2^-1075, inf above the largest
  Index promoted = 0;   ///< rows for which double was not enough
  int most_digits = 0;  ///< decimal digits of the widest type that was needed, 15 if double was enough
};

/// Runs a tape in double with a running error bound. A row that misses the tolerance is repeated in long double, then
/// with 50, 100, 200, ... digits and the exponent range of MPFR, until its bound meets it. Rows do not influence each
/// other.
/// @param inputs rows x tape.inputs().size(), taken as exact. A row with NaN gives NaN.
/// @throws std::invalid_argument for a wrong number of columns; std::domain_error for a row whose value is not defined,
/// not finite, or not resolved with max_digits digits (as a value that is exactly zero by cancellation), naming the
/// row's inputs.
[[nodiscard]] Evaluation evaluate(const Tape& tape, const PointsRef& inputs, const EvaluationOptions& options = {});

}  // namespace sklar::symbolic
