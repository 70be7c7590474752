/// What sets each basis model apart: published identities and figures, and tables that it holds exactly.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/SVD>
#include <cmath>
#include <numbers>

#include "brdf/analytic/synthetic.hpp"
#include "brdf/basis/fill.hpp"
#include "brdf/basis/half_array.hpp"
#include "brdf/basis/linear_explanatory.hpp"
#include "brdf/basis/low_rank.hpp"
#include "brdf/basis/nmf_fit.hpp"
#include "brdf/basis/registry.hpp"
#include "brdf/basis/spherical_harmonics.hpp"
#include "brdf/basis/wavelets.hpp"
#include "brdf/basis/zernike.hpp"
#include "brdf/data/tabulate.hpp"
#include "brdf/geometry/coordinates.hpp"
#include "brdf/geometry/frame.hpp"
#include "copula/random.hpp"
#include "tests/support/function_brdf.hpp"

namespace sklar::brdf {
namespace {

/// Calls visit(n, pair) for some thousand valid cells.
template <class Visit>
void for_some_cells(const MeasuredTable& table, const Visit& visit) {
  for (int cell = 0; cell < Grid::cells; cell += 277) {
    const int k = cell % Grid::phi_d, j = cell / Grid::phi_d % Grid::theta_d, i = cell / (Grid::phi_d * Grid::theta_d);
    const auto n = static_cast<std::size_t>(cell);
    if (table.valid[n] == 0) continue;
    visit(n, directions({Grid::theta_h_centre(i), Grid::theta_d_centre(j), Grid::phi_d_centre(k)}));
  }
}

MeasuredTable table_of(const test::FunctionBrdf::Formula& formula) {
  return tabulate(test::FunctionBrdf(formula), "formula", Provenance::synthetic);
}

/// Sum of |g - f| over that of f, green channel, over some cells with both angles below 80 degrees.
double relative_error(const Brdf& model, const MeasuredTable& table) {
  double sum = 0, difference = 0;
  for_some_cells(table, [&](std::size_t n, const DirectionPair& pair) {
    if (std::min(pair.wi.z(), pair.wo.z()) < 0.17) return;
    difference += std::abs(model.eval(pair.wo, pair.wi)[1] - table.values[1][n]);
    sum += table.values[1][n];
  });
  return difference / sum;
}

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns) {
  Rng rng(1);
  Eigen::MatrixXd matrix(rows, columns);
  for (double& value : matrix.reshaped()) value = uniform(rng);
  return matrix;
}

TEST(BasisTable, HoldsItsCells) {
  const MeasuredTable table = builtin_material();
  const BrdfPtr model = basis::find("table").fit({.table = table}, std::numeric_limits<double>::infinity());
  EXPECT_EQ(model->bytes(), 3U * 90 * 90 * 180 * 8);
  for_some_cells(table, [&](std::size_t n, const DirectionPair& pair) {
    EXPECT_NEAR(model->eval(pair.wo, pair.wi)[1], table.values[1][n], 1e-9 * table.values[1][n]);
  });
}

TEST(HalfArray, IsWithinItsStatedError) {
  const std::vector<double> values = {-1e6, 1e6, 123.456, -61, 1e-3, 1e-9, 0};
  const HalfArray array(values);
  EXPECT_EQ(array.bytes(), 4 + 2 * values.size());
  for (std::size_t n = 0; n < values.size(); ++n) {
    EXPECT_NEAR(array[n], values[n], std::max(5e-4 * std::abs(values[n]), 3e-8 * 1e6)) << values[n];
  }
  EXPECT_EQ(HalfArray(std::vector<double>(3))[1], 0);
}

/// A linear function of the cell's indices away from the ends of phi_d is its own mean of neighbours.
TEST(Filled, ContinuesValidCells) {
  MeasuredTable table = builtin_material();
  table.valid.assign(Grid::cells, 1);
  for (auto& plane : table.values) plane.assign(Grid::cells, 0.0);
  for (int i = 0; i < Grid::theta_h; ++i) {
    for (int j = 0; j < Grid::theta_d; ++j) {
      for (int k = 0; k < Grid::phi_d; ++k) {
        const auto n = static_cast<std::size_t>(Grid::index(i, j, k));
        table.values[1][n] = 1 + i + 2 * j;
        if (i % 2 == 1 && j % 2 == 1 && k % 2 == 1 && i < 89 && j < 89) {
          table.valid[n] = 0;
          table.values[1][n] = 1e9;
        }
      }
    }
  }
  const MeasuredTable result = filled(table);
  EXPECT_EQ(result.valid_cells(), static_cast<std::size_t>(Grid::cells));
  for (int i = 0; i < Grid::theta_h; ++i) {
    const auto n = static_cast<std::size_t>(Grid::index(i, 41, 61));
    EXPECT_NEAR(result.values[1][n], 1 + i + 82, 1e-9) << i;
  }
}

/// Eckart and Young 1936: the error of the best product of rank k is the sum of the squares of the other singular
/// values.
TEST(LowRank, IsTheTruncatedDecomposition) {
  const Eigen::MatrixXd values = random_matrix(20, 40);
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(20, 40);
  const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXd>(values).singularValues();
  for (const int rank : {1, 3, 20}) {
    const LowRank product = low_rank(values, ones, rank, 2);
    EXPECT_NEAR((values - product.rows * product.columns.transpose()).squaredNorm(),
                singular.tail(20 - rank).squaredNorm(), 1e-9);
    for (int k = 0; k < rank; ++k) EXPECT_NEAR(product.columns.col(k).norm(), singular[k], 1e-6) << k;
  }
}

TEST(LowRank, TakesNoNoticeOfWhatHasNoWeight) {
  const Eigen::MatrixXd product = random_matrix(20, 2) * random_matrix(2, 40);
  Eigen::MatrixXd values = product, weights = Eigen::MatrixXd::Ones(20, 40);
  for (Eigen::Index n = 0; n < 20; ++n) {
    values(n, 2 * n) += 5;
    weights(n, 2 * n) = 1e-12;
  }
  const LowRank found = low_rank(values, weights, 2, 50);
  EXPECT_LT((found.rows * found.columns.transpose() - product).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(SeparableSvd, HoldsASeparableTable) {
  const MeasuredTable table = table_of([](const Vec3& wo, const Vec3& wi) -> Rgb {
    const HalfDifference at = half_difference(wo, wi);
    const double of_half = std::exp(-4 * at.theta_h * at.theta_h);
    const double of_difference = 1 + std::pow(std::sin(at.theta_d), 2) * std::cos(2 * at.phi_d);
    return Rgb(0.1, 0.2, 0.3) * of_half * (0.5 + of_difference);
  });
  const BrdfPtr model = basis::find("separable_svd").fit({.table = table}, 4000);
  EXPECT_LT(relative_error(*model, table), 5e-3);  // interpolation between 45 nodes, and half precision
}

TEST(Basis, FitsDoNotDependOnThreads) {
  const MeasuredTable table = builtin_material();
  for (const char* name : {"separable_svd", "zernike"}) {
    const BrdfPtr many = basis::find(name).fit({.table = table}, 500);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const BrdfPtr single = basis::find(name).fit({.table = table}, 500);
    for_some_cells(table, [&](std::size_t, const DirectionPair& pair) {
      ASSERT_TRUE((many->eval(pair.wo, pair.wi) == single->eval(pair.wo, pair.wi)).all()) << name;
    });
  }
}

TEST(Homomorphic, HoldsAProduct) {
  const MeasuredTable table = table_of([](const Vec3& wo, const Vec3& wi) -> Rgb {
    const double theta_h = polar_angle(wi + wo);
    const double p = (0.2 + wi.z()) * (0.2 + wo.z());
    return Rgb(0.1, 0.2, 0.3) * p * (0.1 + std::exp(-9 * theta_h * theta_h));
  });
  const BrdfPtr model = basis::find("homomorphic").fit({.table = table}, 1100);
  EXPECT_LT(relative_error(*model, table), 1e-2);  // interpolation of logarithms, and half precision
}

double divergence(const Eigen::MatrixXd& values, const NonNegativeFactors& factors) {
  const Eigen::ArrayXXd z = (factors.outer * factors.inner).array();
  return (values.array() * (values.array() / z).log() - values.array() + z).sum();
}

/// Lee and Seung 2001, Theorem 2: no update raises the divergence, and a matrix of the rank asked for is a fixed point.
TEST(NonNegativeFactors, LessenTheDivergence) {
  const Eigen::MatrixXd values = random_matrix(12, 30);
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(12, 30);
  double previous = std::numeric_limits<double>::infinity();
  for (const int updates : {0, 1, 2, 4, 8, 50}) {
    const NonNegativeFactors factors = non_negative_factors(values, ones, 3, updates);
    EXPECT_GE(factors.outer.minCoeff(), 0);
    EXPECT_GE(factors.inner.minCoeff(), 0);
    const double here = divergence(values, factors);
    EXPECT_LT(here, previous) << updates;
    previous = here;
  }
  const Eigen::MatrixXd product = random_matrix(12, 1) * random_matrix(1, 30);
  EXPECT_LT(divergence(product, non_negative_factors(product, ones, 1, 5)), 1e-12);
}

/// f cos_i of its own form: with the sampler drawing in proportion, f cos_i 4 (wo.h) / weight is one constant.
TEST(Nmf, HoldsASeparableTableAndDrawsInProportion) {
  const MeasuredTable table = table_of([](const Vec3& wo, const Vec3& wi) -> Rgb {
    const double theta_h = polar_angle(wi + wo);
    return Rgb(0.1, 0.2, 0.3) * (0.1 + std::exp(-9 * theta_h * theta_h)) / (wi.z() * wo.z() + 1e-3);
  });
  const BrdfPtr model = basis::find("nmf").fit({.table = table}, 3500);
  EXPECT_LT(relative_error(*model, table), 0.05);  // 1 / cos(theta_o) between 24 nodes
  const Vec3 wo = spherical_direction(0.7, 0.3);
  double least = std::numeric_limits<double>::infinity(), most = 0;
  Rng rng(1);
  for (int n = 0; n < 1000; ++n) {
    const double first = uniform(rng);
    const Sample draw = model->sample(wo, {first, uniform(rng)});
    if (!(draw.wi.z() > 0.2)) continue;
    const double ratio = draw.weight[1] / (4 * wo.dot((draw.wi + wo).normalized()));
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  EXPECT_LT(most / least, 1.25);  // p is the mean over a bin of the nodes
}

/// A table that is one of those learnt from, under another name, is a sum of all components but for their
/// interpolation.
TEST(Pca, HoldsWhatItHasLearnt) {
  std::vector<std::shared_ptr<const MeasuredTable>> others;
  for (const double sharpness : {1.0, 4.0}) {
    others.push_back(std::make_shared<const MeasuredTable>(table_of([=](const Vec3& wo, const Vec3& wi) -> Rgb {
      const double theta_h = polar_angle(wi + wo);
      return Rgb(0.1, 0.2, 0.4) + sharpness * std::exp(-sharpness * theta_h * theta_h);
    })));
  }
  MeasuredTable table = *others[1];
  table.name = "known";
  const BasisInfo& info = basis::find("pca");
  EXPECT_LT(relative_error(*info.fit({.table = table, .others = others}, 60000), table), 0.02);
  const std::vector others_short = {others[0]};
  EXPECT_THROW((void)info.fit({.table = table, .others = others_short}, 60000), std::invalid_argument);
}

/// Integral over z = cos(theta) from `lowest` to 1 and all azimuths of R_mj R_mk cos^2(m phi), times 2 for m > 0 where
/// the norm is that of the spherical harmonics.
Eigen::MatrixXd gram(const RadialFunctions& radial, int order, int m, double lowest, double azimuths) {
  constexpr int kNodes = 20000;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(radial.count(order, m), radial.count(order, m));
  Eigen::VectorXd values(sum.rows());
  for (int n = 0; n < kNodes; ++n) {
    const double z = lowest + (n + 0.5) / kNodes * (1 - lowest);
    radial.values(order, m, {std::sqrt(1 - z * z), 0, z}, values.data());
    sum += values * values.transpose();
  }
  return sum * ((1 - lowest) / kNodes * azimuths);
}

TEST(SphericalHarmonics, AreOrthonormalOverTheSphere) {
  for (const int m : {0, 1, 2, 7, 12}) {
    const Eigen::MatrixXd found = gram(SphericalHarmonics::radial(), 12, m, -1, 2 * std::numbers::pi);
    EXPECT_LT((found - Eigen::MatrixXd::Identity(found.rows(), found.cols())).cwiseAbs().maxCoeff(), 1e-4) << m;
  }
  const Vec3 w(0.48, 0.64, 0.6);  // Y_2^0 = sqrt(5 / pi) / 4 (3 z^2 - 1)
  std::array<double, 3> values{};
  SphericalHarmonics::radial().values(2, 0, w, values.data());
  EXPECT_NEAR(values[2], 0.25 * std::sqrt(5 / std::numbers::pi) * (3 * 0.36 - 1), 1e-15);
}

TEST(SphericalHarmonics, HoldTheirOwn) {
  EXPECT_EQ((SeriesShape{SphericalHarmonics::radial(), 2, false}.coefficients()), 14U);
  const MeasuredTable lambert = table_of([](const Vec3&, const Vec3&) -> Rgb { return {0.1, 0.2, 0.3}; });
  EXPECT_LT(relative_error(*basis::find("spherical_harmonics").fit({.table = lambert}, 200), lambert), 1e-3);
}

TEST(Zernike, FunctionsAreOrthonormalOverTheHemisphere) {
  for (const int m : {0, 1, 2, 7, 12}) {
    const double azimuths = std::numbers::pi * (m == 0 ? 2 : 1);
    const Eigen::MatrixXd found = gram(Zernike::radial(), 12, m, 0, azimuths);
    EXPECT_LT((found - Eigen::MatrixXd::Identity(found.rows(), found.cols())).cwiseAbs().maxCoeff(), 1e-4) << m;
  }
  const Vec3 w(0.48, 0.64, 0.6);  // R_4^2 = 4 r^4 - 3 r^2, r^2 = 0.4
  std::array<double, 2> values{};
  Zernike::radial().values(4, 2, w, values.data());
  EXPECT_NEAR(values[1], std::sqrt(5 / std::numbers::pi) * (4 * 0.16 - 3 * 0.4), 1e-15);
}

/// Koenderink, van Doorn and Stavridi 1996: 5 isotropic reciprocal modes up to order 2, 14 up to 4, 55 up to 8.
TEST(Zernike, ModesNumberAsPublished) {
  const auto modes = [](int order) { return SeriesShape{Zernike::radial(), order, true}.coefficients(); };
  EXPECT_EQ(modes(0), 1U);
  EXPECT_EQ(modes(2), 5U);
  EXPECT_EQ(modes(4), 14U);
  EXPECT_EQ(modes(8), 55U);
}

TEST(Zernike, HoldsItsOwnModes) {
  const MeasuredTable table = table_of([](const Vec3& wo, const Vec3& wi) -> Rgb {
    std::array<double, 1> of_wo{}, of_wi{};
    Zernike::radial().values(1, 1, wo, of_wo.data());
    Zernike::radial().values(1, 1, wi, of_wi.data());
    const double cosine =
        (wi.x() * wo.x() + wi.y() * wo.y()) / (std::hypot(wi.x(), wi.y()) * std::hypot(wo.x(), wo.y()));
    return Rgb(0.4, 0.5, 0.6) + 0.2 * of_wo[0] * of_wi[0] * cosine;
  });
  EXPECT_LT(relative_error(*basis::find("zernike").fit({.table = table}, 6 * 5 + 13), table), 1e-3);
}

/// The first halving is across phi_d, the longest side: a table of two values along it has one coefficient.
TEST(Wavelets, HoldAStepByOneCoefficient) {
  MeasuredTable table = builtin_material();
  for (int cell = 0; cell < Grid::cells; ++cell) {
    for (auto& plane : table.values) plane[static_cast<std::size_t>(cell)] = cell % Grid::phi_d < 90 ? 0.25 : 1;
  }
  const BrdfPtr model = basis::find("wavelets").fit({.table = table}, static_cast<double>(Wavelets::bytes(1)));
  EXPECT_EQ(model->bytes(), Wavelets::bytes(1));
  for_some_cells(table, [&](std::size_t n, const DirectionPair& pair) {
    EXPECT_NEAR(model->eval(pair.wo, pair.wi)[1], table.values[1][n], 1e-6);
  });
}

/// With all coefficients the wavelets are the table, but for rounding, which the means of small boxes have from the
/// coefficients of large ones.
TEST(Wavelets, HoldEveryCellWithoutALimit) {
  const MeasuredTable table = builtin_material();
  const BrdfPtr model = basis::find("wavelets").fit({.table = table}, std::numeric_limits<double>::infinity());
  EXPECT_GT(model->bytes(), Wavelets::bytes(1000000));
  EXPECT_LE(model->bytes(), Wavelets::bytes(Grid::cells - 1));
  EXPECT_LT(relative_error(*model, table), 1e-2);
}

TEST(Wavelets, RefuseBitsThatAreNotATree) {
  Wavelets::Tree tree;
  const std::vector<double> one = {1};
  tree.difference = tree.rest = {HalfArray(one), HalfArray(one), HalfArray(one)};
  tree.halved = {0};
  EXPECT_NO_THROW((void)Wavelets(tree));
  tree.halved = {1};
  EXPECT_THROW((void)Wavelets(tree), std::invalid_argument);
}

/// A polynomial of degree 2 in the variables is one of degree 2 in their components.
TEST(LinearExplanatory, HoldsAPolynomialOfItsVariables) {
  EXPECT_EQ(LinearExplanatory::terms(2), 15U);
  EXPECT_EQ(LinearExplanatory::terms(8), 495U);
  const MeasuredTable table = table_of([](const Vec3& wo, const Vec3& wi) -> Rgb {
    const auto x = ExplanatoryComponents::variables(wo, wi);
    return Rgb(0.4, 0.5, 0.6) + x[0] * x[1] - 0.1 * x[3] + 0.2 * x[2] * x[2];
  });
  const BrdfPtr model =
      basis::find("linear_explanatory").fit({.table = table}, static_cast<double>(LinearExplanatory::bytes(2)));
  EXPECT_LT(relative_error(*model, table), 2e-3);  // half precision
}

}  // namespace
}  // namespace sklar::brdf
