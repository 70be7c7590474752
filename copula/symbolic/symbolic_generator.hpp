#pragma once
/// A generator given as a formula, with values for its parameters.

#include <atomic>
#include <limits>

#include "copula/generator.hpp"
#include "copula/generic_route.hpp"
#include "copula/numerics.hpp"
#include "copula/symbolic/generator_formula.hpp"
#include "copula/symbolic/limit_at_infinity.hpp"
#include "copula/types.hpp"

namespace sklar::symbolic {

/// What a formula needs of the values of its parameters alone, for one number type.
template <class T>
struct PreparedFormula {
  PreparedFormula(const std::shared_ptr<const GeneratorFormula>& formula, const Theta& theta, int dim) {
    for (int order = 0; order <= dim; ++order) {
      derivatives.push_back(formula->derivative(order).template prepare<T>(theta));
    }
    const auto prepare = [&](const SplitTape* tape) {
      return tape == nullptr ? std::vector<T>() : tape->template prepare<T>(theta);
    };
    log_psi_near_zero = prepare(formula->log_psi_near_zero());
    inverse = prepare(formula->inverse());
    inverse_near_one = prepare(formula->inverse_near_one());
  }

  std::vector<std::vector<T>> derivatives;
  std::vector<T> log_psi_near_zero, inverse, inverse_near_one;
};

/// Satisfies Generator for orders 0..dim. Where a condition of the formula is not positive, t is beyond the support and
/// psi is 0, as in (1 + theta t)_+. Coordinates 0 give the limits of copula.hpp, unknown where limit_at_infinity does
/// not find them and, beside ones, at the edge of a bounded support or where psi'(0) is infinite. A number whose sign
/// or value its type does not resolve has an infinite error bound. Immutable; copies share what they hold. Whether psi
/// is a generator at all: require_generator.
class SymbolicGenerator {
 public:
  /// @param dim highest order, 1 to kMaxDimension. @param theta one value a parameter of the formula.
  /// @param subject opens the message, as in "bb1 (theta = 2, delta = 3)".
  /// @throws std::domain_error for a given inverse that is none.
  SymbolicGenerator(std::shared_ptr<const GeneratorFormula> formula, int dim, const Theta& theta,
                    const std::string& subject = "psi");

  static constexpr int kUnknownSign = 2;

  template <class T>
  [[nodiscard]] T log_psi(const T& t) const {
    T direct = log_abs_dpsi(0, t);
    if (!use_near_zero_ || direct < T(-0.5)) return direct;
    T near = run(*formula_->log_psi_near_zero(), prepared<T>().log_psi_near_zero, t);
    return near.error < direct.error ? near : direct;
  }

  template <class T>
  [[nodiscard]] T psi_inv(const T& u) const {
    if (inverse_ == Inverse::numeric) return solve(u);
    const bool near_one = use_near_one_ && u > T(0.5);
    T first = inverse_at(u, near_one);
    if (!use_near_one_ || first.error <= kGoodEnough * abs(first).value) return first;
    T second = inverse_at(u, !near_one);
    return second.error < first.error ? second : first;
  }

  /// psi^-1(u) and log |psi'| there. A thread keeps the last answers for exact u in double and long double.
  template <class T>
  [[nodiscard]] std::pair<T, T> margin(const T& u) const {
    const auto compute = [&] {
      const T t = is_one(u) ? T(0.0) : psi_inv(u);
      return std::pair<T, T>(t, log_abs_dpsi(1, t));
    };
    if constexpr (std::is_same_v<T, Widest>) {
      return compute();
    } else {
      if (u.error != 0) return compute();
      thread_local std::vector<Remembered<T>> memory(kRemembered);
      Remembered<T>& place = memory[std::hash<Real<T>>()(u.value) % kRemembered];
      if (place.generator != id_ || place.u != u.value) place = {id_, u.value, compute()};
      return place.margin;
    }
  }

