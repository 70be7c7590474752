#include "examples/cli/pass_rule.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>

namespace sklar::cli {
namespace {

/// Equal infinities differ by 0.
long double distance(long double a, long double b) {
  return a == b ? 0 : std::fabs(a - b);
}

Verdict verdict(long double error, long double bound) {
  return {static_cast<double>(error), static_cast<double>(error == 0 ? 0 : error / bound)};
}

}  // namespace

std::optional<Expected> parse_expected(std::string_view text) {
  const std::string copy(text);
  if (copy.empty() || std::isspace(static_cast<unsigned char>(copy.front()))) return std::nullopt;
  char* end = nullptr;
  const long double value = std::strtold(copy.c_str(), &end);
  if (end != copy.c_str() + copy.size()) return std::nullopt;
  if (std::isnormal(value) || !std::isfinite(value)) return Expected{value, std::log(value)};
  const std::size_t e = copy.find_first_of("eE");
  const long double mantissa = std::strtold(copy.substr(0, e).c_str(), nullptr);
  const long double exponent = e == std::string::npos ? 0 : std::strtold(copy.c_str() + e + 1, nullptr);
  return Expected{value, mantissa == 0 ? -std::numeric_limits<long double>::infinity()
                                       : std::log(mantissa) + exponent * std::numbers::ln10_v<long double>};
}

Verdict judge(Rule rule, double value, const Expected& expected) {
  const long double v = value;
  const long double e = expected.value;
  switch (rule) {
    case Rule::logarithm:
      return verdict(distance(v, e), 1e-13L * std::max(1.0L, std::fabs(e)));
    case Rule::probability:
      if (e < std::numeric_limits<double>::min()) return verdict(distance(v, e), 4.94e-324L);
      return verdict(distance(std::log(v), expected.log_value),
                     1e-13L * std::max(1.0L, std::fabs(expected.log_value) / 20));
    case Rule::inverse:
      return verdict(e == 0 ? distance(v, e) : distance(v, e) / std::fabs(e), 1e-12L);
  }
  return {};
}

bool is_best_double(double v, double p, double h, double density) {
  return std::fabs(h - p) <= 1e-14 * p + 4 * std::numeric_limits<double>::epsilon() * v * density;
}

}  // namespace sklar::cli
