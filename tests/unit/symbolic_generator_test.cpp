/// Copulas whose generator is a formula, against 400 digits.

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <sstream>
#include <thread>

#include "copula/archimedean.hpp"
#include "copula/symbolic/derivative.hpp"
#include "copula/symbolic/formula_dependence.hpp"
#include "copula/symbolic/generator_check.hpp"
#include "copula/symbolic/parser.hpp"
#include "tests/unit/symbolic_generators.hpp"

namespace sklar::symbolic {
namespace {

using Huge =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<400>, boost::multiprecision::et_off>;
using FormulaPtr = std::shared_ptr<const GeneratorFormula>;

const std::vector<std::string> kParameters{"theta", "delta"};
constexpr double kDelta = 1.25;

FormulaPtr formula(const std::string& psi, const std::string& inverse = "") {
  const auto given = inverse.empty() ? std::nullopt : std::optional(parse(inverse));
  return std::make_shared<const GeneratorFormula>(parse(psi), given, kParameters);
}

/// psi and its derivatives as they stand, in 400 digits; t by Newton's method.
class Reference {
 public:
  Reference(const std::string& psi, double theta) : theta_(theta), derivatives_(parse(psi), symbol("t")) {}

  Huge derivative(int order, const Huge& t) {
    while (tapes_.size() <= static_cast<std::size_t>(order)) {
      const std::vector<Expression> outputs{derivatives_(static_cast<int>(tapes_.size()))};
      tapes_.push_back(std::make_unique<Tape>(outputs, std::vector<std::string>{"t", "theta", "delta"}));
    }
    TapeEvaluator<Huge, 1> run(*tapes_[static_cast<std::size_t>(order)]);
    std::vector<Huge> out(1);
    run(std::vector<Huge>{t, theta_, kDelta}, out);
    return out[0];
  }

  /// Whether psi^-1(u) is in the range that inverse searches.
  bool reaches(double u) { return !(derivative(0, exp(Huge(kLargestLogT))) > u); }

  /// To 200 digits: bisection in log t, then Newton's method.
  Huge inverse(double u) {
    Huge low = -kLargestLogT, high = kLargestLogT;
    for (int step = 0; step < 70; ++step) {
      const Huge middle = (low + high) / 2;
      (derivative(0, exp(middle)) > u ? low : high) = middle;
    }
    Huge t = exp(low);
    for (int step = 0; step < 6; ++step) t -= (derivative(0, t) - u) / derivative(1, t);
    EXPECT_LT(abs(derivative(0, t) - u), 1e-200 * (1 - Huge(u)) * u) << u;
    return t;
  }

 private:
  static constexpr double kLargestLogT = 1e5;

  Huge theta_;
  Derivatives derivatives_;
  std::vector<std::unique_ptr<Tape>> tapes_;
};

struct Case {
  std::string psi;
  double theta;
  int dim;

  [[nodiscard]] std::string name() const {
    return psi + " theta = " + std::to_string(theta) + " d = " + std::to_string(dim);
  }
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto& generator : test::generators()) {
    for (const double share : {1e-3, 0.5}) {
      for (const int dim : {2, 3, 5}) {
        all.push_back({generator.psi, generator.low + share * (generator.high - generator.low), dim});
      }
    }
  }
  all.push_back({"exp(-t)*(1+theta*t)^(-1/theta)", 0.5, 3});  // no closed inverse
  all.push_back({"(1+theta*t)^(-1/theta)", -0.19, 5});        // bounded support
  return all;
}

Points hard_points(int dim, std::mt19937_64& rng) {
  constexpr std::array kHard{1e-100, 1e-12, 1e-3, 0.5, 1 - 1e-9, 1 - 1e-14};
  Points u(7, dim);
  for (Index i = 0; i < u.size(); ++i) {
    u(i) = rng() % 3 == 0 ? kHard[rng() % kHard.size()] : std::generate_canonical<double, 53>(rng);
  }
  u.row(0) = 1e-100;
  u.row(1) = 1 - 1e-14;
  return u;
}

/// All quantities of one point against the reference.
class PointCheck {
 public:
  PointCheck(const Copula& copula, Reference& reference, const Points& u)
      : copula_(copula), reference_(reference), u_(u), last_(u.cols() - 1), dim_(copula.dim()) {
    for (Index k = 0; k < u.cols(); ++k) t_.push_back(reference.inverse(u(k)));
    for (Index k = 0; k < last_; ++k) before_ += t_[static_cast<std::size_t>(k)];
  }