  template <class T>
  [[nodiscard]] T log_abs_dpsi(int k, const T& t) const {
    const auto order = static_cast<std::size_t>(k);
    const std::vector<T>& prepared_tape = prepared<T>().derivatives[order];
    const auto values = derivatives_[order]->template run<T>(prepared_tape, t);
    const int inside = sign_of_conditions(values);
    if (inside < 0) return T(-kInfinity);
    const int wrong = k % 2 == 0 ? -1 : 1;
    return inside == kUnknownSign || sign_of_factors(values) == wrong ? unknown<T>() : values[0];
  }

  template <class T>
  [[nodiscard]] T log_density(std::span<const T> u) const {
    const int zeros = count_zeros(u);
    if (zeros == 0) return generic_log_density(*this, u);
    if (support_is_bounded<T>()) {
      const bool at_edge = zeros == 1 && count_ones(u) == static_cast<int>(u.size()) - 1;
      return at_edge ? unknown<T>() : T(-kInfinity);
    }
    return limit_at_zeros(u, [&](const auto& generator) { return generic_log_density(generator, u); });
  }

  /// Given values at the edge of the support or beyond it, the next coordinate is 1.
  template <class T>
  [[nodiscard]] T log_conditional(std::span<const T> u) const {
    const auto given = u.first(u.size() - 1);
    if (count_zeros(given) == 0) {
      const T log_h = generic_log_conditional(*this, u);
      return is_beyond_support(log_h, given) ? T(-kInfinity) : log_h;
    }
    if (support_is_bounded<T>()) return T(-kInfinity);
    return limit_at_zeros(u, [&](const auto& generator) { return generic_log_conditional(generator, u); });
  }

  template <class T>
  [[nodiscard]] T conditional_inverse(std::span<const T> given, const T& p) const {
    if (count_zeros(given) == 0) {
      const T minus_log_v = generic_conditional_inverse(*this, given, p);
      return is_beyond_support(minus_log_v, given) ? T(0) : minus_log_v;
    }
    if (support_is_bounded<T>()) return T(0);
    return limit_at_zeros(given, [&](const auto& generator) {
      const T start = generator.log_abs_dpsi(static_cast<int>(given.size()), generic_sum(generator, given));
      return start.error < kStartError ? generic_conditional_inverse(generator, given, p) : unknown<T>();
    });
  }

