#pragma once
/// How printers and the tape see a product: sign, numerator, denominator. For the sources of copula/symbolic only.

#include "copula/symbolic/node.hpp"

namespace sklar::symbolic {

/// (negative ? -1 : 1) * top_number * prod(top) / (bottom_number * prod(bottom)); the numbers are positive integers or
/// 0.
struct Fraction {
  bool negative = false;
  Integer top_number = 1;
  Integer bottom_number = 1;
  std::vector<Expression> top;
  std::vector<Expression> bottom;

  [[nodiscard]] bool has_bottom() const { return !bottom.empty() || bottom_number != 1; }
};

/// Any expression as a fraction; powers with negative numeric exponents go below the line.
[[nodiscard]] Fraction split_fraction(const Expression& e);

/// True for a power with exponent 1/2.
[[nodiscard]] bool is_square_root(const Expression& e);

}  // namespace sklar::symbolic
