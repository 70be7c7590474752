#pragma once
/// The number type in which a row is repeated when double does not reach the stated accuracy.

#include <boost/multiprecision/mpfr.hpp>

#include "copula/bounded.hpp"

namespace sklar {

/// 70 decimal digits with a 62-bit exponent, no heap allocation.
using Wide =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<70, boost::multiprecision::allocate_stack>,
                                  boost::multiprecision::et_off>;

}  // namespace sklar
