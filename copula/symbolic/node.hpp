#pragma once
/// Inside of an expression, for the sources of copula/symbolic only: the exact number type and the canonical order.

#include <boost/multiprecision/cpp_int.hpp>

#include "copula/symbolic/expression.hpp"

namespace sklar::symbolic {

/// Exact numbers of any size.
using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
using Rational =
    boost::multiprecision::number<boost::multiprecision::rational_adaptor<boost::multiprecision::cpp_int_backend<>>,
                                  boost::multiprecision::et_off>;

struct Node {
  Kind kind;
  Function function;
  Rational number;
  std::string name;
  std::vector<Expression> args;
  std::vector<std::uint64_t> symbols;  ///< ids of the symbols below, ascending
  bool positive;                       ///< known to be positive wherever it is defined
  std::size_t hash;
  std::uint64_t id;
};

/// The shared node with these contents, which must be canonical already.
[[nodiscard]] Expression make_node(Kind kind, std::vector<Expression> args, Function function = Function::exp);
[[nodiscard]] Expression number(const Rational& value);

/// Negative, zero or positive; a total order that depends on the contents only.
[[nodiscard]] int compare(const Expression& a, const Expression& b);

/// The order of compare.
struct CanonicalLess {
  bool operator()(const Expression& a, const Expression& b) const { return compare(a, b) < 0; }
};

/// The value of a number, and what it is. Precondition of value_of: a number.
[[nodiscard]] inline const Rational& value_of(const Expression& number) {
  return number.node().number;
}
[[nodiscard]] inline bool is_integer(const Expression& e) {
  return e.is_number() && denominator(value_of(e)) == 1;
}
[[nodiscard]] inline bool is_negative_number(const Expression& e) {
  return e.is_number() && value_of(e) < 0;
}

/// e = coefficient * rest, where rest has no numeric factor.
struct Scaled {
  Rational coefficient;
  Expression rest;
};
/// The expression as a number times the rest.
[[nodiscard]] Scaled split_coefficient(const Expression& e);

/// A sum as content * rest, where the coefficients of rest are coprime integers; with signed_content the first of them
/// is positive, else the content is.
[[nodiscard]] Scaled split_content(const Expression& sum, bool signed_content);

/// coefficient * sum, term by term.
[[nodiscard]] Expression scale_sum(const Expression& sum, const Rational& coefficient);

/// True only if e is positive wherever it is defined.
[[nodiscard]] inline bool known_positive(const Expression& e) {
  return e.node().positive;
}

/// True if (b^inner)^outer = b^(inner outer) wherever the left side is defined.
[[nodiscard]] bool exponents_merge(const Expression& inner, const Expression& outer);

/// base and exponent of any expression; the exponent is 1 unless it is a power.
struct Powered {
  Expression base;
  Expression exponent;
};
/// The expression as a power; itself to the power 1 where it is none.
[[nodiscard]] Powered split_power(const Expression& e);

/// The terms of a sum, or the expression itself; likewise the factors of a product.
[[nodiscard]] std::vector<Expression> terms_of(const Expression& e);
[[nodiscard]] std::vector<Expression> factors_of(const Expression& e);

}  // namespace sklar::symbolic
