#pragma once
/// Cancellation-free building blocks, templates over the number type T (Narrow, Extended, Widest).

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "copula/bounded.hpp"
#include "copula/wide.hpp"

namespace sklar {

/// log(1 - e^-x), x > 0. Branch at log 2: Maechler (2012), "Accurately computing log(1 - exp(-|a|))", eq. 7.
template <class T>
[[nodiscard]] T log1mexp(const T& x) {
  return x < T(0.6931471805599453) ? log(-expm1(-x)) : log1p(-exp(-x));
}

/// log(e^x - 1), x > 0. From x = 30 on e^x would overflow before the answer does.
template <class T>
[[nodiscard]] T log_expm1(const T& x) {
  return x < T(30) ? log(expm1(x)) : x + log1p(-exp(-x));
}

/// log(e^a + e^b).
template <class T>
[[nodiscard]] T log_add_exp(const T& a, const T& b) {
  return a < b ? b + log1p(exp(a - b)) : a + log1p(exp(b - a));
}

/// Whether a number is 0 or 1 itself, not one that may be near it.
template <class T>
[[nodiscard]] bool is_zero(const T& x) {
  return x.value == 0 && x.error == 0;
}
template <class T>
[[nodiscard]] bool is_one(const T& x) {
  return x.value == 1 && x.error == 0;
}

/// How many of the numbers are 0 or 1 themselves, and whether all are 1.
template <class T>
[[nodiscard]] int count_zeros(std::span<const T> u) {
  return static_cast<int>(std::ranges::count_if(u, is_zero<T>));
}
template <class T>
[[nodiscard]] int count_ones(std::span<const T> u) {
  return static_cast<int>(std::ranges::count_if(u, is_one<T>));
}
template <class T>
[[nodiscard]] bool all_ones(std::span<const T> u) {
  return std::ranges::all_of(u, is_one<T>);
}

/// The smallest of one or more numbers, errors aside.
template <class T>
[[nodiscard]] const T& smallest_of(std::span<const T> u) {
  return *std::min_element(u.begin(), u.end());
}

/// log(u / v) for u, v > 0 whose logarithms are at hand, with small relative error where u is near v (u - v is exact
/// there, if u and v are).
template <class T>
[[nodiscard]] T log_ratio(const T& u, const T& v, const T& log_u, const T& log_v) {
  return u > T(0.5) * v && u < T(2) * v ? log1p((u - v) / v) : log_u - log_v;
}

/// Whether x <= 0 for sure. In Widest a value within its own error bound counts as 0 once the bound is below what
/// powers of doubles, down to the smallest, can differ by.
template <class T>
[[nodiscard]] bool not_positive(const T& x) {
  if (x.value + x.error <= 0) return true;
  if constexpr (std::is_same_v<T, Widest>)
    return x.value <= x.error && x.error < BigFloat(0x1p-1000) * BigFloat(0x1p-200);
  return false;
}

/// The most that |x| may be.
template <class T>
[[nodiscard]] auto largest_magnitude(const T& x) {
  using std::abs;
  return decltype(x.value)(abs(x.value) + x.error);
}

/// Horner's rule: sum_k coefficients[k] x^k.
template <class T>
[[nodiscard]] T polynomial(std::span<const T> coefficients, const T& x) {
  T sum = coefficients.back();
  for (std::size_t k = coefficients.size() - 1; k-- > 0;) sum = sum * x + coefficients[k];
  return sum;
}

/// The same for the polynomial with the coefficients in reverse order: x^n p(1/x).
template <class T>
[[nodiscard]] T reversed_polynomial(std::span<const T> coefficients, const T& x) {
  T sum = coefficients.front();
  for (std::size_t k = 1; k < coefficients.size(); ++k) sum = sum * x + coefficients[k];
  return sum;
}

/// Root y > 0 of an increasing function N with N(0) = 0 at the level `target` > 0, by Newton steps on log N as a
/// function of log y, kept inside a bracket. @param rate T -> pair (N(y), N'(y)). @param start first guess, > 0.
/// @return y; its error follows from the residual and the slope at y, infinite where the slope may be 0.
template <class T, class Rate>
[[nodiscard]] T solve_increasing(const Rate& rate, const T& target, const T& start) {
  using Real = std::remove_cvref_t<decltype(start.value)>;
  using std::abs, std::exp, std::isfinite, std::log, std::sqrt;
  constexpr int kMaxSteps = 400;  // bisection in log y alone takes about 60 (double) or 250 (wide)
  const Real resolution = 2 * std::numeric_limits<Real>::epsilon();
  Real y = start.value, below = 0, above = std::numeric_limits<Real>::infinity();
  for (int step = 0;; ++step) {
    const auto [level, slope] = rate(T(y, Real(0)));
    const T residual = level - target;
    const bool settled = isfinite(residual.error) && abs(residual.value) <= residual.error / 4;
    const bool done = settled || step == kMaxSteps || above - below <= resolution * y;
    if (done) {
      const Real least = slope.value - slope.error;
      const Real error = (abs(residual.value) + residual.error) / least * Real(1.125) + resolution * y;
      return {y, least > 0 ? error : std::numeric_limits<Real>::infinity()};
    }
    (residual.value < 0 ? below : above) = y;
    Real next = y * exp(Real(-log(Real(level.value / target.value)) * level.value / (y * slope.value)));
    if (!(next > below && next < above)) {
      next = !isfinite(above) ? Real(y * 1024) : below == 0 ? Real(y / 1024) : Real(sqrt(below) * sqrt(above));
    }
    if (abs(next - y) <= resolution * y / 4) below = above = y;
    y = next;
  }
}

/// A value for each working precision that was asked for, each made once; safe to share between threads.
template <class Value>
class PerWorkingPrecision {
 public:
  /// @param make fills a Value in the working precision in force.
  template <class Make>
  [[nodiscard]] const Value& get(const Make& make) const {
    const std::lock_guard lock(mutex_);
    const auto [place, added] = values_.try_emplace(WorkingPrecision::bits());
    if (added) make(place->second);
    return place->second;
  }

