// Canonical function applications, positivity, multiplying out.

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <stdexcept>

#include "copula/symbolic/node.hpp"

namespace sklar::symbolic {

namespace {

struct FunctionInfo {
  Function function;
  const char* name;
  int arity;
};

constexpr std::array<FunctionInfo, 12> kFunctions{{{Function::exp, "exp", 1},
                                                   {Function::log, "log", 1},
                                                   {Function::sin, "sin", 1},
                                                   {Function::cos, "cos", 1},
                                                   {Function::tan, "tan", 1},
                                                   {Function::atan, "atan", 1},
                                                   {Function::abs, "abs", 1},
                                                   {Function::gamma, "gamma", 1},
                                                   {Function::lgamma, "lgamma", 1},
                                                   {Function::digamma, "digamma", 1},
                                                   {Function::polygamma, "polygamma", 2},
                                                   {Function::lambertw, "lambertw", 1}}};

const FunctionInfo& info(Function function) {
  return kFunctions[static_cast<std::size_t>(function)];
}

/// x^y for a term y log(x), else nothing.
std::optional<Expression> power_from_log(const Expression& term) {
  std::vector<Expression> factors = factors_of(term);
  const auto log = std::find_if(factors.begin(), factors.end(), [](const auto& f) { return f.is(Function::log); });
  if (log == factors.end()) return std::nullopt;
  const Expression base = log->args()[0];
  factors.erase(log);
  return power(base, product(factors));
}

Expression apply_exp(const Expression& x) {
  if (x == Expression(0)) return 1;
  std::vector<Expression> powers;
  std::vector<Expression> rest;
  for (const Expression& term : terms_of(x)) {
    if (const auto from_log = power_from_log(term)) {
      powers.push_back(*from_log);
    } else {
      rest.push_back(term);
    }
  }
  if (powers.empty()) return make_node(Kind::function, {x}, Function::exp);
  powers.push_back(apply_exp(sum(rest)));
  return product(powers);
}

Expression apply_log(const Expression& x) {
  if (x == Expression(1)) return 0;
  if (x.is(Function::exp)) return x.args()[0];
  if (x.is_number() && value_of(x) > 0 && value_of(x) < 1) return -apply_log(number(1 / value_of(x)));
  if (x.kind() == Kind::power && (known_positive(x.args()[0]) || exponents_merge(x.args()[1], rational(1, 2)))) {
    return product({x.args()[1], apply_log(x.args()[0])});
  }
  return make_node(Kind::function, {x}, Function::log);
}

Expression apply_abs(const Expression& x) {
  if (x.is_number()) return number(abs(value_of(x)));
  if (known_positive(x) || x.is(Function::abs)) return x;
  if (x.kind() == Kind::sum) {
    const Scaled primitive = split_content(x, true);
    if (primitive.coefficient == 1) return make_node(Kind::function, {x}, Function::abs);
    return product({number(abs(primitive.coefficient)), apply_abs(primitive.rest)});
  }
  const Scaled scaled = split_coefficient(x);
  if (scaled.coefficient == 1) return make_node(Kind::function, {x}, Function::abs);
  return product({number(abs(scaled.coefficient)), apply_abs(scaled.rest)});
}

Expression apply_gamma(const Expression& x) {
  if (!is_integer(x) || value_of(x) < 1 || value_of(x) > 171) return make_node(Kind::function, {x}, Function::gamma);
  Integer factorial = 1;
  for (Integer k = 2; k < numerator(value_of(x)); ++k) factorial *= k;
  return number(Rational(factorial));
}

Expression apply_polygamma(const Expression& order, const Expression& x) {
  if (!is_integer(order) || value_of(order) < 0 || value_of(order) > 10000) {
    throw std::invalid_argument("polygamma: its first argument, the order, must be a whole number from 0 to 10000");
  }
  if (value_of(order) == 0) return apply(Function::digamma, {x});
  return make_node(Kind::function, {order, x}, Function::polygamma);
}

}  // namespace

const char* function_name(Function function) noexcept {
  return info(function).name;
}

int arity(Function function) noexcept {
  return info(function).arity;
}

Expression apply(Function function, const std::vector<Expression>& args) {
  if (static_cast<int>(args.size()) != arity(function)) {
    throw std::invalid_argument(std::string(function_name(function)) + " takes " + std::to_string(arity(function)) +
                                (arity(function) == 1 ? " argument, got " : " arguments, got ") +
                                std::to_string(args.size()));
  }
  const Expression& x = args.front();
  switch (function) {
    case Function::exp:
      return apply_exp(x);
    case Function::log:
      return apply_log(x);
    case Function::abs:
      return apply_abs(x);
    case Function::gamma:
      return apply_gamma(x);
    case Function::polygamma:
      return apply_polygamma(x, args[1]);
    case Function::lgamma:
      if (x == Expression(1) || x == Expression(2)) return 0;
      break;
    case Function::cos:
      if (x == Expression(0)) return 1;
      break;
    case Function::sin:
    case Function::tan:
    case Function::atan:
    case Function::lambertw:
      if (x == Expression(0)) return 0;
      break;
    case Function::digamma:
      break;
  }
  return make_node(Kind::function, args, function);
}

// A base under a non-integer exponent is not negative, and neither is one whose odd power carries such an exponent.
bool exponents_merge(const Expression& inner, const Expression& outer) {
  return is_integer(outer) || !is_integer(inner) || numerator(value_of(inner)) % 2 != 0;
}

namespace {

class Expander {
 public:
  explicit Expander(std::size_t max_terms) : max_terms_(max_terms) {}

  Expression expand(const Expression& e) {
    if (e.kind() != Kind::sum && e.kind() != Kind::product && e.kind() != Kind::power) return e;
    const auto known = done_.find(e);
    if (known != done_.end()) return known->second;
    const Expression result = expand_node(e);
    done_.emplace(e, result);
    return result;
  }

 private:
  Expression expand_node(const Expression& e) {
    if (e.kind() == Kind::power) {
      const Expression base = expand(e.args()[0]);
      const Expression raised = power(base, e.args()[1]);
      const bool whole = is_integer(e.args()[1]) && value_of(e.args()[1]) > 1 && value_of(e.args()[1]) < 1000;
      if (!whole || base.kind() != Kind::sum) return raised;
      return multiply_out(std::vector(static_cast<std::size_t>(numerator(value_of(e.args()[1]))), base))
          .value_or(raised);
    }
    std::vector<Expression> args;
    for (const Expression& arg : e.args()) args.push_back(expand(arg));
    if (e.kind() == Kind::sum) return sum(args);
    return multiply_out(args).value_or(product(args));
  }

  std::optional<Expression> multiply_out(const std::vector<Expression>& factors) const {
    Expression result = 1;
    for (const Expression& factor : factors) {
      const std::vector<Expression> left = terms_of(result);
      const std::vector<Expression> right = terms_of(factor);
      if (left.size() * right.size() > max_terms_) return std::nullopt;
      std::vector<Expression> terms;
      for (const Expression& a : left) {
        for (const Expression& b : right) terms.push_back(product({a, b}));
      }
      result = sum(terms);
    }
    return result;
  }

  std::size_t max_terms_;
  std::map<Expression, Expression, CanonicalLess> done_;
};

}  // namespace

Expression expand(const Expression& e, std::size_t max_terms) {
  return Expander(max_terms).expand(e);
}

}  // namespace sklar::symbolic
