#pragma once
/// A tape run in a given real type: double, long double, a Boost.Multiprecision number, or Bounded of any of them.

#include <algorithm>
#include <span>
#include <stdexcept>
#include <vector>

#include "copula/symbolic/real_functions.hpp"
#include "copula/symbolic/tape.hpp"

namespace sklar::symbolic {

/// A rational constant in a real type.
template <class Real>
struct FromConstant {
  static Real convert(const TapeConstant& c) {
    if (c.exact) return Real(c.nearest);
    return Real(Real(c.numerator) / Real(c.denominator));
  }
};
/// The nearest double, as it is stored.
template <>
struct FromConstant<double> {
  static double convert(const TapeConstant& c) { return c.nearest; }
};
/// In the precision of the type.
template <>
struct FromConstant<long double> {
  static long double convert(const TapeConstant& c) {
    return c.exact ? c.nearest : std::stold(c.numerator) / std::stold(c.denominator);
  }
};
/// With the error of rounding.
template <class Real>
struct FromConstant<Bounded<Real>> {
  static Bounded<Real> convert(const TapeConstant& c) {
    using std::abs, std::isfinite;
    const Real value = FromConstant<Real>::convert(c);
    if (c.exact) return {value, Real(0)};
    if (!isfinite(value)) return {value, Bounded<Real>::unknown()};
    return {value, Real(2 * std::numeric_limits<Real>::epsilon() * abs(value) + Bounded<Real>::underflow())};
  }
};

/// The instructions on registers of kWidth lanes each.
template <class Real, std::size_t kWidth>
class Lanes {
 public:
  explicit Lanes(Real* registers) : registers_(registers) {}

  [[nodiscard]] Real* at(std::int32_t slot) const { return registers_ + static_cast<std::size_t>(slot) * kWidth; }

  /// Any instruction but constant and input, on the first count lanes.
  void run(const Instruction& instruction, Real* out, std::size_t count) const {
    instruction.op <= Op::log_abs_near_one ? run_arithmetic(instruction, out, count)
                                           : run_function(instruction, out, count);
  }

 private:
  template <class F>
  static void each(Real* out, std::size_t count, F f) {
    for (std::size_t i = 0; i < count; ++i) out[i] = f(i);
  }

  void run_arithmetic(const Instruction& instruction, Real* out, std::size_t count) const {
    const Real* a = at(instruction.a);
    const int whole = instruction.b;
    const Real* b = instruction.op == Op::whole_power ? a : at(instruction.b);
    const Real* c = at(instruction.c);
    switch (instruction.op) {
      case Op::add:
        return each(out, count, [=](std::size_t i) { return Real(a[i] + b[i]); });
      case Op::subtract:
        return each(out, count, [=](std::size_t i) { return Real(a[i] - b[i]); });
      case Op::multiply:
        return each(out, count, [=](std::size_t i) { return Real(a[i] * b[i]); });
      case Op::divide:
        return each(out, count, [=](std::size_t i) { return Real(a[i] / b[i]); });
      case Op::negate:
        return each(out, count, [=](std::size_t i) { return Real(-a[i]); });
      case Op::whole_power:
        return each(out, count, [=](std::size_t i) { return real::whole_power(a[i], whole); });
      case Op::power:
        return each(out, count, [=](std::size_t i) { return real::power(a[i], b[i]); });
      case Op::power_near_one:
        return each(out, count, [=](std::size_t i) { return power_near_one(a[i], b[i], c[i]); });
      case Op::log_near_one:
        return each(out, count, [=](std::size_t i) { return log_near_one(a[i], c[i]); });
      case Op::log_abs_near_one:
        return each(out, count, [=](std::size_t i) { return log_near_one(a[i], absolute(c[i])); });
      default:
        break;
    }
  }

