#include "copula/symbolic/derivative.hpp"

#include <stdexcept>

#include "copula/symbolic/ring.hpp"

namespace sklar::symbolic {

class Derivatives::State {
 public:
  State(const Expression& f, const Expression& x) : ring_(x), last_(ring_.convert(f)), found_{f} {}

  const Expression& order(int order) {
    while (found_.size() <= static_cast<std::size_t>(order)) {
      last_ = ring_.differentiate(last_);
      found_.push_back(Ring::to_expression(last_));
    }
    return found_[static_cast<std::size_t>(order)];
  }

 private:
  Ring ring_;
  Polynomial last_;
  std::vector<Expression> found_;
};

Derivatives::Derivatives(const Expression& f, const Expression& x) {
  if (x.kind() != Kind::symbol) throw std::invalid_argument("derivative: x must be a symbol");
  state_ = std::make_unique<State>(f, x);
}
Derivatives::~Derivatives() = default;
Derivatives::Derivatives(Derivatives&&) noexcept = default;
Derivatives& Derivatives::operator=(Derivatives&&) noexcept = default;

const Expression& Derivatives::operator()(int order) {
  if (order < 0) throw std::invalid_argument("derivative: order must be 0 or more, got " + std::to_string(order));
  return state_->order(order);
}

Expression derivative(const Expression& f, const Expression& x, int order) {
  return Derivatives(f, x)(order);
}

}  // namespace sklar::symbolic
