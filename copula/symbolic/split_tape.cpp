#include "copula/symbolic/split_tape.hpp"

#include <array>

namespace sklar::symbolic {

namespace {

using Slot = std::int32_t;
constexpr Slot kNone = -1;

/// The fields of an instruction that are slots of earlier ones.
std::vector<Slot Instruction::*> operand_fields(const Instruction& instruction) {
  switch (instruction.op) {
    case Op::constant:
    case Op::input:
      return {};
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::divide:
    case Op::power:
      return {&Instruction::a, &Instruction::b};
    case Op::power_near_one:
      return {&Instruction::a, &Instruction::b, &Instruction::c};
    case Op::log_near_one:
    case Op::log_abs_near_one:
      return {&Instruction::a, &Instruction::c};
    default:
      return {&Instruction::a};
  }
}

std::vector<std::string> with(std::vector<std::string> names, const std::string& name) {
  names.push_back(name);
  return names;
}

/// Instructions that need the variable, the last of the inputs.
std::vector<bool> find_moving(const Tape& tape) {
  const auto variable = static_cast<Slot>(tape.inputs().size() - 1);
  std::vector<bool> moving;
  for (const Instruction& instruction : tape.instructions()) {
    bool moves = instruction.op == Op::input && instruction.a == variable;
    for (const auto field : operand_fields(instruction))
      moves = moves || moving[static_cast<std::size_t>(instruction.*field)];
    moving.push_back(moves);
  }
  return moving;
}

}  // namespace

SplitTape::SplitTape(const std::vector<Expression>& outputs, const std::string& variable,
                     const std::vector<std::string>& parameters)
    : fixed_(outputs, with(parameters, variable)) {
  const Tape whole = fixed_;
  const std::vector<bool> moving = find_moving(whole);
  const auto moves = [&](Slot slot) { return moving[static_cast<std::size_t>(slot)]; };
  const std::size_t count = whole.instructions().size();

  // The fixed values that the second part uses, in registers 0, 1, ..
  std::vector<Slot> registers(count, kNone);
  fixed_.outputs_.clear();
  const auto use = [&](Slot slot) {
    if (moves(slot) || registers[static_cast<std::size_t>(slot)] != kNone) return;
    registers[static_cast<std::size_t>(slot)] = static_cast<Slot>(fixed_.outputs_.size());
    fixed_.outputs_.push_back(slot);
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (!moving[i]) continue;
    for (const auto field : operand_fields(whole.instructions()[i])) use(whole.instructions()[i].*field);
  }
  for (const Slot output : whole.outputs()) use(output);

  auto next = static_cast<Slot>(fixed_.outputs_.size());
  const Slot variable_register = next++;
  for (std::size_t i = 0; i < count; ++i) {
    if (!moving[i]) continue;
    Instruction instruction = whole.instructions()[i];
    if (instruction.op == Op::input) {
      registers[i] = variable_register;
      continue;
    }
    for (const auto field : operand_fields(instruction)) {
      instruction.*field = registers[static_cast<std::size_t>(instruction.*field)];
    }
    moving_.push_back(instruction);
    registers[i] = next++;
  }
  for (const Slot output : whole.outputs()) outputs_.push_back(registers[static_cast<std::size_t>(output)]);
  size_ = static_cast<std::size_t>(next);

  // The first part runs without what moves: such an instruction becomes a constant that nobody reads.
  for (std::size_t i = 0; i < count; ++i) {
    if (moving[i]) fixed_.instructions_[i] = {Op::input, 0};
  }
}

}  // namespace sklar::symbolic
