#include "copula/symbolic/ring.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "copula/symbolic/node.hpp"

namespace sklar::symbolic {

namespace {

Polynomial constant(const Expression& value) {
  if (value == Expression(0)) return {};
  return {{Monomial{}, value}};
}

Polynomial single(const Expression& atom, const Expression& exponent) {
  return {{Monomial{{atom, exponent}}, 1}};
}

void add_term(Polynomial& p, const Monomial& monomial, const Expression& coefficient) {
  const auto [entry, added] = p.try_emplace(monomial, coefficient);
  if (added) return;
  entry->second = entry->second + coefficient;
  if (entry->second == Expression(0)) p.erase(entry);
}

void add(Polynomial& p, const Polynomial& more) {
  for (const auto& [monomial, coefficient] : more) add_term(p, monomial, coefficient);
}

Monomial multiply(const Monomial& a, const Monomial& b) {
  Monomial result;
  auto x = a.begin();
  auto y = b.begin();
  while (x != a.end() || y != b.end()) {
    if (y == b.end() || (x != a.end() && x->atom.id() < y->atom.id())) {
      result.push_back(*x++);
    } else if (x == a.end() || y->atom.id() < x->atom.id()) {
      result.push_back(*y++);
    } else {
      const Expression exponent = x->exponent + y->exponent;
      if (exponent != Expression(0)) result.push_back({x->atom, exponent});
      ++x;
      ++y;
    }
  }
  return result;
}

Polynomial multiply(const Polynomial& a, const Polynomial& b) {
  Polynomial result;
  for (const auto& [left, left_coefficient] : a) {
    for (const auto& [right, right_coefficient] : b) {
      add_term(result, multiply(left, right), left_coefficient * right_coefficient);
    }
  }
  return result;
}

/// The largest numeric exponent of exp(h) in any monomial, a missing one counting as 0; nothing if one is not a number.
std::optional<Rational> dominant_exponent(const Polynomial& p, const Expression& atom) {
  std::optional<Rational> largest;
  for (const auto& entry : p) {
    Rational exponent = 0;
    for (const AtomPower& power : entry.first) {
      if (power.atom != atom) continue;
      if (!power.exponent.is_number()) return std::nullopt;
      exponent = value_of(power.exponent);
    }
    if (!largest || exponent > *largest) largest = exponent;
  }
  return largest;
}

/// What to divide a sum by so that no exponential in it grows.
Monomial dominant_exponentials(const Polynomial& p) {
  Monomial dominant;
  for (const auto& entry : p) {
    for (const AtomPower& power : entry.first) {
      if (!power.atom.is(Function::exp)) continue;
      const bool seen =
          std::any_of(dominant.begin(), dominant.end(), [&](const AtomPower& d) { return d.atom == power.atom; });
      if (seen) continue;
      const auto exponent = dominant_exponent(p, power.atom);
      if (exponent && *exponent != 0) dominant.push_back({power.atom, number(*exponent)});
    }
  }
  std::sort(dominant.begin(), dominant.end());
  return dominant;
}

Monomial raise(const Monomial& monomial, const Expression& exponent) {
  Monomial result;
  for (const AtomPower& power : monomial) result.push_back({power.atom, expand(power.exponent * exponent)});
  return result;
}

}  // namespace

Expression Ring::to_expression(const Polynomial& p) {
  std::vector<Expression> terms;
  for (const auto& [monomial, coefficient] : p) {
    std::vector<Expression> factors{coefficient};
    for (const AtomPower& atom_power : monomial) factors.push_back(power(atom_power.atom, atom_power.exponent));
    terms.push_back(product(factors));
  }
  return sum(terms);
}

Polynomial Ring::convert(const Expression& e) {
  if (!e.depends_on(x_)) return constant(e);
  switch (e.kind()) {
    case Kind::sum: {
      Polynomial result;
      for (const Expression& term : e.args()) add(result, convert(term));
      return result;
    }
    case Kind::product:
      return convert_product(e);
    case Kind::power:
      return convert_power(e);
    case Kind::function:
      if (e.is(Function::exp)) return convert_exp(e.args()[0]);
      break;
    default:
      break;
  }
  return single(e, 1);
}

// Sums stay factors, or a product of many would be multiplied out.
Polynomial Ring::convert_product(const Expression& e) {
  Polynomial result = constant(1);
  for (const Expression& factor : e.args()) {
    const bool keep = factor.kind() == Kind::sum && factor.depends_on(x_);
    result = multiply(result, keep ? convert_power_of_sum(factor, 1) : convert(factor));
  }
  return result;
}

Polynomial Ring::convert_power(const Expression& e) {
  const Expression& base = e.args()[0];
  const Expression exponent = expand(e.args()[1]);
  if (exponent.depends_on(x_)) return single(e, 1);
  if (base.kind() == Kind::sum) return convert_power_of_sum(base, exponent);
  return single(base, exponent);
}

Polynomial Ring::convert_power_of_sum(const Expression& base, const Expression& exponent) {
  const Polynomial terms = convert(base);
  const Monomial dominant = dominant_exponentials(terms);
  if (dominant.empty()) return single(base, exponent);
  const Polynomial rest = multiply(terms, Polynomial{{raise(dominant, -1), 1}});
  const Expression rest_power = power(to_expression(rest), exponent);
  return multiply(Polynomial{{raise(dominant, exponent), 1}},
                  rest_power.depends_on(x_) ? convert(rest_power) : constant(rest_power));
}

Polynomial Ring::convert_exp(const Expression& argument) {
  std::vector<Expression> fixed;
  Monomial exponentials;
  for (const Expression& term : terms_of(expand(argument))) {
    std::vector<Expression> exponent;
    std::vector<Expression> varying;
    for (const Expression& factor : factors_of(term)) (factor.depends_on(x_) ? varying : exponent).push_back(factor);
    if (varying.empty()) {
      fixed.push_back(term);
    } else {
      exponentials = multiply(exponentials, {{exp(product(varying)), product(exponent)}});
    }
  }
  return {{exponentials, exp(sum(fixed))}};
}

Polynomial Ring::differentiate(const Polynomial& p) {
  Polynomial result;
  for (const auto& [monomial, coefficient] : p) {
    for (const AtomPower& factor : monomial) {
      const Monomial lowered = multiply(monomial, {{factor.atom, -1}});
      const Expression scale = coefficient * factor.exponent;
      for (const auto& [inner, inner_coefficient] : derivative_of_atom(factor.atom)) {
        add_term(result, multiply(lowered, inner), scale * inner_coefficient);
      }
    }
  }
  return result;
}

const Polynomial& Ring::derivative_of_atom(const Expression& atom) {
  const auto known = derivatives_.find(atom);
  if (known != derivatives_.end()) return known->second;
  Polynomial derivative = differentiate_atom(atom);
  return derivatives_.emplace(atom, std::move(derivative)).first->second;
}

Polynomial Ring::differentiate_atom(const Expression& atom) {
  if (atom == x_) return constant(1);
  if (atom.kind() == Kind::function) return differentiate_function(atom);
  if (atom.kind() == Kind::power && atom.args()[1].depends_on(x_)) {
    const Expression& base = atom.args()[0];
    const Polynomial logarithm = convert(log(base));
    Polynomial result = multiply(differentiate(convert(atom.args()[1])), logarithm);
    add(result, multiply(convert(atom.args()[1]), differentiate(logarithm)));
    return multiply(result, single(atom, 1));
  }
  if (atom.kind() == Kind::product) {
    Polynomial result;
    for (const Expression& factor : atom.args()) {
      if (!factor.depends_on(x_)) continue;
      add(result, multiply(differentiate(convert(factor)), convert(atom / factor)));
    }
    return result;
  }
  return differentiate(convert(atom));
}

Polynomial Ring::differentiate_function(const Expression& atom) {
  const Expression& x = atom.args().back();
  const Polynomial inner = differentiate(convert(x));
  const auto times = [&](const Expression& outer) { return multiply(inner, convert(outer)); };
  switch (atom.function()) {
    case Function::exp:
      return multiply(inner, single(atom, 1));
    case Function::log:
      return times(power(x, -1));
    case Function::sin:
      return times(apply(Function::cos, {x}));
    case Function::cos:
      return times(-apply(Function::sin, {x}));
    case Function::tan:
      return times(1 + power(atom, 2));
    case Function::atan:
      return times(power(1 + power(x, 2), -1));
    case Function::abs:
      return times(atom / x);
    case Function::gamma:
      return times(atom * apply(Function::digamma, {x}));
    case Function::lgamma:
      return times(apply(Function::digamma, {x}));
    case Function::digamma:
      return times(apply(Function::polygamma, {1, x}));
    case Function::polygamma:
      return times(apply(Function::polygamma, {atom.args()[0] + 1, x}));
    case Function::lambertw:
      return times(atom / (x * (1 + atom)));
  }
  throw std::logic_error("a function without a derivative");
}

}  // namespace sklar::symbolic
