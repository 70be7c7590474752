// The vector kernels of every instruction set of this machine, through the public calls, against many digits.

#include <gtest/gtest.h>

#include "copula/archimedean_copula.hpp"
#include "copula/study/tradeoff.hpp"
#include "copula/tolerance.hpp"
#include "families/amh.hpp"
#include "families/clayton.hpp"
#include "families/frank.hpp"
#include "families/gumbel.hpp"
#include "families/joe.hpp"
#include "families/registry.hpp"
#include "tests/support/family_cases.hpp"
#include "tests/support/instruction_sets.hpp"

namespace sklar::test {
namespace {

constexpr int kDigits = 30;

struct Case {
  Column (Copula::*evaluate)(const PointsRef&, Accuracy) const;
  double tolerance;
  Quantity quantity;
  bool relative;  ///< else absolute below 1
};

constexpr Case kCases[] = {{&Copula::log_pdf, kLogTolerance, Quantity::log_pdf, false},
                           {&Copula::h, kHTolerance, Quantity::h, true},
                           {&Copula::h_upper, kHTolerance, Quantity::h_upper, true},
                           {&Copula::h_inv, kInverseTolerance, Quantity::h_inv, true},
                           {&Copula::h_inv_upper, kInverseTolerance, Quantity::h_inv_upper, true}};

/// Points of the copula, of the cube, and towards its faces.
Points points_for(const Copula& copula, Index each) {
  Rng rng(7);
  const int dim = copula.dim();
  Points u(3 * each, dim);
  u.topRows(each) = copula.sample(each, rng);
  u.bottomRows(2 * each) = uniforms(rng, 2 * each, dim);
  for (Index i = 2 * each; i < 3 * each; ++i) {
    for (int k = 0; k < dim; ++k) {
      const double distance = std::exp(-30 * uniform(rng));
      u(i, k) = uniform(rng) < 0.5 ? distance : 1 - distance;
    }
  }
  return u;
}

void expect_within(const Case& c, double tolerance, const Column& values, const std::vector<BigFloat>& exact,
                   const Points& u) {
  const WorkingPrecision precision(kDigits + 10);
  for (Index i = 0; i < u.rows(); ++i) {
    const BigFloat& expected = exact[static_cast<std::size_t>(i)];
    if (const auto rounded = static_cast<double>(expected); std::isinf(rounded)) {
      ASSERT_EQ(values(i), rounded) << "quantity " << static_cast<int>(c.quantity) << " at " << u.row(i);
      continue;
    }
    const BigFloat size = abs(expected), scale = c.relative || size > 1 ? size : BigFloat(1);
    if (static_cast<double>(size) < std::numeric_limits<double>::min()) continue;  // rounded to a subnormal number
    const auto error = static_cast<double>(abs(BigFloat(values(i)) - expected) / scale);
    ASSERT_LE(error, 1.01 * tolerance + 0x1p-53) << "quantity " << static_cast<int>(c.quantity) << " at " << u.row(i);
  }
}

void expect_every_target_within(const FamilyInfo& family, int dim, const Theta& theta) {
  const FamilyCase family_case{&family, dim, theta};
  SCOPED_TRACE(family_case.name());
  const auto judge = std::dynamic_pointer_cast<const ArchimedeanCopula>(family.make(dim, theta));
  if (judge == nullptr) return;  // independence
  const Points u = points_for(*judge, dim == 2 ? 200 : 20);
  for (const Case& c : kCases) {
    const std::vector<BigFloat> exact = judge->exact(c.quantity, u, kDigits);
    for_each_target([&] {
      const CopulaPtr copula = family.make(dim, theta);
      expect_within(c, c.tolerance, (*copula.*c.evaluate)(u, Accuracy::standard), exact, u);
      expect_within(c, kFastTolerance, (*copula.*c.evaluate)(u, Accuracy::fast), exact, u);
    });
    if (testing::Test::HasFatalFailure()) return;
  }
}

class Kernels : public testing::TestWithParam<FamilyInfo> {};

/// The parameters of the examples and of weak to strong dependence between them.
std::vector<Theta> many_thetas(const FamilyInfo& family) {
  std::vector<Theta> thetas = family.examples;
  for (const double tau : {0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.85, 0.95}) {
    if (family.theta_from_tau && family.tau_range(2).contains(tau)) thetas.push_back(family.from_tau(2, tau));
  }
  return thetas;
}

TEST_P(Kernels, AnswerWithinTheTolerance) {
  for (const int dim : {2, 3, 5, 30}) {
    for (const Theta& theta : many_thetas(GetParam())) {
      if (GetParam().admits(dim, theta)) expect_every_target_within(GetParam(), dim, theta);
      if (HasFatalFailure()) return;
    }
  }
}

using MakeKernels = std::shared_ptr<const sklar::Kernels> (*)(int dim, const Theta& theta);

template <auto kGenerator>
std::shared_ptr<const sklar::Kernels> kernels_of(int dim, const Theta& theta) {
  return kGenerator(dim, theta).kernels(dim);
}

/// At most this share of rows of many coordinates is left to the exact route.
constexpr double kMostLeft = 0.02;

void expect_few_left(const std::string& name, MakeKernels make, int dim) {
  const FamilyInfo& family = families::find(name);
  const Theta theta = medium_theta(family, dim);
  Rng rng(3);
  const Points u = family.make(dim, theta)->sample_by(Route::frailty, 2000, rng);
  const auto kernels = make(dim, theta);
  const auto left = [&](auto evaluate) {
    Column values = Column::Constant(u.rows(), std::numeric_limits<double>::quiet_NaN());
    evaluate(Rows(u), values.data());
    return static_cast<double>(values.isNaN().count()) / static_cast<double>(u.rows());
  };
  constexpr Accuracy kStandard = Accuracy::standard;
  SCOPED_TRACE(name + ", d = " + std::to_string(dim));
  EXPECT_LE(left([&](const Rows& rows, double* out) { kernels->log_pdf(kStandard, rows, out); }), kMostLeft);
  for (const Tail tail : {Tail::lower, Tail::upper}) {
    EXPECT_LE(left([&](const Rows& rows, double* out) { kernels->conditional(kStandard, rows, tail, out); }),
              kMostLeft);
    EXPECT_LE(left([&](const Rows& rows, double* out) { kernels->conditional_inverse(kStandard, rows, tail, out); }),
              kMostLeft);
  }
}

TEST(KernelsOfManyDimensions, AnswerMostRows) {
  for (const int dim : {3, 5, 10}) {
    expect_few_left("frank", kernels_of<families::frank::generator>, dim);
    expect_few_left("clayton", kernels_of<families::clayton::generator>, dim);
    expect_few_left("gumbel", kernels_of<families::gumbel::generator>, dim);
    expect_few_left("joe", kernels_of<families::joe::generator>, dim);
    expect_few_left("amh", kernels_of<families::amh::generator>, dim);
  }
  for (const int dim : {20, 50, 100}) expect_few_left("amh", kernels_of<families::amh::generator>, dim);
}

TEST(JoeKernels, AnswerWithinTheToleranceNearIndependence) {
  expect_every_target_within(families::find("joe"), 2, {1.0001});
}

// Single precision counts roundings at half their worst: its bound holds by this test, on many points.
TEST_P(Kernels, FastIsWithinItsBoundOfStandard) {
  if (GetParam().parameters.empty()) return;
  for (const Theta& theta : many_thetas(GetParam())) {
    const CopulaPtr judge = GetParam().make(2, theta);
    const Points u = points_for(*judge, 10'000);
    for (const Case& c : kCases) {
      const Column expected = (*judge.*c.evaluate)(u, Accuracy::standard);
      for_each_target([&] {
        const Column values = (*GetParam().make(2, theta).*c.evaluate)(u, Accuracy::fast);
        Column scale = expected.abs();
        if (!c.relative) scale = scale.max(1);
        const Column errors = (values == expected).select(0, (values - expected).abs() / scale);
        Index worst;
        ASSERT_LE(errors.maxCoeff(&worst), kFastTolerance) << GetParam().name << " " << theta[0] << ", quantity "
                                                           << static_cast<int>(c.quantity) << " at " << u.row(worst);
      });
      if (HasFatalFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Family, Kernels, testing::ValuesIn(families::all()),
                         [](const auto& family) { return family.param.name; });

}  // namespace
}  // namespace sklar::test
