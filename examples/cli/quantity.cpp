#include "examples/cli/quantity.hpp"

#include <charconv>
#include <stdexcept>
#include <string>

namespace sklar::cli {
namespace {

struct Named {
  std::string_view name;
  Column (Copula::*method)(const PointsRef&) const;
  sklar::Quantity exact;  ///< of cdf its logarithm
  Rule rule;
};

using enum sklar::Quantity;
constexpr std::string_view kCdf = "cdf";
constexpr Named kQuantities[] = {
    {"log_pdf", &Copula::log_pdf, log_pdf, Rule::logarithm},           {kCdf, &Copula::cdf, log_cdf, Rule::probability},
    {"log_cdf", &Copula::log_cdf, log_cdf, Rule::logarithm},           {"h", &Copula::h, h, Rule::probability},
    {"h_upper", &Copula::h_upper, h_upper, Rule::probability},         {"h_inv", &Copula::h_inv, h_inv, Rule::inverse},
    {"h_inv_upper", &Copula::h_inv_upper, h_inv_upper, Rule::inverse},
};

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
  return {std::mem_fn(named.method), exact, named.rule};
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
  return Quantity{
      [order](const Copula& copula, const PointsRef& t) { return archimedean(copula).log_abs_dpsi(order, t.col(0)); },
      [order](const Copula& copula, const PointsRef& t, int digits) {
        return archimedean(copula).exact_log_abs_dpsi(order, t.col(0), digits);
      },
      Rule::logarithm, order};
}

}  // namespace

Quantity find_quantity(std::string_view name) {
  if (const std::optional<Quantity> derivative = find_derivative(name)) return *derivative;
  std::string known;
  for (const Named& quantity : kQuantities) {
    if (quantity.name == name) return to_quantity(quantity);
    known += std::string(quantity.name) + ", ";
  }
  throw std::invalid_argument("unknown quantity '" + std::string(name) + "'; known quantities: " + known +
                              "log_dpsi:k");
}

}  // namespace sklar::cli
