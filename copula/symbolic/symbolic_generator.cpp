#include "copula/symbolic/symbolic_generator.hpp"

#include <stdexcept>

#include "copula/error.hpp"

namespace sklar::symbolic {

namespace {

/// Whether two values are the same number, if their errors are known.
template <class T>
std::optional<bool> same(const T& a, const T& b) {
  using std::abs, std::isfinite;
  if (!isfinite(a.error) || !isfinite(b.error)) return std::nullopt;
  return abs(a.value - b.value) <= 2 * (a.error + b.error);
}

/// answer<T>() of the first number type that has one, else false.
template <class Answer>
bool decide(const Answer& answer) {
  if (const auto found = answer.template operator()<Narrow>()) return *found;
  if (const auto found = answer.template operator()<Extended>()) return *found;
  const WorkingPrecision precision(kFirstDigits);
  return answer.template operator()<Widest>().value_or(false);
}

}  // namespace

SymbolicGenerator::SymbolicGenerator(std::shared_ptr<const GeneratorFormula> formula, int dim, Theta theta)
    : formula_(std::move(formula)), theta_(std::move(theta)) {
  for (int order = 0; order <= dim; ++order) derivatives_.push_back(&formula_->derivative(order));
  prepared_ = std::make_shared<const PerPrecision<PreparedFormula>>(formula_, theta_, dim);
  choose_near_zero();
  choose_inverse();
}

// near_zero takes exponents for positive, and psi(0) for 1.
void SymbolicGenerator::choose_near_zero() {
  if (formula_->log_psi_near_zero() == nullptr) return;
  use_near_zero_ = decide([this]<class T>() { return near_zero_agrees<T>(); });
}

template <class T>
std::optional<bool> SymbolicGenerator::near_zero_agrees() const {
  std::optional<bool> agrees;
  for (const double t : {0.01, 0.3, 5.0}) {
    const auto here =
        same(log_abs_dpsi(0, T(t)), run(*formula_->log_psi_near_zero(), prepared<T>().log_psi_near_zero, T(t)));
    if (here) agrees = agrees.value_or(true) && *here;
  }
  return agrees;
}

// solve_for takes the positive root.
void SymbolicGenerator::choose_inverse() {
  if (formula_->inverse() == nullptr) return;
  const bool is_inverse = decide([this]<class T>() { return inverse_agrees<T>(false); });
  if (is_inverse) {
    inverse_ = Inverse::formula;
    use_near_one_ =
        formula_->inverse_near_one() != nullptr && decide([this]<class T>() { return inverse_agrees<T>(true); });
  } else if (formula_->inverse_is_given()) {
    const double there = exp(log_psi(inverse_at<Narrow>(0.5, false))).value;
    throw std::domain_error("psi_inverse is not the inverse of psi: psi(psi_inverse(0.5)) = " + to_text(there));
  }
}

template <class T>
std::optional<bool> SymbolicGenerator::inverse_agrees(bool near_one) const {
  std::optional<bool> agrees;
  for (const double u : {0.125, 0.5, 0.875}) {
    const auto here = same(log_psi(inverse_at<T>(u, near_one)), log(T(u)));
    if (here) agrees = agrees.value_or(true) && *here;
  }
  return agrees;
}

}  // namespace sklar::symbolic
