#pragma once
/// Standard errors from the observed information.

#include <functional>
#include <vector>

#include "copula/family.hpp"

namespace sklar {

/// Square roots of the diagonal of the inverse of -d^2 l / d theta^2 at an interior maximum, by central second
/// differences. The steps make l drop by about kDrop, a tenth of a standard error: then the truncation error is of the
/// order of 1 % of one over the number of rows, and rounding in l (1e-16 |l|) stays below 1e-4 of the difference to |l|
/// = 1e9.
/// @param log_likelihood l(theta), called inside the domain only. @param at_maximum its value at theta.
/// @param step           first guess of the steps, > 0.
/// @return               NaN throughout where a step does not fit in the domain or the information is not positive
///                       definite.
[[nodiscard]] std::vector<double> standard_errors(const std::function<double(const Theta&)>& log_likelihood,
                                                  const Theta& theta, double at_maximum,
                                                  const std::vector<Interval>& domain, std::vector<double> step);

}  // namespace sklar
