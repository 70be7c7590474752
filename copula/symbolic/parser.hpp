#pragma once
/// Formulas as text.
///
///   sum     = product { ("+" | "-") product }
///   product = unary { ("*" | "/") unary }
///   unary   = { "+" | "-" } power
///   power   = primary [ "^" unary ]                       right associative: a^b^c = a^(b^c), -a^b = -(a^b)
///   primary = number | "pi" | symbol | function "(" sum { "," sum } ")" | "(" sum ")"
///
/// A number such as 0.1 or 2.5e-3 is the exact decimal fraction. Functions: exp log log1p expm1 sqrt pow sin cos tan
/// atan abs lambertw (principal branch) and, for positive arguments, gamma lgamma digamma polygamma(order, x).

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "copula/symbolic/expression.hpp"

namespace sklar::symbolic {

/// Text that is no formula. The message names what was expected and shows the line with a caret under the place.
class ParseError : public std::invalid_argument {
 public:
  ParseError(std::string_view text, std::size_t position, const std::string& what);

  [[nodiscard]] std::size_t position() const noexcept { return position_; }  ///< byte offset into the text

 private:
  std::size_t position_;
};

/// The expression in canonical form. @throws ParseError
[[nodiscard]] Expression parse(std::string_view text);

/// As above; a symbol that is not among those allowed is an error that lists them.
[[nodiscard]] Expression parse(std::string_view text, const std::vector<std::string>& allowed_symbols);

}  // namespace sklar::symbolic
