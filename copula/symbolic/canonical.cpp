// Canonical sums and products.

#include <algorithm>
#include <map>
#include <stdexcept>

#include "copula/symbolic/node.hpp"

namespace sklar::symbolic {

namespace {

constexpr unsigned kMostBits = 1 << 15;  // of a numerator or denominator; time and room grow with their square

/// @throws std::domain_error for a number too long to calculate with.
void require_short(const Rational& value) {
  const Integer either = abs(numerator(value)) | denominator(value);
  if (msb(either) < kMostBits) return;
  throw std::domain_error("a number of more than " + std::to_string(kMostBits) + " bits");
}

Expression with_coefficient(const Rational& coefficient, const Expression& rest) {
  if (coefficient == 1) return rest;
  std::vector<Expression> args{number(coefficient)};
  for (const Expression& factor : factors_of(rest)) args.push_back(factor);
  return make_node(Kind::product, std::move(args));
}

/// Rational coefficients of distinct terms, in canonical order; the number 1 stands for the constant.
class Terms {
 public:
  void add(const Expression& e, const Rational& factor) {
    if (e.kind() == Kind::sum) {
      for (const Expression& term : e.args()) add(term, factor);
      return;
    }
    const Scaled term = split_coefficient(e);
    Rational& coefficient = coefficients_[term.rest];
    coefficient += factor * term.coefficient;
    require_short(coefficient);
  }

  [[nodiscard]] Expression to_expression() const {
    std::vector<Expression> args;
    for (const auto& [rest, coefficient] : coefficients_) {
      if (coefficient == 0) continue;
      args.push_back(rest == Expression(1) ? number(coefficient) : with_coefficient(coefficient, rest));
    }
    if (args.empty()) return 0;
    if (args.size() == 1) return args.front();
    return make_node(Kind::sum, std::move(args));
  }

 private:
  std::map<Expression, Rational, CanonicalLess> coefficients_;
};

Rational integer_power(const Rational& base, const Rational& exponent) {
  const auto n = static_cast<unsigned>(abs(numerator(exponent)));
  const Rational power(pow(numerator(base), n), pow(denominator(base), n));
  return exponent < 0 ? Rational(1) / power : power;
}

/// Powers by base, the exponents of e collected apart, and a numeric coefficient.
class Factors {
 public:
  void add(const Expression& e) {
    if (e.is_number()) {
      scale(value_of(e));
    } else if (e.kind() == Kind::product) {
      for (const Expression& factor : e.args()) add_factor(factor);
    } else if (e.kind() == Kind::sum) {
      const Scaled primitive = split_content(e, true);
      scale(primitive.coefficient);
      add_factor(primitive.rest);
    } else {
      add_factor(e);
    }
  }

  // Merged powers may turn into numbers or products; those are taken in again until nothing changes.
  [[nodiscard]] Expression to_expression() {
    while (merge()) {
    }
    if (coefficient_ == 0) return 0;
    std::vector<Expression> args;
    for (const auto& entry : powers_) args.push_back(entry.second.factor);
    if (!exp_terms_.empty()) {
      const Expression e = make_node(Kind::function, {exp_terms_.front()}, Function::exp);
      args.insert(std::lower_bound(args.begin(), args.end(), e, CanonicalLess()), e);
    }
    if (args.empty()) return number(coefficient_);
    if (args.size() == 1 && args.front().kind() == Kind::sum) return scale_sum(args.front(), coefficient_);
    if (coefficient_ != 1) args.insert(args.begin(), number(coefficient_));
    return args.size() == 1 ? args.front() : make_node(Kind::product, std::move(args));
  }

 private:
  struct Power {
    Expression factor;                  // canonical, if there is one exponent
    std::vector<Expression> exponents;  // to be added up
  };

  void scale(const Rational& factor) {
    coefficient_ *= factor;
    require_short(coefficient_);
  }

  // A factor of a canonical product: no product, and a sum only with content 1.
  void add_factor(const Expression& e) {
    if (e.is_number()) {
      scale(value_of(e));
    } else if (e.is(Function::exp)) {
      exp_terms_.push_back(e.args()[0]);
    } else {
      const Powered powered = split_power(e);
      powers_.try_emplace(powered.base, Power{e, {}}).first->second.exponents.push_back(powered.exponent);
    }
  }

  // One pass: every base gets a single exponent. Returns whether a result has to be taken in again.
  bool merge() {
    std::vector<Expression> again;
    for (auto entry = powers_.begin(); entry != powers_.end();) {
      auto& [factor, exponents] = entry->second;
      if (exponents.size() > 1) {
        exponents = {sum(exponents)};
        factor = power(entry->first, exponents.front());
        if (!is_final(factor, entry->first)) {
          again.push_back(factor);
          entry = powers_.erase(entry);
          continue;
        }
      }
      ++entry;
    }
    if (exp_terms_.size() > 1) {
      const Expression merged = apply(Function::exp, {sum(exp_terms_)});
      exp_terms_.clear();
      again.push_back(merged);
    }
    for (const Expression& e : again) add(e);
    return !again.empty();
  }

  static bool is_final(const Expression& factor, const Expression& base) {
    if (factor.kind() == Kind::power) return factor.args()[0] == base;
    return factor == base && (base.kind() == Kind::symbol || base.kind() == Kind::function);
  }

