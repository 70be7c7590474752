#include "copula/symbolic/fraction.hpp"
#include "copula/symbolic/print.hpp"

namespace sklar::symbolic {

Fraction split_fraction(const Expression& e) {
  Fraction fraction;
  const Scaled scaled = split_coefficient(e);
  fraction.negative = scaled.coefficient < 0;
  fraction.top_number = abs(numerator(scaled.coefficient));
  fraction.bottom_number = denominator(scaled.coefficient);
  if (scaled.rest == Expression(1)) return fraction;
  for (const Expression& factor : factors_of(scaled.rest)) {
    const Powered powered = split_power(factor);
    if (is_negative_number(powered.exponent)) {
      fraction.bottom.push_back(power(powered.base, -powered.exponent));
    } else {
      fraction.top.push_back(factor);
    }
  }
  return fraction;
}

bool is_square_root(const Expression& e) {
  return e.kind() == Kind::power && e.args()[1] == rational(1, 2);
}

namespace {

std::string print_sum(const Expression& e);

std::string parenthesised(const Expression& e) {
  return "(" + print_sum(e) + ")";
}

/// Something that stands on either side of ^.
std::string print_atom(const Expression& e) {
  switch (e.kind()) {
    case Kind::number:
      if (!is_integer(e) || value_of(e) < 0) break;
      return numerator(value_of(e)).str();
    case Kind::symbol:
      return e.name();
    case Kind::function: {
      std::string text = std::string(function_name(e.function())) + "(";
      for (std::size_t i = 0; i < e.args().size(); ++i) text += (i ? ", " : "") + print_sum(e.args()[i]);
      return text + ")";
    }
    case Kind::power:
      if (is_square_root(e)) return "sqrt(" + print_sum(e.args()[0]) + ")";
      break;
    default:
      break;
  }
  return parenthesised(e);
}

std::string print_factor(const Expression& e) {
  if (e.kind() != Kind::power || is_square_root(e)) return print_atom(e);
  return print_atom(e.args()[0]) + "^" + print_atom(e.args()[1]);
}

std::string print_factors(const Integer& number, const std::vector<Expression>& factors) {
  std::string text;
  if (number != 1 || factors.empty()) text = number.str();
  for (const Expression& factor : factors) text += (text.empty() ? "" : "*") + print_factor(factor);
  return text;
}

/// Without the sign.
std::string print_fraction(const Fraction& f) {
  const std::string top = print_factors(f.top_number, f.top);
  if (!f.has_bottom()) return top;
  const std::string bottom = print_factors(f.bottom_number, f.bottom);
  const bool single = f.bottom.size() + (f.bottom_number != 1 ? 1 : 0) == 1;
  return top + "/" + (single ? bottom : "(" + bottom + ")");
}

std::string print_sum(const Expression& e) {
  std::string text;
  for (const Expression& term : terms_of(e)) {
    const Fraction f = split_fraction(term);
    if (text.empty()) {
      text = f.negative ? "-" : "";
    } else {
      text += f.negative ? " - " : " + ";
    }
    text += print_fraction(f);
  }
  return text;
}

}  // namespace

std::string to_text(const Expression& e) {
  return print_sum(e);
}

}  // namespace sklar::symbolic
