#pragma once
/// The number types in which a row is computed in turn until its error bound is small enough: double, long double (11
/// more bits and a wider exponent at hardware speed on x86-64), Wide.

#include <boost/multiprecision/mpfr.hpp>

#include "copula/bounded.hpp"

namespace sklar {

/// 70 decimal digits with a 62-bit exponent, no heap allocation.
using Wide =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<70, boost::multiprecision::allocate_stack>,
                                  boost::multiprecision::et_off>;

using Narrow = Bounded<double>;
using Extended = Bounded<long double>;
using Widest = Bounded<Wide>;

}  // namespace sklar
