#pragma once
/// A real number whose width is chosen at run time: Digits::default_precision(decimal digits).

#include <boost/multiprecision/mpfr.hpp>

namespace sklar::test {

using Digits =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<0>, boost::multiprecision::et_off>;

}  // namespace sklar::test
