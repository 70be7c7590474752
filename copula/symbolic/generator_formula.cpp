#include "copula/symbolic/generator_formula.hpp"

#include <algorithm>
#include <stdexcept>
#include <unordered_set>

#include "copula/symbolic/log_form.hpp"
#include "copula/symbolic/near_zero.hpp"
#include "copula/symbolic/node.hpp"

namespace sklar::symbolic {

namespace {

const Expression& t_symbol() {
  static const Expression t = symbol("t");
  return t;
}

/// What must be positive for a formula to be real, inner conditions before outer ones.
class Conditions {
 public:
  void collect(const Expression& e) {
    if (!e.depends_on(t_symbol()) || !seen_.insert(e).second) return;
    for (const Expression& arg : e.args()) collect(arg);
    const bool root = e.kind() == Kind::power && !is_integer(e.args()[1]);
    if (root || e.is(Function::log)) require_positive(e.args()[0]);
  }

  [[nodiscard]] const std::vector<Expression>& found() const { return found_; }

 private:
  // t itself is never negative.
  void require_positive(const Expression& e) {
    if (e == t_symbol() || known_positive(e) || !e.depends_on(t_symbol())) return;
    if (std::find(found_.begin(), found_.end(), e) == found_.end()) found_.push_back(e);
  }

  std::unordered_set<Expression, ExpressionHash> seen_;
  std::vector<Expression> found_;
};

std::vector<Expression> conditions_of(const Expression& psi) {
  Conditions conditions;
  conditions.collect(psi);
  return conditions.found();
}

/// f(1 - w) as what it grows from w = 0 on, for f with f(1) = 0.
std::optional<Expression> growth_from_one(const Expression& f, const Expression& u, const Expression& w) {
  try {
    const auto near = near_zero(substitute(f, u, 1 - w), w);
    return near ? std::optional(near->growth) : std::nullopt;
  } catch (const std::domain_error&) {  // a division by what is 0 at u = 1
    return std::nullopt;
  }
}

std::optional<Expression> log_from_zero(const Expression& psi) {
  try {
    const auto near = near_zero(psi, t_symbol());
    return near ? std::optional(log(1 + near->growth)) : std::nullopt;
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

std::optional<Expression> solve(const Expression& psi, const Expression& u) {
  try {
    return solve_for(psi, t_symbol(), u);
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

}  // namespace

GeneratorFormula::GeneratorFormula(const Expression& psi, const std::optional<Expression>& inverse,
                                   std::vector<std::string> parameters)
    : parameters_(std::move(parameters)),
      conditions_(conditions_of(psi)),
      inverse_is_given_(inverse.has_value()),
      psi_(psi, t_symbol()),
      derivatives_(kMaxDimension + 1) {
  const Expression u = symbol("u");
  const Expression w = symbol("w");
  const auto compile_any = [this](const std::optional<Expression>& e, const char* variable) {
    return e ? compile(*e, variable) : nullptr;
  };
  near_zero_ = compile_any(log_from_zero(psi), "t");
  const std::optional<Expression> found = inverse ? inverse : solve(psi, u);
  if (!found) return;
  inverse_ = compile(*found, "u");
  inverse_near_one_ = compile_any(growth_from_one(*found, u, w), "w");
}

GeneratorFormula::TapePtr GeneratorFormula::compile(const Expression& e, const char* variable) const {
  return std::make_unique<const SplitTape>(std::vector{e}, variable, parameters_);
}

const SplitTape& GeneratorFormula::derivative(int order) const {
  const std::lock_guard lock(mutex_);
  TapePtr& tape = derivatives_.at(static_cast<std::size_t>(order));
  if (!tape) {
    LogForm form = log_form(psi_(order));
    std::vector<Expression> outputs{form.log_abs};
    outputs.insert(outputs.end(), conditions_.begin(), conditions_.end());
    outputs.insert(outputs.end(), form.sign_factors.begin(), form.sign_factors.end());
    tape = std::make_unique<const SplitTape>(outputs, "t", parameters_);
  }
  return *tape;
}

}  // namespace sklar::symbolic