  void density() {
    Huge c = abs(reference_.derivative(dim_, before_ + t_.back()));
    for (const Huge& t : t_) c /= abs(reference_.derivative(1, t));
    const auto exact = static_cast<double>(log(c));
    EXPECT_NEAR(copula_.log_pdf(u_)(0), exact, 1e-13 * std::max(1.0, std::abs(exact)));
  }

  void conditional() {
    const Huge h = conditional_at(t_.back());
    EXPECT_LT(abs(copula_.h(u_)(0) - h), 1e-13 * h + kSubnormal);
    EXPECT_LT(abs(copula_.h_upper(u_)(0) - (1 - h)), 1e-13 * (1 - h) + kSubnormal);
  }

  /// h at the inverse times 1 +- 1e-12 is on either side of p.
  void inverse(double p) {
    Points at = u_;
    at(last_) = p;
    const double v = copula_.h_inv(at)(0);
    if (v < 1e-290 || v > 1 - 1e-3) return;  // subnormal, or coarser than the step
    const auto h = [&](double value) { return conditional_at(reference_.inverse(value)); };
    EXPECT_LE(h(v * (1 - 1e-12)), p) << v;
    EXPECT_GE(h(v * (1 + 1e-12)), p) << v;
  }

 private:
  static constexpr double kSubnormal = 5e-324;

  Huge conditional_at(const Huge& t) {
    return reference_.derivative(dim_ - 1, before_ + t) / reference_.derivative(dim_ - 1, before_);
  }

