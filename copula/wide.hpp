#pragma once
/// The number types in which a row is computed in turn until its error bound is small enough: double, long double (11
/// more bits and a wider exponent at hardware speed on x86-64), Wide.

#include <boost/multiprecision/mpfr.hpp>

#include "copula/bounded.hpp"

namespace sklar {

/// 70 decimal digits, no heap allocation.
using Wide =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<70, boost::multiprecision::allocate_stack>,
                                  boost::multiprecision::et_off>;

/// While it lives, this thread's MPFR exponents have 62 bits instead of 30: e^x overflows at 3e18, not at 7e8.
class WideExponents {
 public:
  WideExponents() {
    mpfr_set_emin(mpfr_get_emin_min());
    mpfr_set_emax(mpfr_get_emax_max());
  }
  ~WideExponents() {
    mpfr_set_emin(lowest_);
    mpfr_set_emax(highest_);
  }
  WideExponents(const WideExponents&) = delete;
  WideExponents& operator=(const WideExponents&) = delete;

 private:
  mpfr_exp_t lowest_ = mpfr_get_emin(), highest_ = mpfr_get_emax();
};

using Narrow = Bounded<double>;
using Extended = Bounded<long double>;
using Widest = Bounded<Wide>;

}  // namespace sklar