  /// Sign of psi^(k)(t), 0 beyond the support, kUnknownSign where T does not resolve it; and log|psi^(k)(t)|.
  template <class T>
  [[nodiscard]] std::pair<int, T> signed_derivative(int k, const T& t) const {
    const auto order = static_cast<std::size_t>(k);
    const auto values = derivatives_[order]->template run<T>(prepared<T>().derivatives[order], t);
    const int inside = sign_of_conditions(values);
    if (inside < 0) return {0, T(-kInfinity)};
    return {inside == kUnknownSign ? kUnknownSign : sign_of_factors(values), values[0]};
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static constexpr double kGoodEnough = 1e-15;  ///< relative error of psi^-1 that no other form improves much
  static constexpr double kStartError = 1e-3;   ///< of the logarithm from which a conditional is inverted
  static constexpr std::size_t kRemembered = 1021;
  enum class Inverse { formula, numeric };

  template <class T>
  using Real = std::remove_cvref_t<decltype(T().value)>;

  template <class T>
  struct Remembered {
    std::uint64_t generator = 0;  ///< its id_; 0 is no generator's
    Real<T> u = 0;
    std::pair<T, T> margin;
  };

  static std::uint64_t next_id() {
    static std::atomic<std::uint64_t> last = 0;
    return ++last;
  }

  template <class T>
  static T unknown() {
    return {std::numeric_limits<Real<T>>::quiet_NaN(), std::numeric_limits<Real<T>>::infinity()};
  }

  /// -1, 0 or 1 where it is certain, else kUnknownSign. Zero is certain only if exact.
  template <class T>
  static int sign_of(const T& x) {
    if (x.value > x.error) return 1;
    if (-x.value > x.error) return -1;
    return x.value == 0 && x.error == 0 ? 0 : kUnknownSign;
  }

  /// -1 where any condition is negative, kUnknownSign where one is not resolved.
  template <class T>
  int sign_of_conditions(const SplitTape::Values<T>& values) const {
    for (std::size_t i = 1; i <= formula_->conditions(); ++i) {
      const int sign = sign_of(values[i]);
      if (sign < 0 || sign == kUnknownSign) return sign;
    }
    return 1;
  }

  template <class T>
  int sign_of_factors(const SplitTape::Values<T>& values) const {
    int sign = 1;
    for (std::size_t i = 1 + formula_->conditions(); i < values.size(); ++i) {
      const int next = sign_of(values[i]);
      if (next == kUnknownSign) return kUnknownSign;
      sign *= next;
    }
    return sign;
  }

  template <class T>
  [[nodiscard]] bool support_is_bounded() const {
    return formula_->conditions() > 0 && signed_derivative(0, T(0x1p500)).first == 0;
  }

  /// Whether a result is not known because psi is 0 at the given values.
  template <class T>
  [[nodiscard]] bool is_beyond_support(const T& result, std::span<const T> given) const {
    using std::isfinite;
    if (formula_->conditions() == 0 || isfinite(result.error)) return false;
    return signed_derivative(0, generic_sum(*this, given)).first == 0;
  }

  /// The limit of quantity(generator) as psi^-1(0) grows, from far beyond that of the other coordinates.
  template <class T, class Quantity>
  [[nodiscard]] T limit_at_zeros(std::span<const T> u, const Quantity& quantity) const {
    T smallest(1);
    for (const T& value : u) {
      if (!is_zero(value) && value < smallest) smallest = value;
    }
    const T start = psi_inv(smallest / T(1024));
    return limit_at_infinity([&](const T& far) { return quantity(ZerosAt<SymbolicGenerator, T>(*this, far)); }, start);
  }

  template <class T>
  const PreparedFormula<T>& prepared() const {
    return prepared_->template get<T>();
  }

  template <class T>
  static T run(const SplitTape& tape, const std::vector<T>& prepared_tape, const T& x) {
    return tape.template run<T>(prepared_tape, x)[0];
  }

  template <class T>
  T inverse_at(const T& u, bool near_one) const {
    if (near_one) return run(*formula_->inverse_near_one(), prepared<T>().inverse_near_one, T(1) - u);
    return run(*formula_->inverse(), prepared<T>().inverse, u);
  }

  /// The t with -log psi(t) = -log u by solve_increasing; wider types start from the solution in double.
  template <class T>
  T solve(const T& u) const {
    if (is_zero(u)) return formula_->conditions() == 0 ? T(kInfinity) : unknown<T>();
    const auto rate = [this](const T& t) {
      const T level = -log_psi(t);
      return std::pair<T, T>(level, exp(log_abs_dpsi(1, t) + level));
    };
    const T target = -log(u);
    if (!(target.value > target.error)) return unknown<T>();
    double start = 1;
    if constexpr (!std::is_same_v<T, Narrow>) {
      const double narrow = solve(Narrow(static_cast<double>(u.value))).value;
      if (narrow > 0 && narrow < kInfinity) start = narrow;
    }
    return solve_increasing(rate, target, T(start));
  }

  void choose_near_zero();
  void choose_inverse(const std::string& subject);
  template <class T>
  [[nodiscard]] std::optional<bool> near_zero_agrees() const;
  template <class T>
  [[nodiscard]] std::optional<bool> inverse_agrees(bool near_one) const;

  std::uint64_t id_ = next_id();  ///< shared by copies, which are the same generator
  std::shared_ptr<const GeneratorFormula> formula_;
  std::vector<const SplitTape*> derivatives_;
  std::shared_ptr<const PerPrecision<PreparedFormula>> prepared_;
  bool use_near_zero_ = false, use_near_one_ = false;
  Inverse inverse_ = Inverse::numeric;
};

static_assert(Generator<SymbolicGenerator>);

}  // namespace sklar::symbolic
