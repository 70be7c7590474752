#include "copula/symbolic/symbolic_generator.hpp"

#include <stdexcept>

#include "copula/error.hpp"
#include "copula/first_answer.hpp"

namespace sklar::symbolic {

namespace {

/// Whether two values are the same number, if their errors are known.
template <class T>
std::optional<bool> same(const T& a, const T& b) {
  using std::abs, std::isfinite;
  if (!isfinite(a.error) || !isfinite(b.error)) return std::nullopt;
  return abs(a.value - b.value) <= 2 * (a.error + b.error);
}

}  // namespace

SymbolicGenerator::SymbolicGenerator(std::shared_ptr<const GeneratorFormula> formula, int dim, const Theta& theta,
                                     const std::string& subject)
    : formula_(std::move(formula)) {
  for (int order = 0; order <= dim; ++order) derivatives_.push_back(&formula_->derivative(order));
  prepared_ = std::make_shared<const PerPrecision<PreparedFormula>>(formula_, theta, dim);
  choose_near_zero();
  choose_inverse(subject);
}

// near_zero takes exponents for positive, and psi(0) for 1.
void SymbolicGenerator::choose_near_zero() {
  if (formula_->log_psi_near_zero() == nullptr) return;
  use_near_zero_ = first_answer([this]<class T>() { return near_zero_agrees<T>(); }, kFirstDigits).value_or(false);
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
void SymbolicGenerator::choose_inverse(const std::string& subject) {
  if (formula_->inverse() == nullptr) return;
  const auto agrees = [this](bool near_one) {
    return first_answer([this, near_one]<class T>() { return inverse_agrees<T>(near_one); }, kFirstDigits);
  };
  const std::optional<bool> is_inverse = agrees(false);
  if (is_inverse == true) {
    inverse_ = Inverse::formula;
    use_near_one_ = formula_->inverse_near_one() != nullptr && agrees(true) == true;
  } else if (is_inverse == false && formula_->inverse_is_given()) {
    const double there = exp(log_psi(inverse_at(Narrow(0.5), false))).value;
    throw std::domain_error(subject +
                            ": psi_inverse is not the inverse of psi: psi(psi_inverse(0.5)) = " + to_text(there));
  }
}

template <class T>
std::optional<bool> SymbolicGenerator::inverse_agrees(bool near_one) const {
  std::optional<bool> agrees;
  for (const double u : {0.125, 0.5, 0.875}) {
    const auto here = same(log_psi(inverse_at(T(u), near_one)), log(T(u)));
    if (here) agrees = agrees.value_or(true) && *here;
  }
  return agrees;
}

}  // namespace sklar::symbolic
