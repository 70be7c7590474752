#include "copula/mixture.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "copula/error.hpp"

namespace sklar {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

int common_dim(const std::vector<CopulaPtr>& components) {
  if (components.empty()) throw std::invalid_argument("a mixture needs one component or more, got none");
  for (const CopulaPtr& component : components) {
    if (component == nullptr) throw std::invalid_argument("a mixture needs copulas, got a null pointer");
    if (component->dim() != components[0]->dim()) {
      throw std::invalid_argument("the components of a mixture must have the same dimension, got " +
                                  std::to_string(components[0]->dim()) + " and " + std::to_string(component->dim()));
    }
  }
  return components[0]->dim();
}

}  // namespace

void Mixture::require_weights(const std::vector<double>& weights, std::size_t components) {
  if (weights.size() != components) {
    throw std::invalid_argument("a mixture of " + std::to_string(components) +
                                " components needs as many weights, got " + std::to_string(weights.size()));
  }
  for (const double weight : weights) {
    if (!(weight > 0)) throw std::domain_error("the weights of a mixture must be > 0, got " + to_text(weight));
  }
  constexpr double kTolerance = 1e-12;
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(std::abs(sum - 1) <= kTolerance)) {
    throw std::domain_error("the weights of a mixture must have the sum 1, got " + to_text(sum));
  }
}

Mixture::Mixture(std::vector<CopulaPtr> components, std::vector<double> weights)
    : Copula(common_dim(components)), components_(std::move(components)), weights_(std::move(weights)) {
  require_weights(weights_, components_.size());
  total_weight_ = std::accumulate(weights_.begin(), weights_.end(), 0.0);
}

bool Mixture::has_frailty() const {
  return std::ranges::all_of(components_, [](const CopulaPtr& component) { return component->has_frailty(); });
}

void Mixture::draw(Route route, const Reflection& reflection, Rng& rng, std::span<double> u) const {
  double rest = uniform(rng) * total_weight_;
  std::size_t chosen = 0;
  while (chosen + 1 < weights_.size() && rest >= weights_[chosen]) rest -= weights_[chosen++];
  components_[chosen]->draw(route, reflection, rng, u);
}

// log sum_i w_i e^(x_i), x_i a quantity of the components. Entries by std::exp: Eigen's own depends on the row's place.
void Mixture::log_mix(LogQuantity quantity, const PointsRef& u, const Reflection& reflection, ColumnOut out) const {
  Points terms(u.rows(), static_cast<Index>(components_.size()));
  for (Index i = 0; i < terms.cols(); ++i) {
    const auto component = static_cast<std::size_t>(i);
    (components_[component].get()->*quantity)(u, reflection, terms.col(i));
    terms.col(i) += std::log(weights_[component] / total_weight_);
  }
  for (Index row = 0; row < u.rows(); ++row) {
    const double largest = terms.row(row).maxCoeff<Eigen::PropagateNaN>();
    double sum = 0;
    for (const double term : terms.row(row)) sum += std::exp(term - largest);
    out(row) = std::isinf(largest) ? largest : largest + std::log(sum);
  }
}

void Mixture::log_pdf_into(const PointsRef& u, const Reflection& reflection, ColumnOut out) const {
  log_mix(&Copula::log_pdf_into, u, reflection, out);
}

void Mixture::log_cdf_into(const PointsRef& u, const Reflection& reflection, ColumnOut out) const {
  log_mix(&Copula::log_cdf_into, u, reflection, out);
}

// Multiples of w_i c_i(given), the largest 1 or a weight.
Points Mixture::shares(const PointsRef& given, const Reflection& reflection) const {
  Points share(given.rows(), static_cast<Index>(components_.size()));
  for (Index i = 0; i < share.cols(); ++i) {
    if (given.cols() > 0) {
      components_[static_cast<std::size_t>(i)]->log_pdf_into(given, reflection, share.col(i));
    } else {
      share.col(i) = 0;
    }
  }
  for (Index row = 0; row < share.rows(); ++row) {
    const double most = share.row(row).maxCoeff<Eigen::PropagateNaN>();
    double largest = -kInfinity;
    for (Index i = 0; i < share.cols(); ++i) {
      const double weight = weights_[static_cast<std::size_t>(i)];
      double& value = share(row, i);
      value = std::isinf(most) ? (value == most ? std::log(weight) : -kInfinity) : value + std::log(weight);
      largest = std::max(largest, value);
    }
    for (Index i = 0; i < share.cols(); ++i) share(row, i) = std::exp(share(row, i) - largest);
  }
  return share;
}

