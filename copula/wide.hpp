#pragma once
/// The number types in which a row is computed in turn until its error bound is small enough: double, long double (11
/// more bits and a wider exponent at hardware speed on x86-64), then more and more digits.

#include "copula/big_float.hpp"
#include "copula/bounded.hpp"

namespace sklar {

/// Number types with an error bound, in the order in which they are tried.
using Narrow = Bounded<double>;
using Extended = Bounded<long double>;
using Widest = Bounded<BigFloat>;  ///< of the WorkingPrecision in force

/// Decimal digits of Widest in turn, each twice the one before.
inline constexpr int kFirstDigits = 70;
inline constexpr int kLastDigits = 70 << 5;

}  // namespace sklar
