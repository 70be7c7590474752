#pragma once
/// Formulas on which the symbolic engine is tested.

#include <array>
#include <random>
#include <string>
#include <vector>

#include "copula/symbolic/expression.hpp"

namespace sklar::symbolic::test {

struct GeneratorFormula {
  const char* name;
  const char* psi;  ///< in t, theta and perhaps delta
  double low;       ///< theta is tested between low
  double high;      ///< and high
};

inline const std::vector<GeneratorFormula>& generators() {
  static const std::vector<GeneratorFormula> list{{"independence", "exp(-t)", 1, 2},
                                                  {"frank", "-log(1-(1-exp(-theta))*exp(-t))/theta", -0.09, 40},
                                                  {"clayton", "(1+theta*t)^(-1/theta)", 1e-6, 100},
                                                  {"gumbel", "exp(-t^(1/theta))", 1, 50},
                                                  {"joe", "1-(1-exp(-t))^(1/theta)", 1, 50},
                                                  {"ali-mikhail-haq", "(1-theta)/(exp(t)-theta)", 0, 0.999},
                                                  {"inverse gaussian", "exp((1-sqrt(1+2*theta^2*t))/theta)", 1e-3, 100},
                                                  {"bb1", "(1+t^(1/delta))^(-1/theta)", 1e-3, 20},
                                                  {"nelsen 4.2.12", "1/(1+t^(1/theta))", 1, 20},
                                                  {"nelsen 4.2.19", "theta/log(t+exp(theta))", 0.01, 10}};
  return list;
}

/// A random formula in t and theta, of the given depth.
inline Expression random_expression(std::mt19937_64& rng, int depth) {
  const auto pick = [&rng](int n) { return static_cast<int>(rng() % static_cast<unsigned>(n)); };
  const auto smaller = [&] { return random_expression(rng, depth - 1); };
  const auto nonzero = [&](const Expression& e) { return e == Expression(0) ? Expression(2) : e; };
  if (depth == 0 || pick(6) == 0) {
    return pick(3) == 0 ? rational(pick(13) - 6, 1 + pick(4)) : symbol(pick(2) ? "t" : "theta");
  }
  constexpr std::array functions{Function::exp, Function::log,    Function::sin,     Function::cos,
                                 Function::tan, Function::atan,   Function::abs,     Function::exp,
                                 Function::log, Function::lgamma, Function::digamma, Function::lambertw};
  switch (pick(6)) {
    case 0:
      return smaller() + smaller();
    case 1:
      return smaller() - smaller();
    case 2:
      return smaller() * smaller();
    case 3:
      return smaller() / nonzero(smaller());
    case 4:
      return power(nonzero(smaller()), pick(2) ? rational(pick(9) - 4, 1 + pick(3)) : smaller());
    default:
      return apply(functions[static_cast<std::size_t>(pick(functions.size()))], {nonzero(smaller())});
  }
}

}  // namespace sklar::symbolic::test
