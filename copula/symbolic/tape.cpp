#include "copula/symbolic/tape.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <unordered_map>

#include "copula/symbolic/fraction.hpp"

namespace sklar::symbolic {

namespace {

constexpr std::size_t kPairedTerms = 16;    // pairs are sought in sums of up to this many terms,
constexpr std::size_t kExpandedTerms = 4;   // and in those that have up to this many when multiplied out,
constexpr std::size_t kExpandedNodes = 64;  // which takes small expressions: the coefficients of high orders are deep

/// A pair A and -A X of terms, where X - 1 has an accurate form: A - A X = -A expm1(log X).
struct Pair {
  Expression scale;     ///< -A
  Expression exponent;  ///< log X
};

/// Splits a sum into such pairs and the terms left over.
struct PairedSum {
  std::vector<Pair> pairs;
  std::vector<Expression> rest;
};

/// log X for the factor X of a pair: an exponential or a power with an exponent that is no integer.
std::optional<Expression> exponent_of(const Expression& factor) {
  if (factor.is(Function::exp)) return factor.args()[0];
  if (factor.kind() == Kind::power && !is_integer(factor.args()[1])) return factor.args()[1] * log(factor.args()[0]);
  return std::nullopt;
}

/// The partner of a term: the index of -term / X among the terms not yet used.
std::optional<std::pair<std::size_t, Expression>> find_partner(const std::vector<Expression>& terms,
                                                               const std::vector<bool>& used, std::size_t at) {
  for (const Expression& factor : factors_of(terms[at])) {
    const auto exponent = exponent_of(factor);
    if (!exponent) continue;
    const Expression wanted = -(terms[at] / factor);
    for (std::size_t i = 0; i < terms.size(); ++i) {
      if (i == at || used[i]) continue;
      if (terms[i] == wanted) return std::pair(i, *exponent);
      if (!factor.is(Function::exp)) continue;
      for (const Expression& other : factors_of(terms[i])) {
        if (other.is(Function::exp) && terms[i] / other == wanted) return std::pair(i, *exponent - other.args()[0]);
      }
    }
  }
  return std::nullopt;
}

PairedSum find_pairs(const Expression& e) {
  const std::vector<Expression>& terms = e.args();
  std::vector<bool> used(terms.size(), false);
  PairedSum result;
  if (terms.size() <= kPairedTerms) {
    for (std::size_t i = 0; i < terms.size(); ++i) {
      if (used[i]) continue;
      const auto partner = find_partner(terms, used, i);
      if (!partner) continue;
      used[i] = used[partner->first] = true;
      result.pairs.push_back({-terms[partner->first], partner->second});
    }
  }
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (!used[i]) result.rest.push_back(terms[i]);
  }
  return result;
}

/// As it stands or multiplied out, whichever has more pairs.
PairedSum best_pairs(const Expression& e) {
  PairedSum plain = find_pairs(e);
  if (e.args().size() > kExpandedTerms || node_count(e, kExpandedNodes) == kExpandedNodes) return plain;
  const Expression expanded = expand(e, kExpandedTerms);
  if (expanded == e || expanded.kind() != Kind::sum || expanded.args().size() > kExpandedTerms) return plain;
  PairedSum other = find_pairs(expanded);
  return other.pairs.size() > plain.pairs.size() ? other : plain;
}

bool has_constant_one(const Expression& e) {
  return e.kind() == Kind::sum && e.args().front() == Expression(1);
}

}  // namespace

class TapeCompiler {
 public:
  explicit TapeCompiler(Tape& tape) : tape_(tape) {}

  std::int32_t compile(const Expression& e) {
    const auto known = slots_.find(e);
    if (known != slots_.end()) return known->second;
    const std::int32_t slot = compile_node(e);
    slots_.emplace(e, slot);
    return slot;
  }

 private:
  using Slot = std::int32_t;

  Slot emit(Op op, Slot a = 0, Slot b = 0, Slot c = 0) {
    const auto [entry, added] = emitted_.try_emplace({op, a, b, c}, static_cast<Slot>(tape_.instructions_.size()));
    if (added) tape_.instructions_.push_back({op, a, b, c});
    return entry->second;
  }

  Slot compile_node(const Expression& e) {
    switch (e.kind()) {
      case Kind::number:
        return compile_number(value_of(e));
      case Kind::symbol:
        return compile_symbol(e.name());
      case Kind::sum:
        return compile_sum(e);
      case Kind::product:
        return compile_product(e);
      case Kind::power:
        return compile_power(e.args()[0], e.args()[1]);
      case Kind::function:
        return compile_function(e);
    }
    throw std::logic_error("tape: unknown kind");
  }

  Slot compile_number(const Rational& value) {
    const TapeConstant constant{numerator(value).str(), denominator(value).str(), static_cast<double>(value), false};
    const auto same = [&](const TapeConstant& c) {
      return c.numerator == constant.numerator && c.denominator == constant.denominator;
    };
    const auto known = std::find_if(tape_.constants_.begin(), tape_.constants_.end(), same);
    const auto index = static_cast<Slot>(known - tape_.constants_.begin());
    if (known == tape_.constants_.end()) {
      tape_.constants_.push_back(constant);
      const bool finite = std::isfinite(constant.nearest);
      tape_.constants_.back().exact = finite && Rational(constant.nearest) == value;
    }
    return emit(Op::constant, index);
  }

  Slot compile_symbol(const std::string& name) {
    const auto place = std::find(tape_.inputs_.begin(), tape_.inputs_.end(), name);
    if (place == tape_.inputs_.end()) throw std::invalid_argument("tape: no input is named '" + name + "'");
    return emit(Op::input, static_cast<Slot>(place - tape_.inputs_.begin()));
  }

