// Vector kernels of the Gumbel copula. Errors are counted in units of 2^-52.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "families/gumbel_simd.cpp"
#include "copula/instruction_sets.hpp"
//
#include <hwy/foreach_target.h>
//
#include "copula/simd/decrease-inl.h"
#include "copula/simd/polynomial-inl.h"
#include "copula/simd/rows-inl.h"
#include "families/gumbel.hpp"

#ifndef SKLAR_FAMILIES_GUMBEL_SIMD_ONCE
#define SKLAR_FAMILIES_GUMBEL_SIMD_ONCE
namespace sklar::families::gumbel {

/// What depends on theta and the dimension alone.
struct KernelConstants {
  KernelConstants(double parameter, std::vector<Coefficients> coefficients)
      : theta(parameter),
        inverse_theta(1 / theta),
        lost_inverse(static_cast<double>(1 / static_cast<long double>(theta) - inverse_theta)),
        polynomials(std::move(coefficients)) {
    for (std::size_t n = 0; n < polynomials.size(); ++n)
      roots.push_back(std::pow(static_cast<double>(n), inverse_theta));
  }

  double theta, inverse_theta;
  double lost_inverse;                    // 1/theta - inverse_theta
  std::vector<Coefficients> polynomials;  // R_n at n
  std::vector<double> roots;              // n^(1/theta) at n
};

constexpr int kMostSteps = 8;

}  // namespace sklar::families::gumbel
#endif

HWY_BEFORE_NAMESPACE();
namespace sklar::families::gumbel::HWY_NAMESPACE {

using namespace sklar::simd;
using namespace sklar::simd::HWY_NAMESPACE::formulas;

// Relative: the next step of a method of order 3 is far below rounding.
template <class D>
constexpr double kLastStep = Precision<D>::kSingle ? 2e-3 : 1e-6;

constexpr double kOfX = 1.4, kOfLog = kOfX + kLogPartError;  // relative of x, absolute of log x beside |log x|/2

/// s of some x_i = -log u_i, s^theta = sum x_i^theta, and the absolute error of its logarithm. kPair: of two.
template <class D, bool kPair = false>
class PowerMean {
 public:
  explicit PowerMean(D d) : inside(hn::Le(hn::Zero(d), hn::Zero(d))), powers_(d), weighed_(hn::Zero(d)) {}

  /// Adds x; returns log x.
  HWY_INLINE Vec<D> add(D d, const KernelConstants& c, Vec<D> x) {
    const Vec<D> log_x = log(d, x), power = exp(d, hn::Mul(hn::Set(d, c.theta), log_x));
    powers_.add(d, power);
    weighed_ = hn::MulAdd(power, hn::Abs(log_x), weighed_);
    return log_x;
  }

  HWY_INLINE void finish(D d, const KernelConstants& c, Index count) {
    constexpr double kProduct = HWY_NATIVE_FMA ? 0 : 0.5;
    const Vec<D> sum = powers_.value(), log_sum = log(d, sum), lost = hn::Mul(log_sum, hn::Set(d, c.lost_inverse));
    inside = hn::Gt(log_sum, hn::Set(d, Precision<D>::kLowestExponent));
    log_value = hn::MulAdd(log_sum, hn::Set(d, c.inverse_theta), lost);
    value = exp(d, log_value);
    // A power is off by theta times what x and log x are, theta |log x| / 2 by its exponent, and 1. Of x it is 1/2 and
    // 0.3/x: weighed by the powers, 1/x is at most n^(1/theta) / s (Hoelder).
    const Vec<D> mean_inverse = hn::Div(hn::Set(d, kLogPartError * c.roots[static_cast<std::size_t>(count)]), value);
    const Vec<D> of_x = hn::Add(hn::Min(mean_inverse, hn::Set(d, kOfX - 0.5)), hn::Div(weighed_, sum));
    const double of_roundings = 0.5 + kLogPartError + (1.5 + kLogPartError) * c.inverse_theta;
    error = hn::MulAdd(hn::Set(d, 1 + kProduct), hn::Abs(log_value), hn::Add(of_x, hn::Set(d, of_roundings)));
  }

  Vec<D> value, log_value, error;
  Mask<D> inside;

