#pragma once
/// Formulas as immutable values. Equal expressions are one node of one shared graph, so that equality is a comparison
/// of pointers and a subexpression that occurs a thousand times is stored, differentiated and evaluated once.
///
/// Every function below returns the canonical form: exact rational arithmetic on numbers, sums with like terms merged,
/// products with like bases merged, one exp a product. Symbols are real, and where a power with a non-integer exponent
/// occurs its base is taken as positive, as evaluation demands anyway. log1p(x), expm1(x) and sqrt(x) are log(1+x),
/// exp(x)-1 and x^(1/2); the tape finds the accurate form again, also where the formula did not spell it so.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace sklar::symbolic {

/// What an expression is made of, and the functions that there are.
enum class Kind { number, symbol, function, product, sum, power };
enum class Function { exp, log, sin, cos, tan, atan, abs, gamma, lgamma, digamma, polygamma, lambertw };

struct Node;

class Expression {
 public:
  Expression(long value = 0);                                      // NOLINT: numbers are expressions
  Expression(int value) : Expression(static_cast<long>(value)) {}  // NOLINT

  [[nodiscard]] Kind kind() const noexcept;

  /// Operands: terms of a sum, factors of a product, base and exponent of a power, arguments of a function.
  [[nodiscard]] const std::vector<Expression>& args() const noexcept;

  [[nodiscard]] const std::string& name() const noexcept;  ///< of a symbol
  [[nodiscard]] Function function() const noexcept;        ///< of a function
  [[nodiscard]] std::uint64_t id() const noexcept;         ///< unique among the expressions alive
  [[nodiscard]] const Node& node() const noexcept { return *node_; }

  [[nodiscard]] bool is_number() const noexcept { return kind() == Kind::number; }
  [[nodiscard]] bool is(Function function) const noexcept;
  [[nodiscard]] bool depends_on(const Expression& symbol) const noexcept;

  friend bool operator==(const Expression& a, const Expression& b) noexcept { return a.node_ == b.node_; }
  friend bool operator!=(const Expression& a, const Expression& b) noexcept { return a.node_ != b.node_; }

 private:
  friend class Interner;
  explicit Expression(std::shared_ptr<const Node> node) : node_(std::move(node)) {}

  std::shared_ptr<const Node> node_;
};

/// For tables by expression: equal ones are one node.
struct ExpressionHash {
  std::size_t operator()(const Expression& e) const noexcept { return std::hash<const void*>()(&e.node()); }
};

/// A symbol, called as the text says.
[[nodiscard]] Expression symbol(const std::string& name);

/// Numerator / denominator, exactly. @throws std::domain_error for a zero denominator.
[[nodiscard]] Expression rational(long numerator, long denominator);

/// Sum and product of any number of expressions, in canonical form. @throws std::domain_error for a number of more
/// than 2^15 bits.
[[nodiscard]] Expression sum(const std::vector<Expression>& terms);
[[nodiscard]] Expression product(const std::vector<Expression>& factors);

/// base^exponent; 0^0 = 1. @throws std::domain_error for 0 to a negative power.
[[nodiscard]] Expression power(const Expression& base, const Expression& exponent);

/// @throws std::invalid_argument for a wrong number of arguments, or an order of polygamma that is not a whole number.
[[nodiscard]] Expression apply(Function function, const std::vector<Expression>& args);

/// Functions and operators as they are written in C++.
[[nodiscard]] inline Expression exp(const Expression& x) {
  return apply(Function::exp, {x});
}
[[nodiscard]] inline Expression log(const Expression& x) {
  return apply(Function::log, {x});
}
[[nodiscard]] inline Expression abs(const Expression& x) {
  return apply(Function::abs, {x});
}
[[nodiscard]] inline Expression sqrt(const Expression& x) {
  return power(x, rational(1, 2));
}

/// Functions and operators as they are written in C++.
[[nodiscard]] inline Expression operator+(const Expression& a, const Expression& b) {
  return sum({a, b});
}
[[nodiscard]] inline Expression operator-(const Expression& a) {
  return product({-1, a});
}
[[nodiscard]] inline Expression operator-(const Expression& a, const Expression& b) {
  return sum({a, -b});
}
[[nodiscard]] inline Expression operator*(const Expression& a, const Expression& b) {
  return product({a, b});
}
[[nodiscard]] inline Expression operator/(const Expression& a, const Expression& b) {
  return product({a, power(b, -1)});
}

/// Products of sums multiplied out, at every depth outside functions and exponents. A product that would have more than
/// max_terms terms is left as it is.
[[nodiscard]] Expression expand(const Expression& e, std::size_t max_terms = 10000);

/// Number of distinct nodes, or `most` where there are more.
[[nodiscard]] std::size_t node_count(const Expression& e, std::size_t most = SIZE_MAX);

/// Names of the symbols in e, in alphabetical order.
[[nodiscard]] std::vector<std::string> symbols(const Expression& e);

/// The name as the parser spells it, as in "lambertw".
[[nodiscard]] const char* function_name(Function function) noexcept;

/// Number of arguments: 2 for polygamma(order, x), else 1.
[[nodiscard]] int arity(Function function) noexcept;

}  // namespace sklar::symbolic
