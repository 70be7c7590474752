#pragma once
/// The quantities a table may ask for, by name.

#include <algorithm>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "copula/archimedean_copula.hpp"
#include "examples/cli/pass_rule.hpp"

namespace sklar::cli {

struct Quantity {
  /// A quantity without a fast form takes the standard one.
  std::function<Column(const Copula&, const PointsRef&, Accuracy)> evaluate;
  std::function<std::vector<BigFloat>(const Copula&, const PointsRef&, int digits)> exact;
  Rule rule;
  std::optional<int> order = {};  ///< of a derivative of psi, whose argument is t, one number, instead of u

  /// The dimension in which the copula has the derivative, at least that of the row.
  [[nodiscard]] int dim_for(int dim) const { return std::max(dim, order.value_or(0)); }
};

/// log_pdf, cdf, log_cdf, h, h_upper, h_inv, h_inv_upper, log_dpsi:k.
/// @throws std::invalid_argument listing the known names.
[[nodiscard]] Quantity find_quantity(std::string_view name);

}  // namespace sklar::cli