 private:
  Sum<D, kPair> powers_;
  Vec<D> weighed_;  // sum x_i^theta |log x_i|
};

/// log c = (theta-1) (sum log x_i - d log s) + sum x_i - s + log R_d(1/s).
template <bool kPair, class D>
HWY_INLINE Vec<D> log_pdf_rows(D d, const KernelConstants& c, const Columns<D>& rows) {
  constexpr double kProduct = HWY_NATIVE_FMA ? 0 : 0.5;
  const Index size = kPair ? 2 : rows.size();
  const auto n = static_cast<double>(size);
  const double excess = c.theta - 1;
  PowerMean<D, kPair> mean(d);
  Sum<D, kPair> x_sum(d), log_sum(d);
  Vec<D> sizes = hn::Zero(d);  // sum |log x_i|
  auto inside = rows.inside(0);
  for (Index k = 0; k < size; ++k) {
    inside = hn::And(inside, rows.inside(k));
    const Vec<D> x = hn::Neg(rows.log_of(k)), log_x = mean.add(d, c, x);
    x_sum.add(d, x);
    log_sum.add(d, log_x);
    sizes = hn::Add(sizes, hn::Abs(log_x));
  }
  mean.finish(d, c, size);
  const Vec<D> s = mean.value, half = hn::Set(d, 0.5), count = hn::Set(d, n), scale = hn::Set(d, excess);
  const Coefficients& coefficients = c.polynomials[static_cast<std::size_t>(size)];
  const LogPolynomial<D> polynomial = log_polynomial(d, coefficients, hn::Set(d, 1.0), s);
  const Vec<D> ratios = hn::NegMulAdd(count, mean.log_value, log_sum.value());
  const Vec<D> rest = hn::Add(hn::Sub(x_sum.value(), s), polynomial.log);
  const Vec<D> value = hn::MulAdd(scale, ratios, rest);
  // Each term by what it depends on and its own roundings.
  const Vec<D> weight = hn::Add(hn::Add(s, polynomial.slope), hn::Set(d, excess * n));
  const Vec<D> of_ratios = hn::Add(hn::MulAdd(hn::Set(d, kProduct * n), hn::Abs(mean.log_value), hn::Abs(ratios)),
                                   hn::Add(sizes, hn::Set(d, n * kOfLog)));
  const Vec<D> of_x = hn::MulAdd(hn::Set(d, 1.5), x_sum.value(), hn::Add(hn::Add(s, s), hn::Set(d, n * kLogPartError)));
  const Vec<D> of_y = hn::MulAdd(hn::Set(d, 1.5), polynomial.slope, polynomial.error);
  const Vec<D> roundings = hn::MulAdd(half, hn::Add(hn::Abs(rest), hn::Abs(value)),
                                      hn::Set(d, coefficients.relative_error / Precision<D>::kUnit));
  const Vec<D> of_terms = hn::MulAdd(scale, of_ratios, hn::Add(hn::Add(of_x, of_y), roundings));
  const Vec<D> error = hn::Mul(hn::Set(d, Precision<D>::kUnit), hn::MulAdd(mean.error, weight, of_terms));
  return log_within(d, {value, error}, hn::And(inside, mean.inside));
}

template <class D>
HWY_INLINE Vec<D> log_pdf_row(D d, const KernelConstants& c, const Columns<D>& rows) {
  if (rows.size() == 2) return log_pdf_rows<true>(d, c, rows);
  return log_pdf_rows<false>(d, c, rows);
}

/// -log h = x expm1(l) + (theta-1) l, l = log1p((y/x)^theta) / theta.
template <class D>
HWY_INLINE Vec<D> conditional_pair(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Vec<D> x = hn::Neg(rows.log_of(0)), log_ratio = log(d, hn::Div(hn::Neg(rows.log_of(1)), x));
  const Vec<D> exponent = hn::Mul(hn::Set(d, c.theta), log_ratio);
  const auto in_range = hn::Gt(exponent, hn::Set(d, Precision<D>::kLowestExponent));
  const Vec<D> l = hn::Mul(log1p(d, exp(d, exponent)), hn::Set(d, 1 / c.theta));
  const Vec<D> growth = expm1(d, l), slope = hn::MulAdd(x, hn::Add(growth, hn::Set(d, 1.0)), hn::Set(d, c.theta - 1));
  const Vec<D> y = hn::Neg(hn::MulAdd(x, growth, hn::Mul(hn::Set(d, c.theta - 1), l)));
  // Of l: relative 3 theta + 2 |exponent| + 3 of the power, weighed by its share in the logarithm.
  const Vec<D> share = hn::Min(l, hn::Set(d, 1 / c.theta));
  const Vec<D> of_power = hn::MulAdd(hn::Set(d, 2.5), hn::Abs(exponent), hn::Set(d, 4.0 * c.theta + 4));
  const Vec<D> of_l = hn::MulAdd(of_power, share, hn::Mul(hn::Set(d, 2.0), l));
  const Vec<D> error = hn::MulAdd(of_l, slope, hn::Mul(hn::Set(d, -4.0), y));
  return probability(d, tail, y, hn::Mul(hn::Set(d, Precision<D>::kUnit), error), kHTolerance,
                     hn::And(in_range, hn::And(rows.inside(0), rows.inside(1))));
}

/// s of the coordinates given.
template <class D>
HWY_INLINE PowerMean<D> mean_of_given(D d, const KernelConstants& c, const Columns<D>& rows) {
  PowerMean<D> mean(d);
  auto inside = rows.inside(0);
  for (Index k = 0; k < rows.size() - 1; ++k) {
    inside = hn::And(inside, rows.inside(k));
    mean.add(d, c, hn::Neg(rows.log_of(k)));
  }
  mean.finish(d, c, rows.size() - 1);
  mean.inside = hn::And(inside, mean.inside);
  return mean;
}

/// -log h = s expm1(l) + j (theta-1) l - log( R_j(e^-l / s) / R_j(1/s) ) of the j given, all positive, and its error
/// and derivative in l.
template <class D>
struct Level {
  /// @param of_l the absolute error of l.
  HWY_INLINE Level(D d, const KernelConstants& c, Index given, const PowerMean<D>& s, const ScaledArgument<D>& at,
                   Vec<D> l, Vec<D> of_l) {
    const Vec<D> rounding = hn::Set(d, 1.5), of_s = hn::Add(s.error, hn::Set(d, 3.0));
    const Vec<D> constant = hn::Set(d, static_cast<double>(given) * (c.theta - 1));
    const Exponential<D> up = exponential(d, l), down = exponential(d, hn::Neg(l));
    const Vec<D> distance = hn::Neg(down.expm1);
    const RatioErrors<D> of{of_s, hn::Add(of_l, rounding),
                            hn::Add(hn::Div(hn::Mul(of_l, down.exp), distance), rounding)};
    const Decrease<D> ratio = decrease(d, c.polynomials[static_cast<std::size_t>(given)], at, down.exp, distance, of);
    const Estimate<D> rest = ratio.fraction.minus_log(d);
    const Vec<D> rise = hn::Mul(s.value, up.expm1);
    moved = hn::Mul(s.value, up.exp);
    value = hn::Add(hn::MulAdd(constant, l, rise), rest.value);
    slope = hn::Add(hn::Add(moved, constant), ratio.slope);
    const Vec<D> of_first = hn::MulAdd(hn::Add(moved, constant), of_l, hn::Mul(rise, of_s));
    error = hn::Add(hn::MulAdd(hn::Set(d, 3.0), value, of_first), rest.error);
    inside = hn::And(s.inside, ratio.inside);
  }

