#pragma once
/// Standard errors from the observed information.

#include <functional>
#include <vector>

#include "copula/family.hpp"

namespace sklar {

/// The derivative of the log likelihood by each parameter.
using Score = std::function<std::vector<double>(const Theta&)>;

/// Square roots of the diagonal of the inverse of -d^2 l / d theta^2 at an interior maximum, by central differences of
/// the score.
/// @param score called inside the domain only. @param step of each parameter, > 0; shortened to stay inside.
/// @return NaN throughout where the information is not positive definite or not finite.
[[nodiscard]] std::vector<double> standard_errors(const Score& score, const Theta& theta,
                                                  const std::vector<Interval>& domain, std::vector<double> step);

}  // namespace sklar
