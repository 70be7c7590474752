#pragma once
/// Common factors, and logarithms of the absolute value.

#include <vector>

#include "copula/symbolic/expression.hpp"

namespace sklar::symbolic {

/// common * rest, where common is a product of what all terms of the sum share.
struct Factored {
  Expression common;
  Expression rest;
};

/// Of a base that occurs in all terms the least power is common, of exponentials the one that dominates for large
/// arguments; rest has coprime integer coefficients. An expression that is no sum is its own common factor.
[[nodiscard]] Factored factor_common(const Expression& e);

/// log|e| as a sum over the factors of e, with the common factors of a sum taken out: it keeps its digits where e
/// itself leaves the range of double, exp(-t^2) (1 + t) at t = 1e100 say.
struct LogForm {
  Expression log_abs;
  std::vector<Expression> sign_factors;  ///< the sign of e is the product of theirs
};
/// The logarithm of |e| and the factors of its sign.
[[nodiscard]] LogForm log_form(const Expression& e);

}  // namespace sklar::symbolic