 private:
  mutable std::mutex mutex_;
  mutable std::map<long, Value> values_;  // addresses stay
};

/// The nearest double, its error bound no longer that of a long computation in double.
[[nodiscard]] inline Narrow narrowed(const Extended& x) {
  const auto value = static_cast<double>(x.value);
  const long double error = (std::abs(x.value - value) + x.error) * 1.000001L;
  const bool exact = error == 0 || x.value == value;  // an infinity may be exact
  return {value, exact && x.error == 0 ? 0.0 : std::max(static_cast<double>(error), Narrow::underflow())};
}

/// A sum whose rounding errors are carried along: its bound is that of the terms and one rounding. Widest: a plain sum.
template <class T>
class Total {
 public:
  Total& operator+=(const T& term) {
    using Real = decltype(term.value);
    if constexpr (std::is_floating_point_v<Real>) {
      if (std::isfinite(term.value) && std::isfinite(term.error)) {
        // Knuth's two-sum: high + low is exact but for the rounding of low, below eps |low| (Higham, sec. 4.3).
        const Real sum = high_.value + term.value, moved = sum - high_.value;
        low_ += (high_.value - (sum - moved)) + (term.value - moved);
        high_ = {sum, high_.error + term.error + std::numeric_limits<Real>::epsilon() * std::abs(low_)};
        return *this;
      }
    }
    other_ += term;
    return *this;
  }

  [[nodiscard]] T value() const { return high_ + T(low_, decltype(low_)(0)) + other_; }

 private:
  T high_{0};
  decltype(T::value) low_{0};
  T other_{0};
};

/// Coefficients c(n,k), 0 <= k < max(n,1), of a two-term recurrence; c(0,0) = c(1,0) = 1.
/// Rule::entry<T>(n, k, same, left) gives c(n,k) from same = c(n-1,k) and left = c(n-1,k-1) (0 outside the triangle).
/// Rows for Extended are built at once, those for Narrow are these rounded, those for Widest on first use in a
/// precision; safe to share between threads.
template <class Rule>
class Triangle {
 public:
  Triangle(int rows, Rule rule) : rows_(rows), rule_(std::move(rule)) {
    build(extended_);
    for (const std::vector<Extended>& row : extended_) {
      std::vector<Narrow>& next = narrow_.emplace_back();
      for (const Extended& entry : row) next.push_back(narrowed(entry));
    }
  }