  Vec<D> value, slope, error;
  Vec<D> moved;  // s e^l
  Mask<D> inside;
};

template <class D>
HWY_INLINE ScaledArgument<D> argument_at(D d, const KernelConstants& c, Index given, const PowerMean<D>& s) {
  return ScaledArgument<D>(d, c.polynomials[static_cast<std::size_t>(given)], hn::Set(d, 1.0), s.value);
}

/// l = log1p((x/s)^theta) / theta.
template <class D>
HWY_INLINE Vec<D> conditional_rows(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Index last = rows.size() - 1;
  const Vec<D> one = hn::Set(d, 1.0), two = hn::Set(d, 2.0), theta = hn::Set(d, c.theta);
  const Vec<D> inverse_theta = hn::Set(d, 1 / c.theta);
  const PowerMean<D> s = mean_of_given(d, c, rows);
  const Vec<D> log_x = log(d, hn::Neg(rows.log_of(last))), exponent = hn::Mul(theta, hn::Sub(log_x, s.log_value));
  const Vec<D> log_growth = log1p(d, exp(d, exponent)), l = hn::Mul(log_growth, inverse_theta);
  // Of (x/s)^theta beside what its factors carry, and of l.
  const Vec<D> of_logs = hn::Add(s.error, hn::MulAdd(two, hn::Abs(log_x), two));
  const Vec<D> of_power = hn::MulAdd(theta, of_logs, hn::MulAdd(two, hn::Abs(exponent), two));
  const Vec<D> of_l = hn::MulAdd(of_power, hn::Mul(hn::Min(log_growth, one), inverse_theta), hn::Mul(two, l));
  const Level<D> level(d, c, last, s, argument_at(d, c, last, s), l, of_l);
  const auto inside = hn::And(rows.inside(last), hn::Gt(exponent, hn::Set(d, Precision<D>::kLowestExponent)));
  return probability(d, tail, hn::Neg(level.value), hn::Mul(hn::Set(d, Precision<D>::kUnit), level.error), kHTolerance,
                     hn::And(inside, level.inside));
}

template <class D>
HWY_INLINE Vec<D> conditional_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  if constexpr (!Precision<D>::kSingle) {
    if (rows.size() > 2) return conditional_rows(d, c, tail, rows);
  }
  return conditional_pair(d, c, tail, rows);
}

