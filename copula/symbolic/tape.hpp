#pragma once
/// A list of expressions as straight-line code: one instruction a distinct node, to be run in any real type.
///
/// The compiler chooses forms that keep digits: A e^g - A becomes A expm1(g), A b^y - A with non-integer y becomes
/// A expm1(y log b), log(1+x) and (1+x)^y use log1p(x) for small x, products of whole powers stay products.

#include <cstdint>
#include <string>
#include <vector>

#include "copula/symbolic/expression.hpp"

namespace sklar::symbolic {

/// Operands are the results of earlier instructions unless said otherwise.
enum class Op : std::uint8_t {
  constant,          ///< a: index into constants
  input,             ///< a: index into inputs
  add,               ///< a + b
  subtract,          ///< a - b
  multiply,          ///< a * b
  divide,            ///< a / b
  negate,            ///< -a
  whole_power,       ///< a^b, b itself an integer >= 2
  power,             ///< a^b
  power_near_one,    ///< c^b where c = 1 + a
  log_near_one,      ///< log(c) where c = 1 + a
  log_abs_near_one,  ///< log|c| where c = 1 + a
  sqrt,
  exp,
  expm1,
  log,
  sin,
  cos,
  tan,
  atan,
  abs,
  gamma,
  lgamma,
  digamma,
  polygamma,  ///< of order b, b itself an integer, at a
  lambertw
};

/// An operation and where its operands are.
struct Instruction {
  Op op;
  std::int32_t a = 0;
  std::int32_t b = 0;
  std::int32_t c = 0;
};

/// A rational number, exactly and as the nearest double.
struct TapeConstant {
  std::string numerator;    ///< decimal digits, perhaps with a minus
  std::string denominator;  ///< decimal digits
  double nearest;
  bool exact;  ///< nearest is the number itself
};

class Tape {
 public:
  /// @param inputs names of the symbols, in the order in which their values will be given.
  /// @throws std::invalid_argument for a symbol that is not among the inputs.
  Tape(const std::vector<Expression>& outputs, std::vector<std::string> inputs);

  [[nodiscard]] const std::vector<Instruction>& instructions() const noexcept { return instructions_; }
  [[nodiscard]] const std::vector<TapeConstant>& constants() const noexcept { return constants_; }
  [[nodiscard]] const std::vector<std::string>& inputs() const noexcept { return inputs_; }
  [[nodiscard]] const std::vector<std::int32_t>& outputs() const noexcept { return outputs_; }  ///< instruction indices

 private:
  friend class TapeCompiler;
  friend class SplitTape;

  std::vector<std::string> inputs_;
  std::vector<Instruction> instructions_;
  std::vector<TapeConstant> constants_;
  std::vector<std::int32_t> outputs_;
};

}  // namespace sklar::symbolic
