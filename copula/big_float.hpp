#pragma once
/// Real numbers of as many digits as asked for at run time.

#include <mpfr.h>

#include <array>
#include <limits>
#include <string>
#include <type_traits>

namespace sklar {

/// While it lives, new BigFloats of this thread have at least so many decimal digits, and exponents of 62 bits: e^x
/// overflows at 3e18. Guards nest.
class WorkingPrecision {
 public:
  /// @param digits 2 to kMostDigits. @throws std::invalid_argument otherwise.
  explicit WorkingPrecision(int digits);
  ~WorkingPrecision();
  WorkingPrecision(const WorkingPrecision&) = delete;
  WorkingPrecision& operator=(const WorkingPrecision&) = delete;

  static constexpr int kMostDigits = 1'000'000;

  /// Bits of a BigFloat made now by this thread.
  [[nodiscard]] static long bits();

 private:
  mpfr_prec_t bits_;
  mpfr_exp_t lowest_, highest_;
};

/// A number of MPFR, every operation rounded correctly to the precision of the thread. Not boost::multiprecision: there
/// the run-time precision belongs to the whole process (Boost 1.74), here each thread has its own. Numbers of up to 256
/// bits need no heap.
class BigFloat {
 public:
  BigFloat();  ///< 0
  template <class Number, class = std::enable_if_t<std::is_arithmetic_v<Number>>>
  BigFloat(Number value) : BigFloat() {  // NOLINT: numbers convert; doubles exactly
    if constexpr (std::is_same_v<Number, long double>) {
      mpfr_set_ld(value_, value, MPFR_RNDN);
    } else if constexpr (std::is_floating_point_v<Number>) {
      mpfr_set_d(value_, value, MPFR_RNDN);
    } else {
      static_assert(std::is_signed_v<Number> && sizeof(Number) <= sizeof(long));
      mpfr_set_si(value_, value, MPFR_RNDN);
    }
  }

  /// As in "-1.5e-3". @throws std::invalid_argument
  explicit BigFloat(const std::string& decimal);

  /// A copy keeps the precision of the original.
  BigFloat(const BigFloat& other);
  BigFloat(BigFloat&& other) noexcept;
  BigFloat& operator=(const BigFloat& other);
  BigFloat& operator=(BigFloat&& other) noexcept;
  ~BigFloat();

  /// Rounded to nearest, subnormal doubles included.
  explicit operator double() const { return mpfr_get_d(value_, MPFR_RNDN); }

  [[nodiscard]] mpfr_srcptr get() const noexcept { return value_; }
  [[nodiscard]] mpfr_ptr get() noexcept { return value_; }

  BigFloat& operator+=(const BigFloat& b) { return *this = *this + b; }
  BigFloat& operator-=(const BigFloat& b) { return *this = *this - b; }
  BigFloat& operator*=(const BigFloat& b) { return *this = *this * b; }
  BigFloat& operator/=(const BigFloat& b) { return *this = *this / b; }

  friend BigFloat operator-(const BigFloat& a);
  friend BigFloat operator+(const BigFloat& a, const BigFloat& b);
  friend BigFloat operator-(const BigFloat& a, const BigFloat& b);
  friend BigFloat operator*(const BigFloat& a, const BigFloat& b);
  friend BigFloat operator/(const BigFloat& a, const BigFloat& b);

  friend bool operator==(const BigFloat& a, const BigFloat& b) { return mpfr_equal_p(a.value_, b.value_) != 0; }
  friend bool operator!=(const BigFloat& a, const BigFloat& b) { return mpfr_equal_p(a.value_, b.value_) == 0; }
  friend bool operator<(const BigFloat& a, const BigFloat& b) { return mpfr_less_p(a.value_, b.value_) != 0; }
  friend bool operator>(const BigFloat& a, const BigFloat& b) { return mpfr_greater_p(a.value_, b.value_) != 0; }
  friend bool operator<=(const BigFloat& a, const BigFloat& b) { return mpfr_lessequal_p(a.value_, b.value_) != 0; }
  friend bool operator>=(const BigFloat& a, const BigFloat& b) { return mpfr_greaterequal_p(a.value_, b.value_) != 0; }

 private:
  static constexpr std::size_t kInPlace = 256 / GMP_NUMB_BITS;

  void allocate(mpfr_prec_t bits);
  void release() noexcept;
  [[nodiscard]] bool in_place() const noexcept;

  mpfr_t value_;
  std::array<mp_limb_t, kInPlace> limbs_;
};

/// As in `<cmath>`, correctly rounded by MPFR.
[[nodiscard]] BigFloat abs(const BigFloat& x);
[[nodiscard]] BigFloat sqrt(const BigFloat& x);
[[nodiscard]] BigFloat cbrt(const BigFloat& x);
[[nodiscard]] BigFloat exp(const BigFloat& x);
[[nodiscard]] BigFloat expm1(const BigFloat& x);
[[nodiscard]] BigFloat log(const BigFloat& x);
[[nodiscard]] BigFloat log1p(const BigFloat& x);
[[nodiscard]] BigFloat pow(const BigFloat& x, const BigFloat& y);
[[nodiscard]] BigFloat sin(const BigFloat& x);
[[nodiscard]] BigFloat cos(const BigFloat& x);
[[nodiscard]] BigFloat tan(const BigFloat& x);
[[nodiscard]] BigFloat atan(const BigFloat& x);
[[nodiscard]] BigFloat tgamma(const BigFloat& x);
[[nodiscard]] BigFloat lgamma(const BigFloat& x);  ///< log Gamma(x), x > 0
[[nodiscard]] BigFloat digamma(const BigFloat& x);
[[nodiscard]] inline bool isfinite(const BigFloat& x) {
  return mpfr_number_p(x.get()) != 0;
}
[[nodiscard]] inline bool isinf(const BigFloat& x) {
  return mpfr_inf_p(x.get()) != 0;
}
[[nodiscard]] inline bool isnan(const BigFloat& x) {
  return mpfr_nan_p(x.get()) != 0;
}

/// Scientific notation with so many significant digits; "inf", "-inf" and "nan" spelt so. @param digits 1 or more.
[[nodiscard]] std::string to_text(const BigFloat& x, int digits);

}  // namespace sklar

/// What templates over real types ask for; of the precision in force.
template <>
class std::numeric_limits<sklar::BigFloat> {
 public:
  static constexpr bool is_specialized = true;
  static constexpr bool has_infinity = true;
  static sklar::BigFloat epsilon();  ///< 2^(1 - bits)
  static sklar::BigFloat min();      ///< the smallest positive number
  static sklar::BigFloat infinity();
  static sklar::BigFloat quiet_NaN();
};
