#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "brdf/geometry/frame.hpp"
#include "brdf/model/model_binary.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/model/refined_fit.hpp"
#include "brdf/model/spline.hpp"
#include "copula/random.hpp"
#include "tests/support/message.hpp"
#include "tests/support/refined_cases.hpp"

namespace sklar::brdf {
namespace {

using test::builtin_table;
using test::kSinglePrecision;
using test::small_structure;

/// Directions all over the hemisphere, none of them twice.
std::vector<std::pair<Vec3, Vec3>> pairs() {
  Rng rng(3);
  std::vector<std::pair<Vec3, Vec3>> result;
  const auto direction = [&] {
    const double cosine = uniform(rng);
    return spherical_direction(std::acos(cosine), 2 * std::numbers::pi * uniform(rng));
  };
  for (int n = 0; n < 300; ++n) {
    const Vec3 wo = direction();
    result.emplace_back(wo, direction());
  }
  return result;
}

/// eval is the value in double to single precision, and the same to the last bit from both kinds of files.
void expect_the_same_in_kernel_and_files(const std::shared_ptr<const RefinedBrdf>& brdf) {
  const StoredBrdf stored{.material = "part", .provenance = Provenance::synthetic, .model = brdf};
  const BrdfPtr from_json = parse_brdf(to_json(stored), "json").brdf();
  const BrdfPtr from_binary = parse_binary(to_binary(stored), "binary").brdf();
  for (const auto& [wo, wi] : pairs()) {
    const Rgb value = brdf->eval(wo, wi), exact = brdf->at(coordinates(brdf->structure(), wo, wi));
    EXPECT_TRUE(((value - exact).abs() <= kSinglePrecision * exact).all());
    EXPECT_TRUE((from_json->eval(wo, wi) == value).all());
    EXPECT_TRUE((from_binary->eval(wo, wi) == value).all());
  }
}

TEST(Spline, WeightsSumToOneAndFollowPolynomialsOfDegreeThree) {
  constexpr int kCount = 9;
  constexpr double kTolerance = 1e-14;
  for (const double x : {0.0, 1e-9, 0.3, 0.5, 0.999, 1.0}) {
    const SplineWeights w = spline_weights(x, kCount);
    EXPECT_GE(w.first, 0);
    EXPECT_LE(w.first + kSplineOrder, kCount);
    double sum = 0, line = 0;
    for (int i = 0; i < kSplineOrder; ++i) {
      const double weight = w.weight[static_cast<std::size_t>(i)];
      EXPECT_GE(weight, 0);
      sum += weight;
      line += weight * (w.first + i - 1) / (kCount - 3);  // the coefficient of x is the middle of its spline
    }
    EXPECT_NEAR(sum, 1, kTolerance);
    EXPECT_NEAR(line, x, kTolerance);
  }
}

TEST(Spline, BernsteinPolynomialsAsPowers) {
  const Eigen::MatrixXd powers = bernstein_powers(3);
  const double z = 0.3;
  const Eigen::Vector3d at = powers.transpose() * Eigen::Vector3d(z, z * z, z * z * z);
  EXPECT_NEAR(at(0), 3 * z * 0.7 * 0.7, 1e-15);
  EXPECT_NEAR(at(1), 3 * z * z * 0.7, 1e-15);
  EXPECT_NEAR(at(2), z * z * z, 1e-15);
}

TEST(Spline, AzimuthPowersAreTheBernsteinPolynomials) {
  constexpr double kTolerance = 1e-14;
  for (const int degree : {1, 4, 6}) {
    const Eigen::MatrixXd powers = azimuth_powers(degree);
    for (const double z : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      for (int m = 1; m <= degree; ++m) {
        double value = 0;
        for (int j = degree; j-- > 0;) value = value * (z - 0.5) + powers(j, m - 1);
        const double choose = std::tgamma(degree + 1) / std::tgamma(m + 1) / std::tgamma(degree - m + 1);
        EXPECT_NEAR(z * value, choose * std::pow(z, m) * std::pow(1 - z, degree - m), kTolerance) << degree << m << z;
      }
    }
  }
}

/// Cells from a theta_d of 50 degrees on count.
std::shared_ptr<const CellImportance> towards_grazing() {
  auto importance = std::make_shared<CellImportance>();
  for (int i = 0; i < Grid::theta_h; ++i) {
    for (int j = 50; j < Grid::theta_d; ++j) {
      for (int k = 0; k < CellImportance::kAzimuths; ++k) importance->bin(i, j, k) = 1;
    }
  }
  return importance;
}

TEST(RefinedRanges, SpendAllCoefficientsOnThePartThatCounts) {
  RefinedFitOptions options{.structure = small_structure(), .evaluations = 200, .importance = towards_grazing()};
  options.structure.difference = 4;
  const RefinedFit whole = fit_refined(builtin_table(), options);
  options.structure.difference_range = {30, 64};
  const RefinedFit part = fit_refined(builtin_table(), options);
  EXPECT_LT(part.objective, 0.8 * whole.objective);
  EXPECT_EQ(part.brdf->bytes(), whole.brdf->bytes() + 4);
}

TEST(RefinedRanges, AreTheSameInTheKernelAndInFiles) {
  RefinedFitOptions options{.structure = small_structure(), .evaluations = 40};
  options.structure.half_range = {8, 60};
  options.structure.difference_range = {3, 40};
  expect_the_same_in_kernel_and_files(fit_refined(builtin_table(), options).brdf);
}

TEST(RefinedRanges, MustBeWithinTheAxis) {
  RefinedFitOptions options{.structure = small_structure()};
  for (const AxisRange range : {AxisRange{-1, 5}, AxisRange{0, 65}, AxisRange{7, 7}}) {
    options.structure.half_range = range;
    EXPECT_THROW((void)fit_refined(builtin_table(), options), std::invalid_argument);
  }
}

TEST(RefinedColour, CanBeConstantAlongAnAxis) {
  RefinedFitOptions options{.structure = small_structure(), .evaluations = 40};
  options.structure.components = 1;
  options.structure.colour_difference = 1;
  expect_the_same_in_kernel_and_files(fit_refined(builtin_table(), options).brdf);
  options.structure.colour_half = 1;
  const auto brdf = fit_refined(builtin_table(), options).brdf;
  expect_the_same_in_kernel_and_files(brdf);
  const Rgb at_normal = brdf->eval(Vec3(0, 0, 1), Vec3(0, 0, 1));
  const Rgb ratios = at_normal / at_normal[1];
  EXPECT_GT((ratios - 1).abs().maxCoeff(), 0.1) << "the material is coloured";
  for (const auto& [wo, wi] : pairs()) {
    const Rgb value = brdf->eval(wo, wi);
    EXPECT_TRUE((value / value[1] - ratios).abs().maxCoeff() <= kSinglePrecision) << value.transpose();
  }
}

TEST(RefinedColour, HasNoSplineOfTwoCoefficients) {
  RefinedFitOptions options{.structure = small_structure()};
  options.structure.colour_half = 2;
  EXPECT_EQ(test::message_of<std::invalid_argument>([&] { (void)fit_refined(builtin_table(), options); }),
            "refined model: colour_half is 2, allowed are 1 and 4 to 128");
}

}  // namespace
}  // namespace sklar::brdf
