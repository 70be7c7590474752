#pragma once
/// Archimedean<G>: density, cdf, conditionals and their inverses in any dimension, written once over a Generator.
///
/// Every number is computed with a running error bound, in double first; where the bound exceeds the tolerance below,
/// that row is repeated in long double, then with 70, 140, 280, ... digits. So a row meets the tolerance or, where
/// kLastDigits do not resolve it, is NaN; no row depends on another.

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "copula/archimedean_copula.hpp"
#include "copula/first_answer.hpp"
#include "copula/generator.hpp"
#include "copula/generic_route.hpp"
#include "copula/kernels.hpp"
#include "copula/row.hpp"
#include "copula/tolerance.hpp"

namespace sklar {

template <Generator G>
class Archimedean final : public ArchimedeanCopula {
 public:
  Archimedean(int dim, G generator) : ArchimedeanCopula(dim), generator_(std::move(generator)) {
    if constexpr (HasKernels<G>) kernels_ = generator_.kernels(dim);
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  void log_pdf_into(const PointsRef& u, const Reflection& reflection, ColumnOut out) const override {
    const Answered answered = start(Quantity::log_pdf, u, reflection, out.data());
    for_each_row(u, reflection, out, answered, [this](const Row& row) {
      if (row.u.size() == 1) return 0.0;
      return resolve([&]<class T>() { return log_density(RowOf<T>(row).all()); },
                     [](const auto& x) { return accept_log(x); });
    });
  }

  void log_cdf_into(const PointsRef& u, const Reflection& reflection, ColumnOut out) const override {
    require_few(reflection);
    for_each_row(u, reflection, out, Answered::none, [this](const Row& row) {
      if (std::ranges::find(row.u, 0.0) != row.u.end()) return -kInfinity;
      return resolve(
          [&]<class T>() {
            const RowOf<T> in_type(row);
            return row.reflection == nullptr ? log_distribution(in_type.all())
                                             : log_box(in_type.all(), *row.reflection);
          },
          [](const auto& x) { return accept_log(x); });
    });
  }

  void conditional_into(const PointsRef& u, const Reflection& reflection, Tail tail, ColumnOut out) const override {
    const Answered answered = start(tail == Tail::lower ? Quantity::h : Quantity::h_upper, u, reflection, out.data());
    for_each_row(u, reflection, out, answered, [this, tail](const Row& row) {
      if (const auto value = last_itself(row, tail)) return *value;
      return resolve(
          [&]<class T>() { return log_conditional(RowOf<T>(row).all()); },
          [side = side(row, tail)](const auto& log_h) { return accept_probability(log_h, side, kHTolerance); });
    });
  }

  void conditional_inverse_into(const PointsRef& u, const Reflection& reflection, Tail tail,
                                ColumnOut out) const override {
    const Answered answered =
        start(tail == Tail::lower ? Quantity::h_inv : Quantity::h_inv_upper, u, reflection, out.data());
    for_each_row(u, reflection, out, answered, [this, tail](const Row& row) {
      if (const auto value = last_itself(row, tail)) return *value;
      const auto kernel = [&]<class T>() {
        const RowOf<T> in_type(row);
        return -conditional_inverse(in_type.given(), in_type.last());
      };
      return resolve(kernel, [side = side(row, tail)](const auto& log_v) {
        return accept_probability(log_v, side, kInverseTolerance);
      });
    });
  }

  Answered quick_into(Quantity quantity, Accuracy accuracy, const PointsRef& u, double* out) const override {
    if (kernels_ == nullptr || u.cols() < (quantity == Quantity::log_pdf ? dim() : 2)) return Answered::none;
    switch (quantity) {
      case Quantity::log_pdf:
        return kernels_->log_pdf(accuracy, Rows(u), out);
      case Quantity::log_cdf:
        break;
      case Quantity::h:
        return kernels_->conditional(accuracy, Rows(u), Tail::lower, out);
      case Quantity::h_upper:
        return kernels_->conditional(accuracy, Rows(u), Tail::upper, out);
      case Quantity::h_inv:
        return kernels_->conditional_inverse(accuracy, Rows(u), Tail::lower, out);
      case Quantity::h_inv_upper:
        return kernels_->conditional_inverse(accuracy, Rows(u), Tail::upper, out);
    }
    return Answered::none;
  }

  // Lets the vector kernels answer the rows that they can.
  Answered start(Quantity quantity, const PointsRef& u, const Reflection& reflection, double* out) const {
    return reflection.none() ? quick_into(quantity, Accuracy::standard, u, out) : Answered::none;
  }

  // h and its inverse where they are the last entry.
  static std::optional<double> last_itself(const Row& row, Tail tail) {
    const double last = row.u.back();
    if (row.u.size() > 1 && last != 0 && last != 1) return std::nullopt;
    return tail == Tail::lower ? last : 1 - last;
  }

  // P(1 - V <= u) = P(V >= 1 - u): with the last coordinate reflected the tails change places.
  static Tail side(const Row& row, Tail tail) {
    const bool lower = (tail == Tail::lower) != row.is_reflected(row.u.size() - 1);
    return lower ? Tail::lower : Tail::upper;
  }

  void log_abs_dpsi_into(int order, const ColumnRef& t, ColumnOut out) const override {
    for_each_row(PointsRef(t), {}, out, Answered::none, [this, order](const Row& row) {
      return resolve([&]<class T>() { return generator_.log_abs_dpsi(order, T(row.u[0])); },
                     [](const auto& x) { return accept_log(x); });
    });
  }

  [[nodiscard]] bool has_frailty() const override {
    if constexpr (HasFrailty<G>) return generator_.has_frailty();
    return false;
  }

  double log_frailty([[maybe_unused]] Rng& rng) const override {
    if constexpr (HasFrailty<G>) return generator_.log_frailty(rng);
    return 0;
  }

  double psi_at_log(double x, Tail tail) const override {
    return resolve([&]<class T>() { return generator_.log_psi(exp(T(x))); },
                   [tail](const auto& log_psi) { return accept_probability(log_psi, tail, kInverseTolerance); });
  }

  double log_radial_survival(double x) const override {
    return resolve([&]<class T>() { return log_survival(exp(T(x)), T(x)); },
                   [](const auto& log_survival) { return accept_log(log_survival); });
  }

  void kendall_into(const ColumnRef& v, Tail tail, ColumnOut out) const override {
    for_each_row(PointsRef(v), {}, out, Answered::none, [this, tail](const Row& row) {
      const double level = row.u[0];
      if (level == 0 || level == 1) return tail == Tail::lower ? level : 1 - level;
      const auto kernel = [&]<class T>() {
        const T r = generator_.psi_inv(T(level));
        return log_survival(r, log(r));
      };
      return resolve(kernel, [tail](const auto& log_k) { return accept_probability(log_k, tail, kHTolerance); });
    });
  }

  // log sum_{k<d} r^k |psi^(k)(r)| / k!
  template <class T>
  T log_survival(const T& r, const T& log_r) const {
    T sum = exp(generator_.log_psi(r)), log_factorial(0);
    for (int k = 1; k < dim(); ++k) {
      log_factorial += log(T(k));
      sum += exp(T(k) * log_r + generator_.log_abs_dpsi(k, r) - log_factorial);
    }
    return log(sum);
  }

  BigFloat exact_row(Quantity quantity, std::span<const BigFloat> u, const Reflection& reflection,
                     int digits) const override {
    const bool conditional = quantity != Quantity::log_pdf && quantity != Quantity::log_cdf;
    const bool complement = quantity == Quantity::h_upper || quantity == Quantity::h_inv_upper;
    if (conditional && (u.size() == 1 || u.back() == 0 || u.back() == 1)) {
      const WorkingPrecision precision(digits + kGuardDigits);
      return complement ? 1 - u.back() : u.back();
    }
    if (quantity == Quantity::log_pdf && u.size() == 1) return 0;
    if (quantity == Quantity::log_cdf) {
      require_few(reflection);
      if (std::ranges::find(u, BigFloat(0)) != u.end()) return BigFloat(-kInfinity);
    }
    return resolve_digits(digits, [&](int) -> Widest {
      std::vector<Widest> row;
      for (std::size_t k = 0; k < u.size(); ++k) {
        row.push_back(reflection[k] ? reflected<Widest>(u[k]) : Widest(u[k], 0));
      }
      const std::span<const Widest> all(row);
      if (quantity == Quantity::log_pdf) return log_density(all);
      if (quantity == Quantity::log_cdf) return reflection.none() ? log_distribution(all) : log_box(all, reflection);
      const bool inverse = quantity == Quantity::h_inv || quantity == Quantity::h_inv_upper;
      const Widest log_value =
          inverse ? -conditional_inverse(all.first(all.size() - 1), all.back()) : log_conditional(all);
      return complement != reflection[u.size() - 1] ? -expm1(log_value) : exp(log_value);
    });
  }

  BigFloat exact_log_abs_dpsi_at(int order, double t, int digits) const override {
    return resolve_digits(digits, [&](int) { return generator_.log_abs_dpsi(order, Widest(t)); });
  }

  // Calls answer(row) for each row without NaN; a row with NaN gives NaN. @param answered which rows have an
  // answer in out, the others NaN.
  template <class Answer>
  static void for_each_row(const PointsRef& u, const Reflection& reflection, ColumnOut out, Answered answered,
                           const Answer& answer) {
    if (answered == Answered::all) return;
    constexpr std::size_t kOnStack = 16;
    const auto columns = static_cast<std::size_t>(u.cols());
    std::array<double, kOnStack> small;
    std::vector<double> large(columns > kOnStack ? columns : 0);
    const std::span<double> row(columns > kOnStack ? large.data() : small.data(), columns);
    const Reflection* reflected = reflection.none() ? nullptr : &reflection;
    for (Index i = 0; i < u.rows(); ++i) {
      if (answered == Answered::some && !std::isnan(out(i))) continue;
      bool missing = false;
      for (Index k = 0; k < u.cols(); ++k) {
        row[static_cast<std::size_t>(k)] = u(i, k);
        missing = missing || std::isnan(u(i, k));
      }
      out(i) = missing ? std::numeric_limits<double>::quiet_NaN() : answer(Row{row, reflected});
    }
  }

  // kernel<T>() in the first number type whose error bound `accept` finds small enough.
  template <class Kernel, class Accept>
  static double resolve(const Kernel& kernel, const Accept& accept) {
    const auto answer = first_answer([&]<class T>() { return accept(kernel.template operator()<T>()); });
    return answer.value_or(std::numeric_limits<double>::quiet_NaN());
  }

  template <class Real>
  static std::optional<double> accept_log(const Bounded<Real>& x) {
    return if_within(kLogTolerance, x);
  }

  static constexpr long double kResolution = 0x1p-1080L;  // far below the smallest double; 0 as a double

  // e^x or 1 - e^x from x = log of a probability. Results below the normal range are left to wider types.
  template <class Real>
  static std::optional<double> accept_probability(const Bounded<Real>& x, Tail tail, double tolerance) {
    using std::isfinite;
    const Bounded<Real> answer = tail == Tail::lower ? exp(x) : -expm1(x);
    // Below the normal range a double is the rounded value of a wider type.
    const bool subnormal = answer.value < std::numeric_limits<double>::min();
    const Real allowed = subnormal ? static_cast<Real>(kResolution) : tolerance * answer.value;
    if (!isfinite(answer.error) || !(answer.error <= allowed)) return std::nullopt;
    if (std::is_same_v<Real, double> && subnormal) return std::nullopt;
    return static_cast<double>(answer.value);
  }

  template <class T>
  T log_density(std::span<const T> u) const {
    if constexpr (HasLogDensity<G>) {
      return generator_.log_density(u);
    } else {
      return generic_log_density(generator_, u);
    }
  }

  template <class T>
  T log_distribution(std::span<const T> u) const {
    if constexpr (HasLogCdf<G>) {
      return generator_.log_cdf(u);
    } else {
      return generator_.log_psi(generic_sum(generator_, u));
    }
  }

  // log P(V_i <= v_i, of the reflected i V_i >= v_i), by inclusion and exclusion over these or between two bounds.
  template <class T>
  T log_box(std::span<const T> v, const Reflection& reflection) const {
    using Real = decltype(T::value);
    constexpr std::size_t kFew = 3;  // inclusion and exclusion cost less than the bounds
    std::vector<T> below, above;
    for (std::size_t k = 0; k < v.size(); ++k) {
      if (!is_zero(v[k])) (reflection[k] ? above : below).push_back(v[k]);
    }
    for (const T& value : above) {  // P is at most each 1 - v_i, and unknown with it
      const T rest = T(1) - value;
      if (!(rest.value > rest.error)) return {Real(0), T::unknown()};
    }
    if (above.size() > kFew) {
      T between = log_box_between(below, above);
      if (is_within(kLogTolerance, between)) return between;
    }
    T log_sum = log(box_sum(below, above));
    if (above.empty() || is_within(kLogTolerance, log_sum)) return log_sum;
    T between = log_box_between(below, above);
    return between.error < log_sum.error ? between : log_sum;
  }

  // The terms of inclusion and exclusion: of all below and each subset of those above.
  template <class T>
  T box_sum(const std::vector<T>& below, const std::vector<T>& above) const {
    T sum(0);
    for (std::size_t subset = 0; subset < std::size_t{1} << above.size(); ++subset) {
      std::vector<T> corner = below;
      for (std::size_t i = 0; i < above.size(); ++i) {
        if ((subset >> i & 1) != 0) corner.push_back(above[i]);
      }
      const bool odd = (corner.size() - below.size()) % 2 != 0;
      const T value = corner.empty() ? T(1) : exp(log_distribution(std::span<const T>(corner)));
      sum += odd ? -value : value;
    }
    return sum;
  }

  // Where those terms cancel, for m values above: the integral of |psi^(m)| over a box of sides e_i = psi^-1(v_i),
  // along the sum of the coordinates, from r = sum psi^-1 of the values below. |psi^(m)| decreases: for m < d, and for
  // a Laplace transform.
  template <class T>
  T log_box_between(const std::vector<T>& below, const std::vector<T>& above) const {
    using Real = decltype(T::value);
    const int m = static_cast<int>(above.size());
    if (m == dim() && !has_frailty()) return {Real(0), T::unknown()};
    T r(0), sides(0), log_volume(0);
    for (const T& value : below) r += generator_.psi_inv(value);
    for (const T& value : above) {
      const T side = generator_.psi_inv(value);
      sides += side;
      log_volume += log(side);
    }
    const T most = log_volume + generator_.log_abs_dpsi(m, r),
            least = log_volume + generator_.log_abs_dpsi(m, r + sides);
    const T apart = abs(most - least);
    return {least.value, Real(least.error + apart.value + apart.error)};
  }

  template <class T>
  T log_conditional(std::span<const T> u) const {
    if constexpr (HasLogConditional<G>) {
      return generator_.log_conditional(u);
    } else {
      return generic_log_conditional(generator_, u);
    }
  }

  template <class T>
  T conditional_inverse(std::span<const T> given, const T& p) const {
    if constexpr (HasConditionalInverse<G>) {
      return generator_.conditional_inverse(given, p);
    } else {
      return generic_conditional_inverse(generator_, given, p);
    }
  }

  G generator_;
  std::shared_ptr<const Kernels> kernels_;
};

}  // namespace sklar
