#pragma once
/// Derivatives of any order.
///
/// A function of x is held as a sum of monomials over atoms: x, exp(h), the bases of powers and other functions of x,
/// each with an exponent free of x. Atoms differentiate into the same ring, so that the n-th derivative of a generator
/// has a number of monomials that grows like n, not like 2^n. Coefficients, free of x, are shared expressions that are
/// not multiplied out: for exp(-t^(1/theta)) they follow c_{n+1,k} = (k/theta - n) c_{n,k} - c_{n,k-1}/theta, two new
/// nodes each. In a power of a sum of exponentials the one that dominates as x grows is taken out, (exp(t) - theta)^-1
/// = exp(-t) (1 - theta exp(-t))^-1, which makes the terms of a derivative fall off together instead of cancelling.

#include <memory>

#include "copula/symbolic/expression.hpp"

namespace sklar::symbolic {

/// The derivatives of one function, each computed once. Not safe for use by two threads at a time.
class Derivatives {
 public:
  /// @param x a symbol. @throws std::invalid_argument if it is not.
  Derivatives(const Expression& f, const Expression& x);

  ~Derivatives();
  Derivatives(Derivatives&&) noexcept;
  Derivatives& operator=(Derivatives&&) noexcept;

  /// d^order f / dx^order; order 0 is f itself. Orders below are computed on the way and kept.
  /// @throws std::invalid_argument if order < 0.
  [[nodiscard]] const Expression& operator()(int order);

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// d^order f / dx^order. @throws as Derivatives.
[[nodiscard]] Expression derivative(const Expression& f, const Expression& x, int order = 1);

}  // namespace sklar::symbolic
