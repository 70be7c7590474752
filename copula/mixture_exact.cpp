// Mixtures in many digits, from the exact values of their components.

#include <algorithm>

#include "copula/first_answer.hpp"
#include "copula/mixture.hpp"

namespace sklar {

namespace {

BigFloat ten_to_minus(int digits) {
  return pow(BigFloat(10), -digits);
}

/// Where the increasing f is 0, to `tolerance`, from where it is below 0 to where it is above: by secants that halve
/// the value at an end that stays (Illinois; Dahlquist and Bjorck, Numerical Methods in Scientific Computing I, 6.2.2).
/// @return error unknown where the sign of f is not resolved at both sides.
template <class F>
Widest find_root(const F& f, BigFloat low, BigFloat high, const BigFloat& tolerance) {
  constexpr int kMostSteps = 500;
  BigFloat at_low = f(low).value, at_high = f(high).value, x = low;
  int side = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    const BigFloat before = x, secant = low - at_low * (high - low) / (at_high - at_low);
    x = isfinite(secant) && secant > low && secant < high ? secant : BigFloat((low + high) / 2);
    const BigFloat value = f(x).value;
    if (value == 0 || abs(x - before) <= tolerance || high - low <= tolerance) break;
    const int now = value < 0 ? -1 : 1;
    (now < 0 ? low : high) = x;
    (now < 0 ? at_low : at_high) = value;
    if (side == now) (now < 0 ? at_high : at_low) /= 2;
    side = now;
  }
  const Widest below = f(BigFloat(x - tolerance)), above = f(BigFloat(x + tolerance));
  const bool resolved = below.value < -below.error && above.value > above.error;
  return {x, resolved ? tolerance : Widest::unknown()};
}

}  // namespace

/// Quantities of a rotated mixture at the working precision, with their errors.
class Mixture::Exact {
 public:
  using Row = std::span<const BigFloat>;

  Exact(const Mixture& mixture, const Reflection& reflection, int digits)
      : mixture_(mixture), reflection_(reflection), digits_(digits) {
    for (const double weight : mixture.weights_) weights_.push_back(Widest(weight));
    Widest total(0);
    for (const Widest& weight : weights_) total += weight;
    for (Widest& weight : weights_) weight /= total;
  }

  /// log sum_i w_i e^(x_i), x_i log_pdf or log_cdf of the components.
  [[nodiscard]] Widest log_mix(Quantity quantity, Row u) const {
    const std::vector<Widest> terms = of_components(quantity, u, reflection_);
    const Widest largest = *std::max_element(terms.begin(), terms.end());
    const bool equal = std::ranges::all_of(terms, [&](const Widest& term) { return term.value == largest.value; });
    if (equal || !isfinite(largest.value)) return largest;
    Widest sum(0);
    for (std::size_t i = 0; i < terms.size(); ++i) sum += weights_[i] * power(terms[i], largest);
    return largest + log(sum);
  }

  /// h or h_upper.
  [[nodiscard]] Widest conditional(Quantity quantity, Row u) const {
    return mean(shares(u.first(u.size() - 1)), of_components(quantity, u, reflection_));
  }

  /// h_inv or h_inv_upper, of which so many digits are wanted: between those of the components, and in its logarithm.
  /// 1 - v is the coordinate of the mixture with the last one reflected.
  [[nodiscard]] Widest inverse(Quantity quantity, Row u, int wanted) const {
    const std::vector<Widest> share = shares(u.first(u.size() - 1));
    std::vector<Widest> found;
    for (const Widest& value : of_components(quantity, u, reflection_)) {
      if (share[found.size()].value == 0) continue;
      found.push_back(value);
    }
    const auto [lowest, highest] = std::minmax_element(found.begin(), found.end());
    const BigFloat width = highest->value - lowest->value + highest->error;
    if (!(lowest->value > 0) || width <= ten_to_minus(wanted) * lowest->value) return {lowest->value, width};
    const bool complement = quantity == Quantity::h_inv_upper;
    const Reflection seen = complement ? reflection_ ^ Reflection::of_one(u.size() - 1) : reflection_;
    const BigFloat below = complement ? 1 - u.back() : u.back();
    const bool lower = below <= BigFloat(0.5);
    const Widest target = log(Widest(lower ? below : BigFloat(1 - below), 0));
    std::vector<BigFloat> row(u.begin(), u.end());
    const auto miss = [&](const BigFloat& log_x) {
      row.back() = exp(log_x);
      if (row.back() >= 1) return Widest(1);
      const auto values = of_components(lower ? Quantity::h : Quantity::h_upper, row, seen);
      const Widest difference = log(mean(share, values)) - target;
      return lower ? difference : -difference;
    };
    const BigFloat tolerance = ten_to_minus((wanted + digits_) / 2);
    return exp(find_root(miss, log(lowest->value), log(highest->value), tolerance));
  }

 private:
  /// e^(x - largest).
  static Widest power(const Widest& x, const Widest& largest) { return isinf(x.value) ? Widest(0) : exp(x - largest); }

  [[nodiscard]] std::vector<Widest> of_components(Quantity quantity, Row u, const Reflection& reflection) const {
    std::vector<Widest> values;
    for (const CopulaPtr& component : mixture_.components_) {
      const BigFloat value = component->exact_row(quantity, u, reflection, digits_);
      const BigFloat error = isfinite(value) ? ten_to_minus(digits_) * abs(value) : BigFloat(0);
      values.push_back({value, isnan(value) ? Widest::unknown() : error});
    }
    return values;
  }

  /// Multiples of w_i c_i(given), as Mixture::shares.
  [[nodiscard]] std::vector<Widest> shares(Row given) const {
    std::vector<Widest> share = weights_;
    if (given.empty()) return share;
    const std::vector<Widest> terms = of_components(Quantity::log_pdf, given, reflection_);
    const Widest largest = *std::max_element(terms.begin(), terms.end());
    for (std::size_t i = 0; i < share.size(); ++i) {
      if (isfinite(largest.value)) {
        share[i] *= power(terms[i], largest);
      } else if (terms[i].value != largest.value) {
        share[i] = 0;
      }
    }
    return share;
  }

  static Widest mean(const std::vector<Widest>& share, const std::vector<Widest>& values) {
    Widest sum(0), total(0);
    for (std::size_t i = 0; i < share.size(); ++i) {
      if (share[i].value == 0) continue;
      sum += share[i] * values[i];
      total += share[i];
    }
    return sum / total;
  }

  const Mixture& mixture_;
  const Reflection& reflection_;
  int digits_;
  std::vector<Widest> weights_;
};

BigFloat Mixture::exact_row(Quantity quantity, std::span<const BigFloat> u, const Reflection& reflection,
                            int digits) const {
  const bool joint = quantity == Quantity::log_pdf || quantity == Quantity::log_cdf;
  const bool inverse = quantity == Quantity::h_inv || quantity == Quantity::h_inv_upper;
  if (components_.size() == 1 || (!joint && u.size() == 1)) {
    return components_[0]->exact_row(quantity, u, reflection, digits);
  }
  return resolve_digits(digits, [&](int working) {
    const Exact exact(*this, reflection, working);
    if (joint) return exact.log_mix(quantity, u);
    return inverse ? exact.inverse(quantity, u, digits) : exact.conditional(quantity, u);
  });
}

}  // namespace sklar
