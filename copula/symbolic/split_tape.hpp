#pragma once
/// A tape in one variable and parameters, in two parts: what is free of the variable is computed once for given
/// parameters, the rest at each value of the variable.

#include <span>
#include <vector>

#include "copula/symbolic/tape_evaluator.hpp"

namespace sklar::symbolic {

class SplitTape {
 public:
  /// @param parameters names of the symbols other than the variable, in the order in which their values will be given.
  /// @throws std::invalid_argument for a symbol that is neither.
  SplitTape(const std::vector<Expression>& outputs, const std::string& variable,
            const std::vector<std::string>& parameters);

  /// The outputs at one value.
  template <class T>
  class Values {
   public:
    Values(const T* registers, std::span<const std::int32_t> slots) : registers_(registers), slots_(slots) {}
    [[nodiscard]] std::size_t size() const { return slots_.size(); }
    [[nodiscard]] const T& operator[](std::size_t i) const { return registers_[slots_[i]]; }

   private:
    const T* registers_;
    std::span<const std::int32_t> slots_;
  };

  /// The part free of the variable, for run, in the precision in force.
  template <class T>
  [[nodiscard]] std::vector<T> prepare(std::span<const double> parameters) const {
    std::vector<T> inputs;
    for (const double parameter : parameters) inputs.emplace_back(parameter);
    inputs.emplace_back(0.0);  // the variable, which this part does not use
    std::vector<T> prepared(fixed_.outputs().size());
    TapeEvaluator<T, 1> evaluate(fixed_);
    evaluate(inputs, prepared);
    return prepared;
  }

  /// @param prepared as returned by prepare. @return valid until this thread calls run again; no heap allocation in
  /// double once the thread has run a tape as long as this one.
  template <class T>
  [[nodiscard]] Values<T> run(std::span<const T> prepared, const T& x) const {
    thread_local std::vector<T> registers;
    if (registers.size() < size_) registers.resize(size_);
    std::copy(prepared.begin(), prepared.end(), registers.begin());
    registers[prepared.size()] = x;
    const Lanes<T, 1> lanes(registers.data());
    T* out = registers.data() + prepared.size();
    for (const Instruction& instruction : moving_) lanes.run(instruction, ++out, 1);
    return {registers.data(), outputs_};
  }

 private:
  Tape fixed_;                         ///< its outputs are the first registers of the second part, x the next one
  std::vector<Instruction> moving_;    ///< the registers after that, one each
  std::vector<std::int32_t> outputs_;  ///< registers
  std::size_t size_ = 0;
};

}  // namespace sklar::symbolic
