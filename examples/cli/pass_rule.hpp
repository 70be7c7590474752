#pragma once
/// When a computed value agrees with a reference that has more digits, and a wider range, than a double.

#include <optional>
#include <string_view>

namespace sklar::cli {

/// A reference value. Where it underflows even here, value is 0 and log_value still right.
struct Expected {
  long double value;
  long double log_value;
};

/// The decimal number that is the whole text; empty for anything else.
[[nodiscard]] std::optional<Expected> parse_expected(std::string_view text);

enum class Rule {
  logarithm,    ///< |v - e| <= 1e-13 max(1, |e|)
  probability,  ///< |ln v - ln e| <= 1e-13 max(1, |ln e| / 20), or |v - e| <= 4.94e-324 for e below the normal doubles
  inverse       ///< |v - e| <= 1e-12 |e|
};

struct Verdict {
  double error;  ///< the left side of the rule, NaN for a NaN value
  double share;  ///< error as a share of the bound
  [[nodiscard]] bool passes() const noexcept { return share <= 1; }
};

[[nodiscard]] Verdict judge(Rule rule, double value, const Expected& expected);

/// The other criterion for an inverse: v is the best double when |h(v) - p| <= 1e-14 p + 4 eps v h'(v).
[[nodiscard]] bool is_best_double(double v, double p, double h, double density);

}  // namespace sklar::cli