// sum_i s_i h_i / sum_i s_i: never above 1, and 1 where all h_i are.
void Mixture::conditional_into(const PointsRef& u, const Reflection& reflection, Tail tail, ColumnOut out) const {
  if (u.cols() == 1) return components_[0]->conditional_into(u, reflection, tail, out);
  const Points share = shares(u.leftCols(u.cols() - 1), reflection);
  Column part(u.rows()), total = Column::Zero(u.rows());
  out.setZero();
  for (Index i = 0; i < share.cols(); ++i) {
    components_[static_cast<std::size_t>(i)]->conditional_into(u, reflection, tail, part);
    out += share.col(i) * part;
    total += share.col(i);
  }
  out /= total;
}

/// The conditional distribution of one row's last coordinate, at any value of it.
class Mixture::Conditional {
 public:
  /// @param share of the components, none NaN.
  Conditional(const Mixture& mixture, const PointsRef& row, const Points& share, const Reflection& reflection)
      : mixture_(mixture), row_(row), share_(share), reflection_(reflection) {}

  /// log of sum_i s_i h_i(x) / target over sum_i s_i, finite: kBeyond in place of an infinity.
  double log_ratio(double x, Tail tail, double target) {
    constexpr double kBeyond = 2000;  // logarithms of ratios of doubles are smaller
    row_(0, row_.cols() - 1) = x;
    double sum = 0, total = 0, part = 0;
    for (Index i = 0; i < share_.cols(); ++i) {
      const auto component = static_cast<std::size_t>(i);
      mixture_.components_[component]->conditional_into(row_, reflection_, tail, Eigen::Map<Column>(&part, 1));
      if (share_(i) > 0) sum += share_(i) * (part / target);
      total += share_(i);
    }
    return std::clamp(std::log(sum / total), -kBeyond, kBeyond);
  }

 private:
  const Mixture& mixture_;
  Points row_, share_;
  const Reflection& reflection_;
};

namespace {

/// The x in [lowest, highest] where the increasing f is 0; the nearer end where it is not in between. In log x: x may
/// be 1e-300.
template <class Function>
double root(const Function& f, double lowest, double highest) {
  const double from = std::log(std::max(lowest, std::numeric_limits<double>::denorm_min())), to = std::log(highest);
  const auto at_log = [&f](double y) { return f(std::exp(y)); };
  const double at_lowest = at_log(from), at_highest = at_log(to);
  if (at_lowest >= 0) return lowest;
  if (at_highest <= 0) return highest;
  std::uintmax_t steps = 200;
  const boost::math::tools::eps_tolerance<double> close(std::numeric_limits<double>::digits);
  const auto bracket = boost::math::tools::toms748_solve(at_log, from, to, at_lowest, at_highest, close, steps);
  return std::exp(bracket.first + (bracket.second - bracket.first) / 2);
}

}  // namespace

// Between the inverses of the components. x = 1 - v for the upper tail, the coordinate of the copula with this one
// reflected, so that neither end loses digits; the smaller of p and 1 - p is what is solved for.
void Mixture::conditional_inverse_into(const PointsRef& u, const Reflection& reflection, Tail tail,
                                       ColumnOut out) const {
  const Index last = u.cols() - 1;
  const Points share = shares(u.leftCols(last), reflection);
  Points inverses(u.rows(), share.cols());
  for (Index i = 0; i < share.cols(); ++i) {
    components_[static_cast<std::size_t>(i)]->conditional_inverse_into(u, reflection, tail, inverses.col(i));
  }
  const Reflection seen =
      tail == Tail::lower ? reflection : reflection ^ Reflection::of_one(static_cast<std::size_t>(last));
  for (Index row = 0; row < u.rows(); ++row) {
    double lowest = kInfinity, highest = -kInfinity;
    for (Index i = 0; i < share.cols(); ++i) {
      if (share(row, i) == 0) continue;
      lowest = std::min(lowest, inverses(row, i));
      highest = std::max(highest, inverses(row, i));
    }
    const double p = u(row, last);
    if (share.row(row).isNaN().any() || inverses.row(row).isNaN().any()) {
      out(row) = std::numeric_limits<double>::quiet_NaN();
    } else if (lowest == highest) {
      out(row) = lowest;
    } else {
      const bool below = p <= 0.5;
      const Tail side = (tail == Tail::lower) == below ? Tail::lower : Tail::upper;
      const double sign = side == Tail::lower ? 1 : -1;
      Conditional conditional(*this, u.row(row), share.row(row), seen);
      out(row) =
          root([&](double x) { return sign * conditional.log_ratio(x, side, below ? p : 1 - p); }, lowest, highest);
    }
  }
}

}  // namespace sklar
