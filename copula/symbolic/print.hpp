#pragma once
/// Expressions as text: for the parser, for LaTeX, for a C++ compiler.

#include <string>
#include <vector>

#include "copula/symbolic/expression.hpp"

namespace sklar::symbolic {

/// In the grammar of parser.hpp: parse(to_text(e)) == e.
[[nodiscard]] std::string to_text(const Expression& e);

/// Body of a LaTeX formula: fractions, roots, Greek letters; theta_1 becomes `\theta_{1}`.
[[nodiscard]] std::string to_latex(const Expression& e);

/// A self-contained function `double name(double a, double b, ...)` that needs `<cmath>` only and gives no warnings;
/// what is used twice is computed once. Symbols that are C++ keywords or names of the function's own get a trailing
/// underscore.
/// @param arguments names of the symbols in the order of the parameters; those that do not occur are left unnamed.
/// @throws std::invalid_argument for a symbol that is not among the arguments, for a name that is no C++ name, and for
/// digamma, polygamma and lambertw, which `<cmath>` lacks.
[[nodiscard]] std::string to_cpp(const Expression& e, const std::string& name,
                                 const std::vector<std::string>& arguments);

}  // namespace sklar::symbolic
