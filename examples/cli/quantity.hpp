#pragma once
/// The quantities a table may ask for, by name.

#include <functional>
#include <string_view>

#include "copula/copula.hpp"
#include "examples/cli/pass_rule.hpp"

namespace sklar::cli {

struct Quantity {
  std::function<Column(const Copula&, const PointsRef&)> evaluate;
  Rule rule;
  bool takes_t = false;  ///< the argument is t, one number, instead of u
};

/// log_pdf, cdf, log_cdf, h, h_upper, h_inv, h_inv_upper, log_dpsi:k.
/// @throws std::invalid_argument listing the known names.
[[nodiscard]] Quantity find_quantity(std::string_view name);

}  // namespace sklar::cli