  // Positive terms first, so that no negation is needed where any is positive.
  Slot compile_sum(const Expression& e) {
    const PairedSum paired = best_pairs(e);
    std::vector<std::pair<bool, Slot>> parts;
    for (const Expression& term : paired.rest) parts.push_back(compile_unsigned(term));
    for (const Pair& pair : paired.pairs) {
      const auto [negative, scale] = compile_unsigned(pair.scale);
      const Slot difference = emit(Op::expm1, compile(pair.exponent));
      parts.emplace_back(negative, is_one(scale) ? difference : emit(Op::multiply, scale, difference));
    }
    std::stable_partition(parts.begin(), parts.end(), [](const auto& part) { return !part.first; });
    Slot total = parts.front().first ? emit(Op::negate, parts.front().second) : parts.front().second;
    for (auto part = parts.begin() + 1; part != parts.end(); ++part) {
      total = emit(part->first ? Op::subtract : Op::add, total, part->second);
    }
    return total;
  }

  [[nodiscard]] bool is_one(Slot slot) const {
    const Instruction& made = tape_.instructions_[slot];
    return made.op == Op::constant && tape_.constants_[made.a].exact && tape_.constants_[made.a].nearest == 1;
  }

  Slot compile_product(const Expression& e) {
    const auto [negative, slot] = compile_unsigned(e);
    return negative ? emit(Op::negate, slot) : slot;
  }

  /// Sign and magnitude of the coefficient apart.
  std::pair<bool, Slot> compile_unsigned(const Expression& e) {
    if (e.kind() != Kind::product && !is_negative_number(e)) return {false, compile(e)};
    const Fraction f = split_fraction(e);
    const Slot top = compile_factors(f.top_number, f.top);
    if (!f.has_bottom()) return {f.negative, top};
    if (f.bottom.empty() && f.top.empty()) return {f.negative, compile_number(Rational(f.top_number, f.bottom_number))};
    return {f.negative, emit(Op::divide, top, compile_factors(f.bottom_number, f.bottom))};
  }

  Slot compile_factors(const Integer& number, const std::vector<Expression>& factors) {
    std::optional<Slot> total;
    if (number != 1 || factors.empty()) total = compile_number(Rational(number));
    for (const Expression& factor : factors) {
      const Slot slot = compile(factor);
      total = total ? emit(Op::multiply, *total, slot) : slot;
    }
    return *total;
  }

  Slot compile_power(const Expression& base, const Expression& exponent) {
    if (is_negative_number(exponent)) {
      return emit(Op::divide, compile_number(1), compile(power(base, -exponent)));
    }
    if (is_integer(exponent) && value_of(exponent) < 1 << 30) {
      return emit(Op::whole_power, compile(base), static_cast<Slot>(numerator(value_of(exponent))));
    }
    if (exponent.is_number() && denominator(value_of(exponent)) == 2) {
      const Slot root = emit(Op::sqrt, compile(base));
      const Integer& n = numerator(value_of(exponent));
      if (n < 1 << 30) return n == 1 ? root : emit(Op::whole_power, root, static_cast<Slot>(n));
    }
    const Slot y = compile(exponent);
    if (!has_constant_one(base)) return emit(Op::power, compile(base), y);
    return emit(Op::power_near_one, compile(base - 1), y, compile(base));
  }

  // exp(n g) is a power of e^g or e^-g: those of all n share one call of exp.
  Slot compile_exp(const Expression& x) {
    const Scaled scaled = split_coefficient(x);
    const Rational n = abs(scaled.coefficient);
    if (x.kind() != Kind::product || denominator(n) != 1 || n == 1 || n > 1 << 20) return emit(Op::exp, compile(x));
    const Expression unit = scaled.coefficient < 0 ? -scaled.rest : scaled.rest;
    return emit(Op::whole_power, compile(exp(unit)), static_cast<Slot>(numerator(n)));
  }

  Slot compile_log(const Expression& x) {
    if (has_constant_one(x)) return emit(Op::log_near_one, compile(x - 1), 0, compile(x));
    if (x.is(Function::abs) && has_constant_one(x.args()[0])) {
      return emit(Op::log_abs_near_one, compile(x.args()[0] - 1), 0, compile(x.args()[0]));
    }
    return emit(Op::log, compile(x));
  }

  Slot compile_function(const Expression& e) {
    const Expression& x = e.args().back();
    switch (e.function()) {
      case Function::exp:
        return compile_exp(x);
      case Function::log:
        return compile_log(x);
      case Function::sin:
        return emit(Op::sin, compile(x));
      case Function::cos:
        return emit(Op::cos, compile(x));
      case Function::tan:
        return emit(Op::tan, compile(x));
      case Function::atan:
        return emit(Op::atan, compile(x));
      case Function::abs:
        return emit(Op::abs, compile(x));
      case Function::gamma:
        return emit(Op::gamma, compile(x));
      case Function::lgamma:
        return emit(Op::lgamma, compile(x));
      case Function::digamma:
        return emit(Op::digamma, compile(x));
      case Function::polygamma:
        return emit(Op::polygamma, compile(x), static_cast<Slot>(numerator(value_of(e.args()[0]))));
      case Function::lambertw:
        return emit(Op::lambertw, compile(x));
    }
    throw std::logic_error("tape: unknown function");
  }

  Tape& tape_;
  std::unordered_map<Expression, Slot, ExpressionHash> slots_;
  std::map<std::tuple<Op, Slot, Slot, Slot>, Slot> emitted_;
};

Tape::Tape(const std::vector<Expression>& outputs, std::vector<std::string> inputs) : inputs_(std::move(inputs)) {
  TapeCompiler compiler(*this);
  for (const Expression& output : outputs) outputs_.push_back(compiler.compile(output));
}

}  // namespace sklar::symbolic