  const Copula& copula_;
  Reference& reference_;
  const Points& u_;
  Index last_;
  int dim_;
  std::vector<Huge> t_;
  Huge before_ = 0;
};

TEST(SymbolicGenerator, AgreesWith400Digits) {
  std::mt19937_64 rng(11);
  for (const Case& next : cases()) {
    SCOPED_TRACE(next.name());
    const SymbolicGenerator generator(formula(next.psi), next.dim, {next.theta, kDelta}, "F");
    require_generator(generator, next.dim, "test");
    const Archimedean<SymbolicGenerator> copula(next.dim, generator);
    Reference reference(next.psi, next.theta);
    const Points points = hard_points(next.dim, rng);
    for (Index row = 0; row < points.rows(); ++row) {
      const Points u = points.row(row);
      if (!(copula.log_cdf(u)(0) > -std::numeric_limits<double>::infinity())) continue;  // beyond the support
      if (!reference.reaches(u.minCoeff())) continue;
      SCOPED_TRACE((std::ostringstream() << "u = " << u).str());
      PointCheck check(copula, reference, u);
      check.density();
      check.conditional();
      check.inverse(std::generate_canonical<double, 53>(rng));
    }
  }
}

TEST(SymbolicGenerator, ASupportWithAnEndIsFoundInTheFormula) {
  const double theta = -0.25;  // psi = (1 - t/4)_+^4
  const SymbolicGenerator generator(formula("(1+theta*t)^(-1/theta)"), 3, {theta, kDelta}, "F");
  EXPECT_EQ(generator.log_psi(Narrow(5.0)).value, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(generator.log_abs_dpsi(2, Narrow(5.0)).value, -std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(generator.log_psi(Narrow(2.0)).value, 4 * std::log(0.5));
  const Archimedean<SymbolicGenerator> copula(3, generator);
  EXPECT_EQ(copula.cdf(Points::Constant(1, 3, 0.01))(0), 0);
  EXPECT_EQ(copula.pdf(Points::Constant(1, 3, 0.01))(0), 0);
}

TEST(SymbolicGenerator, TakesAGivenInverse) {
  const SymbolicGenerator derived(formula("1/(1+t^(1/theta))"), 2, {2.0, kDelta}, "F");
  const SymbolicGenerator given(formula("1/(1+t^(1/theta))", "(1/u-1)^theta"), 2, {2.0, kDelta}, "F");
  for (const double u : {1e-100, 0.25, 0.75, 1 - 1e-14}) {
    const Narrow a = derived.psi_inv(Narrow(u)), b = given.psi_inv(Narrow(u));
    EXPECT_NEAR(a.value, b.value, a.error + b.error) << u;
    EXPECT_LT(b.error, 1e-14 * b.value) << u;
  }
}

template <class Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const std::domain_error& error) {
    return error.what();
  }
  return "no error";
}

TEST(SymbolicGenerator, RefusesAnInverseThatIsNone) {
  EXPECT_EQ(message_of([] {
              SymbolicGenerator(formula("exp(-theta*t)", "-log(u)"), 2, {2.0, kDelta}, "F");
            }),
            "F: psi_inverse is not the inverse of psi: psi(psi_inverse(0.5)) = 0.25");
}

std::string verdict(const std::string& psi, int dim, double theta) {
  const SymbolicGenerator generator(formula(psi), dim, {theta, kDelta}, "F");
  return message_of([&] { require_generator(generator, dim, "F"); });
}

TEST(RequireGenerator, PassesGenerators) {
  for (const Case& next : cases()) EXPECT_EQ(verdict(next.psi, next.dim, next.theta), "no error") << next.name();
}

TEST(RequireGenerator, NamesWhatIsViolated) {
  EXPECT_EQ(verdict("exp(-t)/2", 2, 1), "F: psi is no generator in dimension 2: psi(0) must be 1, found 0.5");
  EXPECT_EQ(verdict("(1+exp(-t))/2", 2, 1),
            "F: psi is no generator in dimension 2: psi(t) must tend to 0 as t grows, found psi(1e300) = 0.5");
  const std::string oscillates = verdict("cos(t)*exp(-t)", 2, 1);
  EXPECT_NE(oscillates.find("must not be negative, found psi^("), std::string::npos) << oscillates;
  EXPECT_TRUE(verdict("exp(-t^2)", 2, 1)
                  .starts_with(
                      "F: psi is no generator in dimension 2: (-1)^2 psi^(2)(t) must not be negative, found psi^(2)("));
}

// (1 + theta t)^(-1/theta) with theta < 0 is d-monotone for theta >= -1/(d-1) only.
TEST(RequireGenerator, DependsOnTheDimension) {
  EXPECT_EQ(verdict("(1+theta*t)^(-1/theta)", 3, -0.45), "no error");
  EXPECT_TRUE(verdict("(1+theta*t)^(-1/theta)", 4, -0.45)
                  .starts_with("F: psi is no generator in dimension 4: (-1)^4 psi^(4)(t) must not be negative"));
  // Of -log(1-(1-exp(-theta))exp(-t))/theta the least theta is -0.0962 in d = 5; only the last derivative shows it.
  EXPECT_EQ(verdict(test::generators()[1].psi, 5, -0.096), "no error");
  EXPECT_NE(verdict(test::generators()[1].psi, 5, -0.12).find("psi^(5)"), std::string::npos);
}

TEST(SymbolicGenerator, IsSharedByThreads) {
  const SymbolicGenerator generator(formula("exp((1-sqrt(1+2*theta^2*t))/theta)"), 3, {2.0, kDelta}, "F");
  const Archimedean<SymbolicGenerator> copula(3, generator);
  const Points u = Points::Constant(200, 3, 1 - 1e-14);
  const double expected = copula.log_pdf(u.topRows(1))(0);
  std::array<Column, 4> results;
  std::vector<std::thread> threads;
  threads.reserve(results.size());
  for (Column& result : results) threads.emplace_back([&] { result = copula.log_pdf(u); });
  for (std::thread& thread : threads) thread.join();
  for (const Column& result : results) EXPECT_TRUE((result == expected).all());
}

// psi bends so sharply that the integral takes more nodes than its rule begins with. tau = 1 - 4 int t psi'(t)^2 dt.
TEST(SymbolicGenerator, KendallTauIsRightOnManyThreads) {
  constexpr double kTheta = 300, kTauError = 1e-10;
  const SymbolicGenerator generator(formula("(exp(-t)+exp(-theta*t))/2"), 2, {kTheta, kDelta}, "F");
  std::array<double, 4> results{};
  std::vector<std::thread> threads;
  threads.reserve(results.size());
  for (double& result : results) threads.emplace_back([&] { result = kendall_tau(generator); });
  for (std::thread& thread : threads) thread.join();
  const double expected = 0.5 - 2 * kTheta / ((1 + kTheta) * (1 + kTheta));
  for (const double result : results) EXPECT_NEAR(result, expected, kTauError);
}

}  // namespace
}  // namespace sklar::symbolic
