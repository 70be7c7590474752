#include "copula/symbolic/near_zero.hpp"

#include <unordered_map>

#include "copula/symbolic/node.hpp"

namespace sklar::symbolic {

namespace {

constexpr int kLargestProduct = 4;  // whole powers up to this one are taken as products

std::optional<NearZero> near_zero_of_product(const std::vector<Expression>& factors, const Expression& x) {
  NearZero total{1, 0};
  for (const Expression& factor : factors) {
    const auto next = near_zero(factor, x);
    if (!next) return std::nullopt;
    total = {total.at_zero * next->at_zero, total.growth * factor + total.at_zero * next->growth};
  }
  return total;
}

std::optional<NearZero> near_zero_of_power(const Expression& f, const Expression& x) {
  const Expression& base = f.args()[0];
  const Expression& exponent = f.args()[1];
  if (exponent.depends_on(x)) return std::nullopt;
  if (is_integer(exponent) && value_of(exponent) > 0 && value_of(exponent) <= kLargestProduct) {
    return near_zero_of_product(std::vector<Expression>(static_cast<std::size_t>(numerator(value_of(exponent))), base),
                                x);
  }
  const auto inside = near_zero(base, x);
  if (!inside) return std::nullopt;
  if (inside->at_zero == Expression(0)) {
    if (is_negative_number(exponent)) return std::nullopt;
    return NearZero{0, power(inside->growth, exponent)};
  }
  if (exponent == Expression(-1)) return NearZero{1 / inside->at_zero, -inside->growth / (inside->at_zero * base)};
  const Expression at_zero = power(inside->at_zero, exponent);
  return NearZero{at_zero, at_zero * (power(1 + inside->growth / inside->at_zero, exponent) - 1)};
}

std::optional<NearZero> near_zero_of_function(const Expression& f, const Expression& x) {
  if (!f.is(Function::exp) && !f.is(Function::log)) return std::nullopt;
  const auto inside = near_zero(f.args()[0], x);
  if (!inside) return std::nullopt;
  if (f.is(Function::exp)) return NearZero{exp(inside->at_zero), exp(inside->at_zero) * (exp(inside->growth) - 1)};
  if (inside->at_zero == Expression(0)) return std::nullopt;
  return NearZero{log(inside->at_zero), log(1 + inside->growth / inside->at_zero)};
}

/// The one argument that depends on x, if it is only one.
std::optional<std::size_t> only_dependent(const Expression& e, const Expression& x) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < e.args().size(); ++i) {
    if (!e.args()[i].depends_on(x)) continue;
    if (found) return std::nullopt;
    found = i;
  }
  return found;
}

class Substitution {
 public:
  Substitution(const Expression& symbol, const Expression& replacement) : symbol_(symbol), replacement_(replacement) {}

  Expression operator()(const Expression& e) {
    if (!e.depends_on(symbol_)) return e;
    if (e == symbol_) return replacement_;
    const auto known = done_.find(e);
    if (known != done_.end()) return known->second;
    std::vector<Expression> args;
    for (const Expression& arg : e.args()) args.push_back((*this)(arg));
    const Expression result = rebuild(e, args);
    done_.emplace(e, result);
    return result;
  }

 private:
  static Expression rebuild(const Expression& e, const std::vector<Expression>& args) {
    if (e.kind() == Kind::sum) return sum(args);
    if (e.kind() == Kind::product) return product(args);
    if (e.kind() == Kind::power) return power(args[0], args[1]);
    return apply(e.function(), args);
  }

  const Expression& symbol_;
  const Expression& replacement_;
  std::unordered_map<Expression, Expression, ExpressionHash> done_;
};

}  // namespace

std::optional<NearZero> near_zero(const Expression& f, const Expression& x) {
  if (!f.depends_on(x)) return NearZero{f, 0};
  if (f == x) return NearZero{0, x};
  if (f.kind() == Kind::product) return near_zero_of_product(f.args(), x);
  if (f.kind() == Kind::power) return near_zero_of_power(f, x);
  if (f.kind() == Kind::function) return near_zero_of_function(f, x);
  NearZero total{0, 0};
  for (const Expression& term : f.args()) {
    const auto next = near_zero(term, x);
    if (!next) return std::nullopt;
    total = {total.at_zero + next->at_zero, total.growth + next->growth};
  }
  return total;
}

std::optional<Expression> solve_for(const Expression& f, const Expression& x, const Expression& y) {
  if (f == x) return y;
  const auto at = only_dependent(f, x);
  if (!at) return std::nullopt;
  const Expression& inside = f.args()[*at];
  switch (f.kind()) {
    case Kind::sum:
      return solve_for(inside, x, y - (f - inside));
    case Kind::product:
      return solve_for(inside, x, y / (f / inside));
    case Kind::power:
      return solve_for(inside, x, *at == 0 ? power(y, 1 / f.args()[1]) : log(y) / log(f.args()[0]));
    case Kind::function:
      if (f.is(Function::exp)) return solve_for(inside, x, log(y));
      if (f.is(Function::log)) return solve_for(inside, x, exp(y));
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

Expression substitute(const Expression& e, const Expression& symbol, const Expression& replacement) {
  return Substitution(symbol, replacement)(e);
}

}  // namespace sklar::symbolic
