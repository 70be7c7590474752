#include "copula/symbolic/generator_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "copula/error.hpp"
#include "copula/first_answer.hpp"

namespace sklar::symbolic {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::array kLevels{1 - 1e-6, 0.999, 0.99, 0.95, 0.8, 0.6, 0.4, 0.2, 0.05, 1e-2, 1e-4, 1e-8};
constexpr double kUnitTolerance = 1e-14;  ///< of psi(0) = 1: constants may be given to 15 digits
constexpr double kNearlyZero = 1e-300;    ///< a t for psi(0) where the formula has no value at 0
constexpr double kFarLogT = 9000;         ///< log t, in the range of long double, for the limit where a formula has
constexpr double kLogVanishing = -20;     ///< no value at infinity, and a log psi there that is low enough
constexpr double kLargestT = 1e300;       ///< of the arguments at which signs are checked

class Check {
 public:
  Check(const SymbolicGenerator& generator, int dim, const std::string& subject)
      : generator_(generator), dim_(dim), subject_(subject) {}

  void value_at_zero() const {
    const double zero = std::isfinite(log_psi(0)) ? 0 : kNearlyZero;
    const double found = log_psi(zero);
    if (std::abs(found) <= kUnitTolerance) return;
    refuse("psi(" + to_text(zero) + ") must be 1, found " + to_text(std::exp(found)));
  }

  void limit() const {
    if (vanishes()) return;
    refuse("psi(t) must tend to 0 as t grows, found psi(1e300) = " + to_text(std::exp(log_psi(kLargestT))));
  }

  void signs() const {
    for (const double t : arguments()) {
      for (int order = 0; order <= dim_; ++order) require_sign(order, t);
    }
  }

 private:
  /// NaN where it is not resolved.
  [[nodiscard]] double log_psi(double t) const {
    const auto value =
        first_answer([&]<class T>() { return if_within(1e-15, generator_.log_psi(T(t))); }, kFirstDigits);
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
  }

  /// At infinity itself, or else far beyond the range of double. log psi of a generator still falls there: twice as far
  /// in log t it doubles for a power of t, and grows by 8 % for a power of log t.
  [[nodiscard]] bool vanishes() const {
    const Narrow limit = generator_.log_psi(Narrow(kInfinity));
    if (std::isfinite(limit.error)) return limit.value == -kInfinity;
    const auto falls = first_answer(
        [this]<class T>() -> std::optional<bool> {
          const T far = generator_.log_psi(exp(T(kFarLogT)));
          const T half_way = generator_.log_psi(exp(T(kFarLogT / 2)));
          using std::isfinite;
          if (!isfinite(far.error) || !isfinite(half_way.error)) return std::nullopt;
          return far.value + far.error < kLogVanishing ||
                 far.value + far.error < 1.05 * (half_way.value - half_way.error);
        },
        kFirstDigits);
    return falls.value_or(false);
  }

  [[nodiscard]] std::vector<double> arguments() const {
    std::vector<double> points;
    for (const double level : kLevels) {
      const double t = generator_.psi_inv(Narrow(level)).value;
      if (t > 0 && t < kInfinity) points.push_back(t);
    }
    const auto [least, most] = std::minmax_element(points.begin(), points.end());
    const double low = points.empty() ? 1e-6 : *least / 10;
    const double high = points.empty() ? 1e6 : std::min(*most * 100, kLargestT);
    const auto rest = kCheckedPoints - static_cast<int>(kLevels.size());
    const double log_low = std::log(low), log_step = (std::log(high) - log_low) / rest;
    for (int i = 0; i < rest; ++i) points.push_back(std::exp(log_low + (i + 0.5) * log_step));
    return points;
  }

  void require_sign(int order, double t) const {
    const auto found = first_answer(
        [&]<class T>() -> std::optional<double> {
          const auto [sign, log_abs] = generator_.signed_derivative(order, T(t));
          if (sign == SymbolicGenerator::kUnknownSign) return std::nullopt;
          return sign * std::max(static_cast<double>(exp(log_abs).value), std::numeric_limits<double>::denorm_min());
        },
        kFirstDigits);
    if (!found || *found == 0 || (*found > 0) == (order % 2 == 0)) return;
    const std::string k = std::to_string(order);
    refuse("(-1)^" + k + " psi^(" + k + ")(t) must not be negative, found psi^(" + k + ")(" + to_text(t) +
           ") = " + to_text(*found));
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw std::domain_error(subject_ + ": psi is no generator in dimension " + std::to_string(dim_) + ": " + what);
  }

  const SymbolicGenerator& generator_;
  int dim_;
  const std::string& subject_;
};

}  // namespace

void require_generator(const SymbolicGenerator& generator, int dim, const std::string& subject) {
  const Check check(generator, dim, subject);
  check.value_at_zero();
  check.signs();
  check.limit();
}

}  // namespace sklar::symbolic