  [[nodiscard]] const Rule& rule() const { return rule_; }

  template <class T>
  [[nodiscard]] std::span<const T> row(int n) const {
    if constexpr (std::is_same_v<T, Narrow>) {
      return narrow_[static_cast<std::size_t>(n)];
    } else if constexpr (std::is_same_v<T, Extended>) {
      return extended_[static_cast<std::size_t>(n)];
    } else {
      return wide_.get([this](std::vector<std::vector<T>>& rows) { build(rows); })[static_cast<std::size_t>(n)];
    }
  }

 private:
  template <class T>
  void build(std::vector<std::vector<T>>& rows) const {
    rows.assign(static_cast<std::size_t>(rows_ < 2 ? 2 : rows_), {T(1)});
    for (int n = 2; n < rows_; ++n) {
      const std::vector<T>& last = rows[static_cast<std::size_t>(n) - 1];
      std::vector<T>& next = rows[static_cast<std::size_t>(n)];
      next.resize(static_cast<std::size_t>(n));
      for (int k = 0; k < n; ++k) {
        const T same = k < n - 1 ? last[static_cast<std::size_t>(k)] : T(0);
        const T left = k > 0 ? last[static_cast<std::size_t>(k) - 1] : T(0);
        next[static_cast<std::size_t>(k)] = rule_.template entry<T>(n, k, same, left);
      }
    }
  }

  int rows_;
  Rule rule_;
  std::vector<std::vector<Narrow>> narrow_;
  std::vector<std::vector<Extended>> extended_;
  PerWorkingPrecision<std::vector<std::vector<Widest>>> wide_;
};

/// One value of Constants<T> for each number type and working precision, made once: what a generator needs of its
/// parameters alone. Arguments are kept as copies.
template <template <class> class Constants>
class PerPrecision {
 public:
  template <class... Arguments>
  explicit PerPrecision(const Arguments&... arguments)
      : narrow_(arguments...),
        extended_(arguments...),
        make_wide_([arguments...](std::optional<Constants<Widest>>& wide) { wide.emplace(arguments...); }) {}

  template <class T>
  [[nodiscard]] const Constants<T>& get() const {
    if constexpr (std::is_same_v<T, Narrow>) {
      return narrow_;
    } else if constexpr (std::is_same_v<T, Extended>) {
      return extended_;
    } else {
      return *wide_.get(make_wide_);
    }
  }

 private:
  Constants<Narrow> narrow_;
  Constants<Extended> extended_;
  std::function<void(std::optional<Constants<Widest>>&)> make_wide_;
  PerWorkingPrecision<std::optional<Constants<Widest>>> wide_;
};

/// Partial sums: entry n is the sum of term(k) for 0 < k < n, entries 0..count. @param term T -> T for any T.
template <class T, class Term>
[[nodiscard]] std::vector<T> cumulative(int count, const Term& term) {
  std::vector<T> sums(2, T(0));
  if constexpr (std::is_same_v<T, Narrow>) {
    const std::vector<Extended> wide = cumulative<Extended>(count, term);
    for (std::size_t k = 2; k < wide.size(); ++k) sums.push_back(narrowed(wide[k]));
  } else {
    for (int k = 1; k < count; ++k) sums.push_back(sums.back() + term(T(k)));
  }
  return sums;
}

/// The x between lowest and highest with f(x) = target, f increasing, to the last places of x; the nearer end where f
/// does not reach the target there.
[[nodiscard]] double invert_increasing(const std::function<double(double)>& f, double target, double lowest,
                                       double highest);

/// 1/4 - (1 - D_1(x)) / x with the first Debye function D_1(x) = (1/x) int_0^x t / (e^t - 1) dt: odd, x/36 near 0,
/// 1/4 at infinity; relative error below 1e-15 (small x) to 1e-14. Abramowitz and Stegun 27.1.1 and 27.1.2.
[[nodiscard]] double debye_1_defect(double x);

/// The root nearest 0 of the Eulerian polynomial A_n, n >= 2; all its roots are real and negative.
[[nodiscard]] long double eulerian_root(int n);

}  // namespace sklar