  void run_function(const Instruction& instruction, Real* out, std::size_t count) const {
    using real::sin, real::cos, real::tan, real::atan;
    using std::exp, std::expm1, std::log, std::sqrt, std::sin, std::cos, std::tan, std::atan;
    const Real* a = at(instruction.a);
    switch (instruction.op) {
      case Op::sqrt:
        return each(out, count, [=](std::size_t i) { return Real(sqrt(a[i])); });
      case Op::exp:
        return each(out, count, [=](std::size_t i) { return Real(exp(a[i])); });
      case Op::expm1:
        return each(out, count, [=](std::size_t i) { return Real(expm1(a[i])); });
      case Op::log:
        return each(out, count, [=](std::size_t i) { return Real(log(a[i])); });
      case Op::sin:
        return each(out, count, [=](std::size_t i) { return Real(sin(a[i])); });
      case Op::cos:
        return each(out, count, [=](std::size_t i) { return Real(cos(a[i])); });
      case Op::tan:
        return each(out, count, [=](std::size_t i) { return Real(tan(a[i])); });
      case Op::atan:
        return each(out, count, [=](std::size_t i) { return Real(atan(a[i])); });
      case Op::abs:
        return each(out, count, [=](std::size_t i) { return absolute(a[i]); });
      case Op::gamma:
        return each(out, count, [=](std::size_t i) { return real::gamma(a[i]); });
      case Op::lgamma:
        return each(out, count, [=](std::size_t i) { return real::lgamma(a[i]); });
      case Op::digamma:
        return each(out, count, [=](std::size_t i) { return real::digamma(a[i]); });
      case Op::polygamma:
        return each(out, count, [=, order = instruction.b](std::size_t i) { return real::polygamma(order, a[i]); });
      case Op::lambertw:
        return each(out, count, [=](std::size_t i) { return real::lambertw(a[i]); });
      default:
        break;
    }
  }

  static Real absolute(const Real& x) {
    using std::abs;
    return abs(x);
  }

  // Both forms hold everywhere; |x| = 1/2 is where their errors are about the same.
  static bool is_small(const Real& x) { return real::value_of(x) > -0.5 && real::value_of(x) < 0.5; }

  static Real log_near_one(const Real& x, const Real& one_plus_x) {
    using std::log, std::log1p;
    return is_small(x) ? Real(log1p(x)) : Real(log(one_plus_x));
  }

  static Real power_near_one(const Real& x, const Real& y, const Real& one_plus_x) {
    using std::exp, std::log1p;
    return is_small(x) ? Real(exp(Real(y * log1p(x)))) : Real(real::power(one_plus_x, y));
  }

  Real* registers_;
};

/// Runs a tape on rows of inputs, kWidth rows an instruction. Holds its registers: one evaluator a thread.
template <class Real, std::size_t kWidth = 16>
class TapeEvaluator {
 public:
  /// The tape must outlive the evaluator. Constants are converted here, in the precision in force.
  explicit TapeEvaluator(const Tape& tape) : tape_(tape), registers_(tape.instructions().size() * kWidth, Real(0)) {
    for (const TapeConstant& constant : tape.constants()) constants_.push_back(FromConstant<Real>::convert(constant));
  }

  /// @param inputs rows x tape.inputs().size(), row after row. @param outputs rows x tape.outputs().size(), likewise.
  /// @throws std::invalid_argument unless both hold the same whole number of rows.
  void operator()(std::span<const Real> inputs, std::span<Real> outputs) {
    const std::size_t m = tape_.outputs().size();
    const std::size_t n = tape_.inputs().size();
    if (m == 0) return;
    const std::size_t rows = outputs.size() / m;
    if (rows * m != outputs.size() || rows * n != inputs.size()) {
      throw std::invalid_argument("tape: inputs and outputs do not hold the same whole number of rows");
    }
    for (std::size_t row = 0; row < rows; row += kWidth) {
      const std::size_t count = std::min(kWidth, rows - row);
      run(inputs.subspan(row * n, count * n), n, count);
      for (std::size_t j = 0; j < m; ++j) {
        const Real* result = Lanes<Real, kWidth>(registers_.data()).at(tape_.outputs()[j]);
        for (std::size_t i = 0; i < count; ++i) outputs[(row + i) * m + j] = result[i];
      }
    }
  }

 private:
  void run(std::span<const Real> inputs, std::size_t n, std::size_t count) {
    const Lanes<Real, kWidth> lanes(registers_.data());
    std::int32_t slot = 0;
    for (const Instruction& instruction : tape_.instructions()) {
      Real* out = lanes.at(slot++);
      if (instruction.op == Op::constant) {
        std::fill_n(out, count, constants_[static_cast<std::size_t>(instruction.a)]);
      } else if (instruction.op == Op::input) {
        for (std::size_t i = 0; i < count; ++i) out[i] = inputs[i * n + static_cast<std::size_t>(instruction.a)];
      } else {
        lanes.run(instruction, out, count);
      }
    }
  }

  const Tape& tape_;
  std::vector<Real> constants_;
  std::vector<Real> registers_;
};

}  // namespace sklar::symbolic
