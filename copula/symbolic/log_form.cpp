#include "copula/symbolic/log_form.hpp"

#include <map>

#include "copula/symbolic/node.hpp"

namespace sklar::symbolic {

namespace {

using Exponents = std::map<Expression, Expression, CanonicalLess>;

/// A term as powers of bases and a sum of exponents of e, each exponent as coefficient times something.
struct TermFactors {
  Exponents powers;
  Exponents exponentials;
};

TermFactors split_term(const Expression& term) {
  TermFactors result;
  for (const Expression& factor : factors_of(term)) {
    if (factor.is_number()) continue;
    if (factor.is(Function::exp)) {
      for (const Expression& part : terms_of(factor.args()[0])) {
        const Scaled scaled = split_coefficient(part);
        result.exponentials.emplace(scaled.rest, number(scaled.coefficient));
      }
    } else {
      const Powered powered = split_power(factor);
      result.powers.emplace(powered.base, powered.exponent);
    }
  }
  return result;
}

/// An order of exponents by their difference; for symbolic ones a guess, by the sign of its last coefficient.
bool is_less(const Expression& a, const Expression& b) {
  const std::vector<Expression> difference = terms_of(expand(a - b));
  return split_coefficient(difference.back()).coefficient < 0;
}

/// Keeps the least exponent of the bases present in both.
void meet_powers(Exponents& common, const Exponents& other) {
  for (auto entry = common.begin(); entry != common.end();) {
    const auto match = other.find(entry->first);
    if (match == other.end()) {
      entry = common.erase(entry);
      continue;
    }
    if (is_less(match->second, entry->second)) entry->second = match->second;
    ++entry;
  }
}

/// Keeps the largest coefficient, a missing one counting as 0.
void join_exponentials(Exponents& common, const Exponents& other) {
  for (const auto& [argument, coefficient] : other) common.try_emplace(argument, 0);
  for (auto& [argument, coefficient] : common) {
    const auto match = other.find(argument);
    const Expression there = match == other.end() ? Expression(0) : match->second;
    if (value_of(there) > value_of(coefficient)) coefficient = there;
  }
}

Expression to_product(const TermFactors& common) {
  std::vector<Expression> factors;
  std::vector<Expression> exponents;
  for (const auto& [base, exponent] : common.powers) factors.push_back(power(base, exponent));
  for (const auto& [argument, coefficient] : common.exponentials) exponents.push_back(coefficient * argument);
  factors.push_back(exp(sum(exponents)));
  return product(factors);
}

void add_factor(LogForm& form, const Expression& factor) {
  const Powered powered = split_power(factor);
  form.log_abs = form.log_abs + powered.exponent * log(abs(powered.base));
  const bool even = is_integer(powered.exponent) && numerator(value_of(powered.exponent)) % 2 == 0;
  if (is_integer(powered.exponent) && !even && !known_positive(powered.base)) form.sign_factors.push_back(powered.base);
}

}  // namespace

Factored factor_common(const Expression& e) {
  if (e.kind() != Kind::sum) return {e, 1};
  TermFactors common = split_term(e.args().front());
  for (const Expression& term : e.args()) {
    const TermFactors other = split_term(term);
    meet_powers(common.powers, other.powers);
    join_exponentials(common.exponentials, other.exponentials);
  }
  const Expression divisor = to_product(common);
  std::vector<Expression> terms;
  for (const Expression& term : e.args()) terms.push_back(term / divisor);
  const Expression rest = sum(terms);
  if (rest.kind() != Kind::sum) return {e, 1};
  const Scaled primitive = split_content(rest, true);
  return {number(primitive.coefficient) * divisor, primitive.rest};
}

LogForm log_form(const Expression& e) {
  LogForm form{0, {}};
  const Factored factored = factor_common(e);
  for (const Expression& factor : factors_of(factored.common)) add_factor(form, factor);
  for (const Expression& factor : factors_of(factored.rest)) add_factor(form, factor);
  return form;
}

}  // namespace sklar::symbolic
