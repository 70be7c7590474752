#include <gtest/gtest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <cstdio>
#include <functional>
#include <random>

#include "copula/symbolic/derivative.hpp"
#include "copula/symbolic/derive.hpp"
#include "copula/symbolic/evaluate.hpp"
#include "copula/symbolic/log_form.hpp"
#include "copula/symbolic/parser.hpp"
#include "copula/symbolic/print.hpp"
#include "copula/symbolic/tape_evaluator.hpp"
#include "tests/unit/symbolic_generators.hpp"

namespace sklar::symbolic {
namespace {

using test::generators;
using test::random_expression;

template <unsigned Digits>
using Float =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<Digits>, boost::multiprecision::et_off>;
using Big = Float<160>;
using Huge = Float<700>;

const std::vector<std::string> kInputs{"t", "theta", "delta"};
constexpr double kDelta = 1.25;

template <class Real>
Real value_at(const Tape& tape, const Real& t, const Real& theta) {
  TapeEvaluator<Real, 1> run(tape);
  const std::vector<Real> in{t, theta, Real(kDelta)};
  std::vector<Real> out(1);
  run(in, out);
  return out[0];
}

template <class Real>
Real value_at(const Expression& e, const Real& t, const Real& theta) {
  return value_at(Tape({e}, kInputs), t, theta);
}

double log_uniform(std::mt19937_64& rng, double low, double high) {
  return low * std::pow(high / low, std::generate_canonical<double, 53>(rng));
}

/// The generators written out once more, for the compiler instead of the parser.
Huge psi_by_hand(const std::string& name, const Huge& t, const Huge& theta) {
  if (name == "independence") return exp(-t);
  if (name == "frank") return -log(1 - (1 - exp(-theta)) * exp(-t)) / theta;
  if (name == "clayton") return pow(1 + theta * t, -1 / theta);
  if (name == "gumbel") return exp(-pow(t, 1 / theta));
  if (name == "joe") return 1 - pow(1 - exp(-t), 1 / theta);
  if (name == "ali-mikhail-haq") return (1 - theta) / (exp(t) - theta);
  if (name == "inverse gaussian") return exp((1 - sqrt(1 + 2 * theta * theta * t)) / theta);
  if (name == "bb1") return pow(1 + pow(t, 1 / Huge(kDelta)), -1 / theta);
  if (name == "nelsen 4.2.12") return 1 / (1 + pow(t, 1 / theta));
  if (name == "nelsen 4.2.19") return theta / log(t + exp(theta));
  throw std::invalid_argument(name);
}

/// The order-th central difference quotient, error O(step^2).
Huge difference_quotient(const std::function<Huge(const Huge&)>& f, const Huge& at, const Huge& step, int order) {
  Huge total = 0;
  Huge binomial = 1;
  for (int j = 0; j <= order; ++j) {
    total += (j % 2 == 0 ? binomial : Huge(-binomial)) * f(at + (Huge(order) / 2 - j) * step);
    binomial = binomial * (order - j) / (j + 1);
  }
  return total / pow(step, order);
}

TEST(SymbolicDerivative, AgreesWithDifferencesIn700Digits) {
  // Step 1e-50: the quotient's error is about 1e-100, its rounding 1e-700 / 1e-500.
  constexpr double kRelativeTolerance = 1e-80;
  std::mt19937_64 rng(7);
  for (const auto& generator : generators()) {
    Derivatives d(parse(generator.psi), symbol("t"));
    for (const int order : {1, 2, 3, 4, 5, 6, 8, 10}) {
      const Huge t = log_uniform(rng, 0.1, 10);
      const Huge theta = generator.low + 0.3 * (generator.high - generator.low);
      const Huge value = value_at(d(order), t, theta);
      const Huge quotient = difference_quotient([&](const Huge& x) { return psi_by_hand(generator.name, x, theta); }, t,
                                                Huge("1e-50"), order);
      EXPECT_LT(abs(value / quotient - 1), kRelativeTolerance) << generator.name << " order " << order;
    }
  }
}

TEST(SymbolicDerivative, OfRandomFormulasAgreesWithDifferences) {
  constexpr double kTolerance = 1e-60;  // of the larger of 1 and the value; steep formulas lose digits of the 1e-100
  std::mt19937_64 rng(8);
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    const Expression f = random_expression(rng, 4);
    const Huge theta = Huge(3) / 7;
    const Huge t = log_uniform(rng, 0.2, 3);
    const auto at = [&](const Huge& x) { return value_at(f, x, theta); };
    if (!isfinite(at(t)) || abs(at(t)) > 1e6) continue;
    for (const int order : {1, 2, 3}) {
      const Expression derived = derivative(f, symbol("t"), order);
      const Huge value = value_at(derived, t, theta);
      const Huge quotient = difference_quotient(at, t, Huge("1e-50"), order);
      if (!isfinite(quotient) || !isfinite(value) || abs(value) > 1e6) continue;
      EXPECT_LT(abs(value - quotient), kTolerance * (1 + abs(value))) << to_text(f) << " order " << order;
      ++compared;
    }
  }
  EXPECT_GT(compared, 300);
}

// The sensitivity of a log density to its parameter, as fits need it.
TEST(SymbolicDerivative, OfALogFormByTheParameter) {
  constexpr double kRelativeTolerance = 1e-80;
  for (const auto& generator : generators()) {
    if (generator.name == std::string("independence")) continue;
    const Expression log_abs = log_form(derivative(parse(generator.psi), symbol("t"), 3)).log_abs;
    const Huge t = 0.75;
    const Huge theta = generator.low + 0.3 * (generator.high - generator.low);
    const Huge value = value_at(derivative(log_abs, symbol("theta")), t, theta);
    const Huge quotient =
        difference_quotient([&](const Huge& x) { return value_at(log_abs, t, x); }, theta, Huge("1e-50"), 1);
    EXPECT_LT(abs(value / quotient - 1), kRelativeTolerance) << generator.name;
  }
}

/// Where the bound of a double value is finite, the value in 160 digits lies within.
void expect_bounded(const Tape& tape, double t, double theta, int& checked) {
  const Bounded<double> bounded = value_at<Bounded<double>>(tape, t, theta);
  if (!std::isfinite(bounded.value) || !std::isfinite(bounded.error)) return;
  const Bounded<Big> exact = value_at<Bounded<Big>>(tape, Bounded<Big>(t), Bounded<Big>(theta));
  if (!isfinite(exact.value) || !(exact.error <= Big(1e-6) * bounded.error)) return;
  const Big off = abs(exact.value - bounded.value);
  EXPECT_LE(off, bounded.error + exact.error) << "at t = " << t << ", theta = " << theta;
  ++checked;
}

TEST(SymbolicBound, HoldsForDerivatives) {
  std::mt19937_64 rng(9);
  int checked = 0;
  for (const auto& generator : generators()) {
    Derivatives d(parse(generator.psi), symbol("t"));
    for (const int order : {0, 1, 2, 5, 9}) {
      SCOPED_TRACE(to_text(d(order)));
      const Tape derived({d(order)}, kInputs), log_abs({log_form(d(order)).log_abs}, kInputs);
      for (int i = 0; i < 20; ++i) {
        const double t = log_uniform(rng, 1e-12, 600);
        const double theta = generator.low + (generator.high - generator.low) * log_uniform(rng, 1e-3, 1);
        expect_bounded(derived, t, theta, checked);
        expect_bounded(log_abs, t, theta, checked);
      }
    }
  }
  EXPECT_GT(checked, 1500);
}

TEST(SymbolicBound, HoldsForRandomFormulas) {
  std::mt19937_64 rng(10);
  int checked = 0;
  for (int i = 0; i < 3000; ++i) {
    const Expression e = random_expression(rng, 6);
    SCOPED_TRACE(to_text(e));
    expect_bounded(Tape({e}, kInputs), log_uniform(rng, 1e-9, 1e3), log_uniform(rng, 1e-3, 30), checked);
  }
  EXPECT_GT(checked, 800);
}

TEST(SymbolicEvaluation, IsRightAndReportsPromotion) {
  std::mt19937_64 rng(11);
  const EvaluationOptions options;
  std::printf("share of rows promoted beyond double, orders 0, 1, 2, 5, 10 (t in [1e-12, 600])\n");
  for (const auto& generator : generators()) {
    Derivatives d(parse(generator.psi), symbol("t"));
    std::string line;
    for (const int order : {0, 1, 2, 5, 10}) {
      const Tape tape({d(order)}, kInputs);
      Points in(400, 3);
      for (Index i = 0; i < in.rows(); ++i) {
        in(i, 0) = log_uniform(rng, 1e-12, 600);
        in(i, 1) = generator.low + (generator.high - generator.low) * log_uniform(rng, 1e-3, 1);
        in(i, 2) = kDelta;
      }
      const Evaluation result = evaluate(tape, in, options);
      for (Index i = 0; i < in.rows(); i += 20) {
        const Huge exact = value_at<Huge>(d(order), in(i, 0), in(i, 1));
        const double rounding = std::max(1e-300, std::abs(result.values(i, 0))) * 0x1p-53;
        EXPECT_LE(abs(exact - result.values(i, 0)), options.tolerance * abs(exact) + rounding)
            << generator.name << " order " << order << " t = " << in(i, 0) << " theta = " << in(i, 1);
      }
      char text[64];
      std::snprintf(text, sizeof text, " %6.2f%% (%d digits)", 100.0 * double(result.promoted) / double(in.rows()),
                    result.most_digits);
      line += text;
    }
    std::printf("%-18s%s\n", generator.name, line.c_str());
  }
}

Points one_row(double t, double theta) {
  Points in(1, 2);
  in << t, theta;
  return in;
}

TEST(SymbolicEvaluation, GoesToAsManyDigitsAsCancellationTakes) {
  const Tape tape({parse("exp(t) - 1 - t - t^2/2")}, {"t", "theta"});
  const Evaluation result = evaluate(tape, one_row(1e-60, 0));
  EXPECT_DOUBLE_EQ(result.values(0, 0), 1e-180 / 6);
  EXPECT_EQ(result.promoted, 1);
  EXPECT_EQ(result.most_digits, 200);
}

TEST(SymbolicEvaluation, RefusesWhatItCannotResolve) {
  const auto message = [](const char* formula, double t) -> std::string {
    try {
      (void)evaluate(Tape({parse(formula)}, {"t", "theta"}), one_row(t, 2), {.max_digits = 400});
    } catch (const std::domain_error& error) {
      return error.what();
    }
    return "no exception";
  };
  EXPECT_EQ(message("sin(t)^2 + cos(t)^2 - 1", 0.5), "value not resolved with 400 digits at t = 0.5, theta = 2");
  EXPECT_EQ(message("log(-t)", 0.5), "value not defined or not finite at t = 0.5, theta = 2");
  EXPECT_EQ(message("1/(t - theta)", 2), "value not defined or not finite at t = 2, theta = 2");
}

TEST(SymbolicEvaluation, RowsDoNotInfluenceEachOther) {
  const Tape tape({derivative(parse("1-(1-exp(-t))^(1/theta)"), symbol("t"), 3)}, {"t", "theta"});
  Points in(50, 2);
  for (Index i = 0; i < in.rows(); ++i) in.row(i) << std::pow(10.0, double(i - 25) / 4), 1 + 1e-9 * double(i * i);
  in(7, 0) = std::numeric_limits<double>::quiet_NaN();
  const Points together = evaluate(tape, in).values;
  for (Index i = 0; i < in.rows(); ++i) {
    const double alone = evaluate(tape, in.row(i)).values(0, 0);
    EXPECT_TRUE(alone == together(i, 0) || (i == 7 && std::isnan(alone) && std::isnan(together(i, 0)))) << i;
  }
}

// exp(-t^(1/theta)) at t = 1e300 and 1e-300: the log form stays in double where the derivative itself does not.
TEST(SymbolicLogForm, ReachesBeyondTheRangeOfDouble) {
  constexpr double kRelativeTolerance = 1e-13;
  const LogForm form = log_form(derivative(parse("exp(-t^(1/theta))"), symbol("t"), 2));
  const Tape tape({form.log_abs}, {"t", "theta"});
  const EvaluationOptions options{.floor = 1};
  for (const double t : {1e-300, 1e-30, 1.0, 1e30, 1e300}) {
    const double theta = 1.5;
    const Huge a = Huge(1) / theta;
    const Huge s = pow(Huge(t), a);
    const Huge expected = -s + log(a) + (a - 2) * log(Huge(t)) + log(a * s + (1 - a));
    const Evaluation result = evaluate(tape, one_row(t, theta), options);
    EXPECT_LT(abs(result.values(0, 0) / expected - 1), kRelativeTolerance) << t;
    EXPECT_EQ(result.promoted, 0) << t;
  }
}

TEST(SymbolicLogForm, CommonFactorsMultiplyBack) {
  for (const auto& generator : generators()) {
    Derivatives d(parse(generator.psi), symbol("t"));
    for (int order = 1; order <= 6; ++order) {
      const Factored factored = factor_common(d(order));
      const Expression text = parse(derive(generator.psi, order, Language::text));
      const Big t = 0.7;
      const Big theta = generator.low + 0.3 * (generator.high - generator.low);
      const Big exact = value_at(d(order), t, theta);
      EXPECT_LT(abs(value_at(factored.common * factored.rest, t, theta) / exact - 1), 1e-140) << generator.name;
      EXPECT_LT(abs(value_at(text, t, theta) / exact - 1), 1e-140) << generator.name;
    }
  }
}

TEST(SymbolicLogForm, SignFactorsGiveTheSign) {
  std::mt19937_64 rng(12);
  for (const auto& generator : generators()) {
    Derivatives d(parse(generator.psi), symbol("t"));
    for (int order = 0; order <= 6; ++order) {
      const LogForm form = log_form(d(order));
      const Big t = log_uniform(rng, 0.01, 10);
      const Big theta = generator.low + 0.3 * (generator.high - generator.low);
      Big product = exp(value_at(form.log_abs, t, theta));
      for (const Expression& factor : form.sign_factors) {
        const Big value = value_at(factor, t, theta);
        product *= value / abs(value);
      }
      EXPECT_LT(abs(product / value_at(d(order), t, theta) - 1), 1e-90) << generator.name << " order " << order;
    }
  }
}

TEST(SymbolicFunctions, SpecialValuesInDoubleAndManyDigits) {
  using namespace boost::math::constants;
  const auto check = [](const char* formula, const Huge& exact) {
    const Bounded<double> in_double = value_at<Bounded<double>>(parse(formula), 1, 1);
    EXPECT_LE(abs(exact - in_double.value), Huge(in_double.error)) << formula;
    EXPECT_LT(in_double.error, 1e-11 * (1 + std::abs(in_double.value))) << formula;
    EXPECT_LT(abs(value_at<Huge>(parse(formula), 1, 1) - exact), Huge("1e-680") * (1 + abs(exact))) << formula;
  };
  check("gamma(1/2)", sqrt(pi<Huge>()));
  check("lgamma(7/2)", log(15 * sqrt(pi<Huge>()) / 8));
  check("digamma(1)", -euler<Huge>());
  check("polygamma(1, 1)", pi<Huge>() * pi<Huge>() / 6);
  check("polygamma(3, 1/2)", pow(pi<Huge>(), 4));
  check("pi", pi<Huge>());
  for (const char* x : {"-0.3678794", "-0.2", "1e-30", "0.5", "1", "3", "1e10", "1e300"}) {
    const std::string w = "lambertw(" + std::string(x) + ")";
    const Huge value = value_at<Huge>(parse(w), 1, 1);
    EXPECT_LT(abs(value * exp(value) / value_at<Huge>(parse(x), 1, 1) - 1), Huge("1e-690")) << x;
    EXPECT_GE(value, -1) << x;
    const Bounded<double> in_double = value_at<Bounded<double>>(parse(w), 1, 1);
    EXPECT_LE(abs(value - in_double.value), Huge(in_double.error)) << x;
  }
}

}  // namespace
}  // namespace sklar::symbolic