  Rational coefficient_ = 1;
  std::map<Expression, Power, CanonicalLess> powers_;
  std::vector<Expression> exp_terms_;
};

constexpr long kExactBits = 1 << 14;  // a power of a number with more bits is left as it is

/// The root of a non-negative integer, or -1 if it is not an integer.
Integer exact_root(const Integer& n, const Integer& order) {
  if (n < 2) return n;
  if (order > msb(n)) return -1;  // it is between 1 and 2
  const auto k = static_cast<unsigned>(order);
  Integer low = 1;
  Integer high = Integer(1) << (msb(n) / k + 1);
  while (low <= high) {
    const Integer middle = (low + high) / 2;
    const Integer raised = pow(middle, k);
    if (raised == n) return middle;
    if (raised < n) {
      low = middle + 1;
    } else {
      high = middle - 1;
    }
  }
  return -1;
}

Expression power_of_number(const Expression& base, const Expression& exponent) {
  const Rational& b = value_of(base);
  if (b == 1) return 1;
  if (b > 0 && b < 1) return power(number(1 / b), -exponent);
  if (!exponent.is_number()) return make_node(Kind::power, {base, exponent});
  const Rational& e = value_of(exponent);
  if (b == 0) {
    if (e < 0) throw std::domain_error("division by zero");
    return 0;
  }
  const Rational bits = abs(e) * static_cast<long>(msb(Integer(abs(numerator(b)) | denominator(b))) + 1);
  if (bits > kExactBits) return make_node(Kind::power, {base, exponent});
  if (denominator(e) == 1) return number(integer_power(b, e));
  if (b < 0) return make_node(Kind::power, {base, exponent});
  const Integer top = exact_root(numerator(b), denominator(e));
  const Integer bottom = exact_root(denominator(b), denominator(e));
  if (top >= 0 && bottom >= 0) return number(integer_power(Rational(top, bottom), e * denominator(e)));
  Integer whole = numerator(e) / denominator(e);
  if (e < 0) whole -= 1;
  if (whole == 0) return make_node(Kind::power, {base, exponent});
  return product({number(integer_power(b, whole)), make_node(Kind::power, {base, number(e - whole)})});
}

Expression power_of_product(const Expression& base, const Expression& exponent) {
  std::vector<Expression> outside;
  std::vector<Expression> inside;
  for (const Expression& factor : base.args()) {
    if (is_integer(exponent) || known_positive(factor)) {
      outside.push_back(power(factor, exponent));
    } else if (is_negative_number(factor) && value_of(factor) != -1) {
      outside.push_back(power(number(-value_of(factor)), exponent));
      inside.push_back(-1);
    } else {
      inside.push_back(factor);
    }
  }
  if (outside.empty()) return make_node(Kind::power, {base, exponent});
  if (!inside.empty()) outside.push_back(power(product(inside), exponent));
  return product(outside);
}

Expression power_of_sum(const Expression& base, const Expression& exponent) {
  const Scaled primitive = split_content(base, is_integer(exponent));
  if (primitive.coefficient == 1) return make_node(Kind::power, {base, exponent});
  return product({power(number(primitive.coefficient), exponent), make_node(Kind::power, {primitive.rest, exponent})});
}

}  // namespace

Scaled split_coefficient(const Expression& e) {
  if (e.is_number()) return {value_of(e), 1};
  if (e.kind() != Kind::product || !e.args().front().is_number()) return {1, e};
  std::vector<Expression> rest(e.args().begin() + 1, e.args().end());
  return {value_of(e.args().front()), rest.size() == 1 ? rest.front() : make_node(Kind::product, std::move(rest))};
}

Scaled split_content(const Expression& sum, bool signed_content) {
  Integer top = 0;
  Integer bottom = 1;
  for (const Expression& term : sum.args()) {
    const Rational coefficient = split_coefficient(term).coefficient;
    top = gcd(top, abs(numerator(coefficient)));
    bottom = lcm(bottom, denominator(coefficient));
  }
  Rational content(top, bottom);
  if (signed_content && split_coefficient(sum.args().front()).coefficient < 0) content = -content;
  return {content, content == 1 ? sum : scale_sum(sum, 1 / content)};
}

Expression scale_sum(const Expression& sum, const Rational& coefficient) {
  Terms terms;
  terms.add(sum, coefficient);
  return terms.to_expression();
}

Expression sum(const std::vector<Expression>& terms) {
  Terms collected;
  for (const Expression& term : terms) collected.add(term, 1);
  return collected.to_expression();
}

Expression product(const std::vector<Expression>& factors) {
  Factors collected;
  for (const Expression& factor : factors) collected.add(factor);
  return collected.to_expression();
}

Expression power(const Expression& base, const Expression& exponent) {
  if (exponent == Expression(0)) return 1;
  if (exponent == Expression(1)) return base;
  switch (base.kind()) {
    case Kind::number:
      return power_of_number(base, exponent);
    case Kind::product:
      return power_of_product(base, exponent);
    case Kind::sum:
      return power_of_sum(base, exponent);
    case Kind::power:
      if (!exponents_merge(base.args()[1], exponent)) break;
      return power(base.args()[0], product({base.args()[1], exponent}));
    case Kind::function:
      if (!base.is(Function::exp)) break;
      return apply(Function::exp, {product({exponent, base.args()[0]})});
    case Kind::symbol:
      break;
  }
  return make_node(Kind::power, {base, exponent});
}

}  // namespace sklar::symbolic
