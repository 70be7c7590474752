#include "copula/symbolic/derive.hpp"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

#include "copula/symbolic/derivative.hpp"
#include "copula/symbolic/log_form.hpp"
#include "copula/symbolic/parser.hpp"
#include "copula/symbolic/print.hpp"
#include "copula/symbolic/ring.hpp"

namespace sklar::symbolic {

namespace {

/// Number of symbols, numbers and functions in the printed formula, where shared parts are written out each time.
class WrittenSize {
 public:
  double operator()(const Expression& e) {
    const auto known = sizes_.find(e);
    if (known != sizes_.end()) return known->second;
    double size = e.kind() == Kind::sum || e.kind() == Kind::product ? 0 : 1;
    for (const Expression& arg : e.args()) size += (*this)(arg);
    sizes_.emplace(e, size);
    return size;
  }

 private:
  std::unordered_map<Expression, double, ExpressionHash> sizes_;
};

/// The derivative with coefficients multiplied out where that is shorter, and common factors taken out.
Expression readable_derivative(const Expression& psi, const Expression& t, int order) {
  if (order == 0) return psi;
  Ring ring(t);
  Polynomial p = ring.convert(psi);
  for (int k = 0; k < order; ++k) p = ring.differentiate(p);
  WrittenSize size;
  for (auto& [monomial, coefficient] : p) {
    const Expression expanded = expand(coefficient);
    if (size(expanded) < size(coefficient)) coefficient = expanded;
  }
  const Factored factored = factor_common(Ring::to_expression(p));
  return factored.common * factored.rest;
}

}  // namespace

Language language_named(std::string_view name) {
  if (name == "text") return Language::text;
  if (name == "latex") return Language::latex;
  if (name == "cpp") return Language::cpp;
  throw std::invalid_argument("unknown language '" + std::string(name) + "'; known are text, latex, cpp");
}

std::string derive(std::string_view psi, int order, Language language) {
  const Expression f = parse(psi);
  if (order < 0 || order > kMaxDeriveOrder) {
    throw std::invalid_argument("derive: the order must be from 0 to " + std::to_string(kMaxDeriveOrder) + ", got " +
                                std::to_string(order));
  }
  const Expression t = symbol("t");
  if (language == Language::text) return to_text(readable_derivative(f, t, order));
  if (language == Language::latex) return to_latex(readable_derivative(f, t, order));
  std::vector<std::string> arguments{"t"};
  for (const std::string& name : symbols(f)) {
    if (name != "t") arguments.push_back(name);
  }
  return to_cpp(derivative(f, t, order), "dpsi_" + std::to_string(order), arguments);
}

}  // namespace sklar::symbolic