/// l by Halley's iteration for the convex x expm1(l) + (theta-1) l = -log p from a point below the root, then
/// y = x e^l (1 - e^(-theta l))^(1/theta), v = e^-y.
template <class D>
HWY_INLINE Vec<D> conditional_inverse_pair(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Vec<D> excess = hn::Set(d, c.theta - 1);
  const Vec<D> x = hn::Neg(rows.log_of(0)), target = hn::Neg(rows.log_of(1));
  Vec<D> l = log1p(d, hn::Div(target, hn::Add(x, excess)));
  Exponential<D> e = exponential(d, l);
  auto moving = hn::Gt(l, hn::Zero(d));  // a lane that has arrived stays, whatever its neighbours do
  for (int i = 0; i < kMostSteps && !hn::AllFalse(d, moving); ++i) {
    const Vec<D> excess_value = hn::Sub(hn::MulAdd(x, e.expm1, hn::Mul(excess, l)), target);
    const Vec<D> second = hn::Mul(x, e.exp), slope = hn::Add(second, excess);
    const Vec<D> twice = hn::Add(excess_value, excess_value);
    const Vec<D> step =
        hn::Div(hn::Mul(twice, slope), hn::NegMulAdd(excess_value, second, hn::Mul(hn::Add(slope, slope), slope)));
    l = hn::Sub(l, hn::IfThenElseZero(moving, step));
    e = exponential(d, l);
    moving = hn::And(moving, hn::Gt(hn::Abs(step), hn::Mul(hn::Set(d, kLastStep<D>), l)));
  }
  const Vec<D> log_loss = log(d, hn::Neg(expm1(d, hn::Mul(hn::Set(d, -c.theta), l))));
  const Vec<D> factor = exp(d, hn::Mul(log_loss, hn::Set(d, 1 / c.theta)));
  const Vec<D> y = hn::Neg(hn::Mul(hn::Mul(x, e.exp), factor));
  // Of l: 6 relative, from both sides of the equation, times max(1, theta l) / theta l of log y.
  const Vec<D> of_log = hn::Add(hn::MulAdd(hn::Set(d, 8.0), l, hn::Set(d, 20.0)), hn::Abs(log_loss));
  const Vec<D> error = hn::Mul(of_log, hn::Neg(y));
  const auto found = hn::And(hn::Gt(l, hn::Set(d, Precision<D>::kSmallest)), hn::Not(moving));
  return probability(d, tail, y, hn::Mul(hn::Set(d, Precision<D>::kUnit), error), kInverseTolerance,
                     hn::And(found, hn::And(rows.inside(0), rows.inside(1))));
}

/// The step of Halley's iteration for l, without what the polynomials add to the second derivative.
template <class D>
class LevelTrial {
 public:
  HWY_INLINE LevelTrial(D d, const KernelConstants& c, Index given, const PowerMean<D>& s, Vec<D> target)
      : c_(c), given_(given), s_(s), at_(argument_at(d, c, given, s)), target_(target) {}

