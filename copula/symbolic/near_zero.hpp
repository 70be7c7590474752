#pragma once
/// Formulas for a function near a point where plain evaluation cancels, and inverses by solving for a symbol.

#include <optional>

#include "copula/symbolic/expression.hpp"

namespace sklar::symbolic {

/// f(x) = at_zero + growth, where growth has small relative error near x = 0, as far as the tape finds log1p and expm1
/// in it: log g(x) grows by log1p(growth of g / g(0)), exp g(x) by exp(g(0)) expm1(growth of g), and so on.
struct NearZero {
  Expression at_zero;
  Expression growth;
};

/// Empty where the structure of f has no such form. A power of x, or of anything that is 0 at x = 0, is taken to have a
/// positive exponent.
[[nodiscard]] std::optional<NearZero> near_zero(const Expression& f, const Expression& x);

/// The solution x of f(x) = y, empty unless x occurs once, below sums, products, powers, exp and log. Of a whole power
/// it is the positive root.
[[nodiscard]] std::optional<Expression> solve_for(const Expression& f, const Expression& x, const Expression& y);

/// e with every occurrence of a symbol replaced. @throws std::domain_error where the result is not defined, as 1/0.
[[nodiscard]] Expression substitute(const Expression& e, const Expression& symbol, const Expression& replacement);

}  // namespace sklar::symbolic
