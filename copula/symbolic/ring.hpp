#pragma once
/// The ring in which derivative.hpp works. For the sources of copula/symbolic only.

#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "copula/symbolic/expression.hpp"

namespace sklar::symbolic {

/// atom^exponent
struct AtomPower {
  Expression atom;
  Expression exponent;

  friend bool operator<(const AtomPower& a, const AtomPower& b) {
    return a.atom.id() != b.atom.id() ? a.atom.id() < b.atom.id() : a.exponent.id() < b.exponent.id();
  }
};

using Monomial = std::vector<AtomPower>;            ///< ascending by the atom's id, no exponent 0
using Polynomial = std::map<Monomial, Expression>;  ///< monomial -> coefficient free of x

class Ring {
 public:
  explicit Ring(Expression x) : x_(std::move(x)) {}

  [[nodiscard]] Polynomial convert(const Expression& e);
  [[nodiscard]] Polynomial differentiate(const Polynomial& p);
  [[nodiscard]] static Expression to_expression(const Polynomial& p);

 private:
  [[nodiscard]] Polynomial convert_product(const Expression& e);
  [[nodiscard]] Polynomial convert_power(const Expression& e);
  [[nodiscard]] Polynomial convert_power_of_sum(const Expression& base, const Expression& exponent);
  [[nodiscard]] Polynomial convert_exp(const Expression& argument);

  /// d atom / dx
  [[nodiscard]] const Polynomial& derivative_of_atom(const Expression& atom);
  [[nodiscard]] Polynomial differentiate_atom(const Expression& atom);
  [[nodiscard]] Polynomial differentiate_function(const Expression& atom);

  Expression x_;
  std::unordered_map<Expression, Polynomial, ExpressionHash> derivatives_;
};

}  // namespace sklar::symbolic
