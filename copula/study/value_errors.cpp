#include "copula/study/value_errors.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace sklar {
namespace {

double error_of(ErrorMeasure measure, const BigFloat& value, const BigFloat& exact) {
  if (value == exact) return 0;
  if (isnan(value) || isnan(exact)) return std::numeric_limits<double>::infinity();
  BigFloat unit = abs(exact);
  if (measure == ErrorMeasure::logarithm && unit < BigFloat(1)) unit = 1;
  return static_cast<double>(abs(value - exact) / unit);
}

}  // namespace

ValueErrors value_errors(ErrorMeasure measure, std::span<const BigFloat> values, std::span<const BigFloat> exact) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < values.size(); ++i) errors.push_back(error_of(measure, values[i], exact[i]));
  std::sort(errors.begin(), errors.end());
  return {errors.back(), errors[errors.size() / 2]};
}

}  // namespace sklar