  HWY_INLINE Trial<D> operator()(D d, Vec<D> l) const {
    const Level<D> level(d, c_, given_, s_, at_, l, hn::Zero(d));
    const Vec<D> excess = hn::Sub(target_, level.value), twice = hn::Add(level.slope, level.slope);
    const Vec<D> divisor = hn::MulAdd(excess, level.moved, hn::Mul(twice, level.slope));
    const Vec<D> error = hn::MulAdd(hn::Set(d, 1.5), target_, level.error);
    return {hn::Div(hn::Mul(excess, twice), divisor), hn::Div(error, level.slope), level.inside};
  }

 private:
  const KernelConstants& c_;
  Index given_;
  PowerMean<D> s_;
  ScaledArgument<D> at_;
  Vec<D> target_;
};

/// From a point below the root: the polynomials add at most (j-1) l; then y = s e^l (1 - e^(-theta l))^(1/theta).
template <class D>
HWY_INLINE Vec<D> conditional_inverse_rows(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  const Index last = rows.size() - 1;
  const PowerMean<D> s = mean_of_given(d, c, rows);
  const Vec<D> target = hn::Neg(rows.log_of(last));
  const Vec<D> slope = hn::Add(s.value, hn::Set(d, static_cast<double>(last) * c.theta - 1));
  const LevelTrial<D> trial(d, c, last, s, target);
  const Root<D> l = find_root(d, log1p(d, hn::Div(target, slope)), trial);
  const Vec<D> loss = hn::Neg(expm1(d, hn::Mul(hn::Set(d, -c.theta), l.value))), log_loss = log(d, loss);
  const Vec<D> factor = exp(d, hn::Mul(log_loss, hn::Set(d, 1 / c.theta)));
  const Vec<D> y = hn::Neg(hn::Mul(hn::Mul(s.value, exp(d, l.value)), factor));
  const Vec<D> of_steps = hn::NegMulAdd(hn::Set(d, 3.0), log_loss, hn::MulAdd(hn::Set(d, 2.0), l.value, s.error));
  const Vec<D> of_log = hn::Add(hn::Div(l.error, loss), hn::Add(of_steps, hn::Set(d, 12.0)));
  const Vec<D> error = hn::Mul(hn::Mul(of_log, hn::Neg(y)), hn::Set(d, Precision<D>::kUnit));
  return probability(d, tail, y, error, kInverseTolerance, hn::And(hn::And(s.inside, l.found), rows.inside(last)));
}

template <class D>
HWY_INLINE Vec<D> conditional_inverse_row(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
  if constexpr (!Precision<D>::kSingle) {
    if (rows.size() > 2) return conditional_inverse_rows(d, c, tail, rows);
  }
  return conditional_inverse_pair(d, c, tail, rows);
}

struct Formulas {
  static constexpr int kPartsSingle = 4;

  static bool answers_log_pdf(const KernelConstants& c, Index columns) {
    return c.polynomials[static_cast<std::size_t>(columns)].usable();
  }
  static bool answers_conditional(const KernelConstants& c, Index columns) {
    return columns == 2 || c.polynomials[static_cast<std::size_t>(columns) - 1].usable();
  }

  template <class D>
  static HWY_INLINE Vec<D> log_pdf(D d, const KernelConstants& c, const Columns<D>& rows) {
    return log_pdf_row(d, c, rows);
  }
  template <class D>
  static HWY_INLINE Vec<D> conditional(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
    return conditional_row(d, c, tail, rows);
  }
  template <class D>
  static HWY_INLINE Vec<D> conditional_inverse(D d, const KernelConstants& c, Tail tail, const Columns<D>& rows) {
    return conditional_inverse_row(d, c, tail, rows);
  }
};

const KernelTable<KernelConstants>* table() {
  return table_of<Formulas, KernelConstants>();
}

}  // namespace sklar::families::gumbel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sklar::families::gumbel {

HWY_EXPORT(table);

std::shared_ptr<const Kernels> kernels(double theta, std::vector<Coefficients> polynomials) {
  if (!(theta < 1e6)) return nullptr;
  return make_kernels(KernelConstants(theta, std::move(polynomials)), *HWY_DYNAMIC_DISPATCH(table)());
}

}  // namespace sklar::families::gumbel
#endif
