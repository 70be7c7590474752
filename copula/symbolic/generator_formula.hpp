#pragma once
/// psi as a formula and all that follows from it without values for its parameters.

#include <memory>
#include <mutex>
#include <optional>

#include "copula/symbolic/derivative.hpp"
#include "copula/symbolic/split_tape.hpp"

namespace sklar::symbolic {

/// Highest dimension of a copula whose generator is a formula.
inline constexpr int kMaxDimension = 20;

/// Immutable for its users and safe to share between threads; derivatives are made when first asked for.
class GeneratorFormula {
 public:
  /// @param psi in t and the parameters. @param inverse psi^-1 in u and the parameters; without it one is derived where
  /// t occurs once. @throws std::invalid_argument for any other symbol.
  GeneratorFormula(const Expression& psi, const std::optional<Expression>& inverse,
                   std::vector<std::string> parameters);

  [[nodiscard]] const std::vector<std::string>& parameters() const { return parameters_; }

  /// Of t: log|psi^(order)|, then the conditions() that must be positive inside the support, then factors whose product
  /// has the sign of psi^(order). The conditions are the bases of powers with an exponent that is no integer, and the
  /// arguments of logarithms: (1 + theta t)_+^(-1/theta). @param order 0 to kMaxDimension.
  [[nodiscard]] const SplitTape& derivative(int order) const;
  [[nodiscard]] std::size_t conditions() const { return conditions_.size(); }

  /// Of t: log psi with small relative error for small t, given psi(0) = 1. May be missing, as the next two.
  [[nodiscard]] const SplitTape* log_psi_near_zero() const { return near_zero_.get(); }

  /// psi^-1, of u and of 1 - u; the second with small relative error for small 1 - u.
  [[nodiscard]] const SplitTape* inverse() const { return inverse_.get(); }
  [[nodiscard]] const SplitTape* inverse_near_one() const { return inverse_near_one_.get(); }
  [[nodiscard]] bool inverse_is_given() const { return inverse_is_given_; }

 private:
  using TapePtr = std::unique_ptr<const SplitTape>;

  [[nodiscard]] TapePtr compile(const Expression& e, const char* variable) const;

  std::vector<std::string> parameters_;
  std::vector<Expression> conditions_;
  TapePtr near_zero_, inverse_, inverse_near_one_;
  bool inverse_is_given_;

  mutable std::mutex mutex_;
  mutable Derivatives psi_;
  mutable std::vector<TapePtr> derivatives_;
};

}  // namespace sklar::symbolic
