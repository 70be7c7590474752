#include "copula/big_float.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

namespace sklar {

namespace {

constexpr double kBitsPerDigit = 3.3219280948873626;
constexpr int kGuardBits = 4;

std::size_t limbs_for(mpfr_prec_t bits) {
  return (static_cast<std::size_t>(bits) + GMP_NUMB_BITS - 1) / GMP_NUMB_BITS;
}

template <class Function, class... Arguments>
BigFloat call(Function function, const Arguments&... arguments) {
  BigFloat result;
  function(result.get(), arguments.get()..., MPFR_RNDN);
  return result;
}

}  // namespace

WorkingPrecision::WorkingPrecision(int digits)
    : bits_(mpfr_get_default_prec()), lowest_(mpfr_get_emin()), highest_(mpfr_get_emax()) {
  if (digits < 2 || digits > kMostDigits) {
    throw std::invalid_argument("precision: digits must be from 2 to " + std::to_string(kMostDigits) + ", got " +
                                std::to_string(digits));
  }
  mpfr_set_default_prec(static_cast<mpfr_prec_t>(std::ceil(digits * kBitsPerDigit)) + kGuardBits);
  mpfr_set_emin(mpfr_get_emin_min());
  mpfr_set_emax(mpfr_get_emax_max());
}

WorkingPrecision::~WorkingPrecision() {
  mpfr_set_default_prec(bits_);
  mpfr_set_emin(lowest_);
  mpfr_set_emax(highest_);
}

long WorkingPrecision::bits() {
  return mpfr_get_default_prec();
}

// Limbs stand in the object itself, or on the heap where they are more than kInPlace (MPFR's custom interface, manual
// 5.16: it never reallocates them).
void BigFloat::allocate(mpfr_prec_t bits) {
  const std::size_t limbs = limbs_for(bits);
  mp_limb_t* storage = limbs <= kInPlace ? limbs_.data() : new mp_limb_t[limbs];
  mpfr_custom_init_set(value_, MPFR_ZERO_KIND, 0, bits, storage);
}

bool BigFloat::in_place() const noexcept {
  return mpfr_custom_get_significand(value_) == limbs_.data();
}

void BigFloat::release() noexcept {
  if (!in_place()) delete[] static_cast<mp_limb_t*>(mpfr_custom_get_significand(value_));
}

BigFloat::BigFloat() {
  allocate(mpfr_get_default_prec());
}

BigFloat::BigFloat(const std::string& decimal) : BigFloat() {
  if (mpfr_set_str(value_, decimal.c_str(), 10, MPFR_RNDN) != 0) {
    release();
    throw std::invalid_argument("'" + decimal + "' is not a decimal number");
  }
}

BigFloat::BigFloat(const BigFloat& other) {
  allocate(mpfr_get_prec(other.value_));
  mpfr_set(value_, other.value_, MPFR_RNDN);
}

// A number on the heap hands its limbs over and becomes a NaN of two bits, which needs none.
BigFloat::BigFloat(BigFloat&& other) noexcept {
  if (other.in_place()) {
    allocate(mpfr_get_prec(other.value_));
    mpfr_set(value_, other.value_, MPFR_RNDN);
  } else {
    *value_ = *other.value_;
    other.limbs_ = {};
    mpfr_custom_init_set(other.value_, MPFR_NAN_KIND, 0, 2, other.limbs_.data());
  }
}

BigFloat& BigFloat::operator=(const BigFloat& other) {
  if (this != &other) *this = BigFloat(other);
  return *this;
}

BigFloat& BigFloat::operator=(BigFloat&& other) noexcept {
  if (this != &other) {
    release();
    new (this) BigFloat(std::move(other));
  }
  return *this;
}

BigFloat::~BigFloat() {
  release();
}

BigFloat operator-(const BigFloat& a) {
  return call(mpfr_neg, a);
}
BigFloat operator+(const BigFloat& a, const BigFloat& b) {
  return call(mpfr_add, a, b);
}
BigFloat operator-(const BigFloat& a, const BigFloat& b) {
  return call(mpfr_sub, a, b);
}
BigFloat operator*(const BigFloat& a, const BigFloat& b) {
  return call(mpfr_mul, a, b);
}
BigFloat operator/(const BigFloat& a, const BigFloat& b) {
  return call(mpfr_div, a, b);
}

BigFloat abs(const BigFloat& x) {
  return call(mpfr_abs, x);
}
BigFloat sqrt(const BigFloat& x) {
  return call(mpfr_sqrt, x);
}
BigFloat cbrt(const BigFloat& x) {
  return call(mpfr_cbrt, x);
}
BigFloat exp(const BigFloat& x) {
  return call(mpfr_exp, x);
}
BigFloat expm1(const BigFloat& x) {
  return call(mpfr_expm1, x);
}
BigFloat log(const BigFloat& x) {
  return call(mpfr_log, x);
}
BigFloat log1p(const BigFloat& x) {
  return call(mpfr_log1p, x);
}
BigFloat pow(const BigFloat& x, const BigFloat& y) {
  return call(mpfr_pow, x, y);
}
BigFloat sin(const BigFloat& x) {
  return call(mpfr_sin, x);
}
BigFloat cos(const BigFloat& x) {
  return call(mpfr_cos, x);
}
BigFloat tan(const BigFloat& x) {
  return call(mpfr_tan, x);
}
BigFloat atan(const BigFloat& x) {
  return call(mpfr_atan, x);
}
BigFloat tgamma(const BigFloat& x) {
  return call(mpfr_gamma, x);
}
BigFloat lgamma(const BigFloat& x) {
  return call(mpfr_lngamma, x);
}
BigFloat digamma(const BigFloat& x) {
  return call(mpfr_digamma, x);
}

std::string to_text(const BigFloat& x, int digits) {
  if (!isfinite(x)) return isnan(x) ? "nan" : x > 0 ? "inf" : "-inf";
  const int length = mpfr_snprintf(nullptr, 0, "%.*Re", digits - 1, x.get());
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  mpfr_snprintf(text.data(), text.size(), "%.*Re", digits - 1, x.get());
  text.pop_back();
  return text;
}

}  // namespace sklar

using sklar::BigFloat;

BigFloat std::numeric_limits<BigFloat>::epsilon() {
  BigFloat result(1);
  mpfr_mul_2si(result.get(), result.get(), 1 - mpfr_get_prec(result.get()), MPFR_RNDN);
  return result;
}

BigFloat std::numeric_limits<BigFloat>::min() {
  BigFloat result;
  mpfr_nextabove(result.get());
  return result;
}

BigFloat std::numeric_limits<BigFloat>::infinity() {
  BigFloat result;
  mpfr_set_inf(result.get(), 1);
  return result;
}

BigFloat std::numeric_limits<BigFloat>::quiet_NaN() {
  BigFloat result;
  mpfr_set_nan(result.get());
  return result;
}
