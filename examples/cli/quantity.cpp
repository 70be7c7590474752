#include "examples/cli/quantity.hpp"

#include <charconv>
#include <stdexcept>
#include <string>
#include <vector>

namespace sklar::cli {
namespace {

using Values = std::function<Column(const Copula&, const PointsRef&, Accuracy)>;

struct Named {
  std::string_view name;
  Values evaluate;
  sklar::Quantity exact;  ///< of cdf its logarithm
  Rule rule;
};

constexpr std::string_view kCdf = "cdf";

Values at_levels(Column (Copula::*method)(const PointsRef&, Accuracy) const) {
  return std::mem_fn(method);
}

Values at_one_level(Column (Copula::*method)(const PointsRef&) const) {
  return [method](const Copula& copula, const PointsRef& u, Accuracy) { return (copula.*method)(u); };
}

const std::vector<Named>& named_quantities() {
  using enum sklar::Quantity;
  static const std::vector<Named> kQuantities = {
      {"log_pdf", at_levels(&Copula::log_pdf), log_pdf, Rule::logarithm},
      {kCdf, at_one_level(&Copula::cdf), log_cdf, Rule::probability},
      {"log_cdf", at_one_level(&Copula::log_cdf), log_cdf, Rule::logarithm},
      {"h", at_levels(&Copula::h), h, Rule::probability},
      {"h_upper", at_levels(&Copula::h_upper), h_upper, Rule::probability},
      {"h_inv", at_levels(&Copula::h_inv), h_inv, Rule::inverse},
      {"h_inv_upper", at_levels(&Copula::h_inv_upper), h_inv_upper, Rule::inverse}};
  return kQuantities;
}

Quantity to_quantity(const Named& named) {
  const bool is_cdf = named.name == kCdf;
  const auto exact = [which = named.exact, is_cdf](const Copula& copula, const PointsRef& u, int digits) {
    constexpr int kLargestExponent = 10;  // digits of |log C| before the point
    std::vector<BigFloat> values = copula.exact(which, u, is_cdf ? digits + kLargestExponent : digits);
    if (!is_cdf) return values;
    const WorkingPrecision precision(digits + kLargestExponent);
    for (BigFloat& value : values) value = exp(value);
    return values;
  };
  return {named.evaluate, exact, named.rule};
}

constexpr std::string_view kDerivative = "log_dpsi:";

const ArchimedeanCopula& archimedean(const Copula& copula) {
  const auto* found = dynamic_cast<const ArchimedeanCopula*>(&copula);
  if (found == nullptr) throw std::domain_error("log_dpsi: the copula is not Archimedean and has no generator");
  return *found;
}

/// Empty unless the name is log_dpsi:k with a whole number k >= 0.
std::optional<Quantity> find_derivative(std::string_view name) {
  if (!name.starts_with(kDerivative)) return std::nullopt;
  const char* end = name.data() + name.size();
  int order = -1;
  const auto [stop, error] = std::from_chars(name.data() + kDerivative.size(), end, order);
  if (error != std::errc() || stop != end || order < 0) return std::nullopt;
  return Quantity{[order](const Copula& copula, const PointsRef& t, Accuracy) {
                    return archimedean(copula).log_abs_dpsi(order, t.col(0));
                  },
                  [order](const Copula& copula, const PointsRef& t, int digits) {
                    return archimedean(copula).exact_log_abs_dpsi(order, t.col(0), digits);
                  },
                  Rule::logarithm, order};
}

}  // namespace

Quantity find_quantity(std::string_view name) {
  if (const std::optional<Quantity> derivative = find_derivative(name)) return *derivative;
  std::string known;
  for (const Named& quantity : named_quantities()) {
    if (quantity.name == name) return to_quantity(quantity);
    known += std::string(quantity.name) + ", ";
  }
  throw std::invalid_argument("unknown quantity '" + std::string(name) + "'; known quantities: " + known +
                              "log_dpsi:k");
}

}  // namespace sklar::cli
