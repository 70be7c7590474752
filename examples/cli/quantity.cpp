#include "examples/cli/quantity.hpp"

#include <stdexcept>
#include <string>

namespace sklar::cli {
namespace {

struct Named {
  std::string_view name;
  Column (Copula::*method)(const PointsRef&) const;
  Rule rule;
};

constexpr Named kQuantities[] = {
    {"log_pdf", &Copula::log_pdf, Rule::logarithm},       {"cdf", &Copula::cdf, Rule::probability},
    {"log_cdf", &Copula::log_cdf, Rule::logarithm},       {"h", &Copula::h, Rule::probability},
    {"h_upper", &Copula::h_upper, Rule::probability},     {"h_inv", &Copula::h_inv, Rule::inverse},
    {"h_inv_upper", &Copula::h_inv_upper, Rule::inverse},
};

}  // namespace

Quantity find_quantity(std::string_view name) {
  std::string known;
  for (const Named& quantity : kQuantities) {
    if (quantity.name == name) return {std::mem_fn(quantity.method), quantity.rule};
    known += std::string(quantity.name) + ", ";
  }
  throw std::invalid_argument("unknown quantity '" + std::string(name) + "'; known quantities: " + known +
                              "log_dpsi:k");
}

}  // namespace sklar::cli
