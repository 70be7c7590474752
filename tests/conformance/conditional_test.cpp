/// Conditional distributions and their inverses agree with each other.

#include <array>

#include "tests/conformance/family_test.hpp"

namespace sklar::test {
namespace {

SKLAR_FAMILY_SUITE(Conditional);

constexpr double kProbability = 2e-13;  // h and 1 - h, each within 9.5e-14

TEST_P(Conditional, ComplementsAddUpToOne) {
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3, 5, 10, 50})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    const Points u = hard_points(40, next.dim, rng);
    EXPECT_LE((copula->h(u) + copula->h_upper(u) - 1).abs().maxCoeff(), kProbability);
    EXPECT_LE((copula->h_inv(u) + copula->h_inv_upper(u) - 1).abs().maxCoeff(), 1e-12);
  }
}

TEST_P(Conditional, InverseUndoesH) {
  // p is recovered up to what one rounding of v, or of 1 - v where that is the smaller, does to h.
  constexpr std::array<double, 9> kLevels = {1e-300, 1e-100, 1e-12, 1e-3, 0.3, 0.5, 1 - 1e-3, 1 - 1e-9, 1 - 1e-14};
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3, 5, 10})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    Points u = hard_points(27, next.dim, rng);
    for (Index i = 0; i < u.rows(); ++i) u(i, next.dim - 1) = kLevels[static_cast<std::size_t>(i) % kLevels.size()];
    const Column p = u.col(next.dim - 1), v = copula->h_inv(u);
    Points at = u, below = u, above = u;
    at.col(next.dim - 1) = v;
    constexpr double kStep = 2e-12;  // relative; the inverse is within 4e-13 or the last place
    below.col(next.dim - 1) = (v * (1 - kStep)).unaryExpr([](double x) { return std::nextafter(x, 0.0); });
    above.col(next.dim - 1) =
        (v * (1 + kStep)).unaryExpr([](double x) { return std::min(std::nextafter(x, 2.0), 1.0); });
    const Column low = copula->h(below), high = copula->h(above);
    for (Index i = 0; i < u.rows(); ++i) {
      EXPECT_LE(low(i) * (1 - kProbability), p(i)) << row_text(u, i) << " v = " << v(i);
      EXPECT_GE(high(i) * (1 + kProbability), p(i)) << row_text(u, i) << " v = " << v(i);
    }
  }
}

TEST_P(Conditional, BothIncrease) {
  constexpr Index kSteps = 60;
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3, 5})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    for (int trial = 0; trial < 4; ++trial) {
      Points u = hard_points(1, next.dim, rng).replicate(kSteps, 1);
      for (Index i = 0; i < kSteps; ++i) {  // 1e-15 to 1 - 1e-15, dense at both ends
        const double x = -34.5 + 69.0 * static_cast<double>(i) / (kSteps - 1);
        u(i, next.dim - 1) = 1 / (1 + std::exp(-x));
      }
      const Column h = copula->h(u), upper = copula->h_upper(u), v = copula->h_inv(u);
      for (Index i = 1; i < kSteps; ++i) {
        EXPECT_GE(h(i), h(i - 1) * (1 - kProbability)) << row_text(u, i);
        EXPECT_LE(upper(i), upper(i - 1) * (1 + kProbability)) << row_text(u, i);
        EXPECT_GE(v(i), v(i - 1) * (1 - 1e-12)) << row_text(u, i);
      }
    }
  }
}

TEST_P(Conditional, RosenblattAndItsInverse) {
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases_near(0.3, {2, 3, 5, 10})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    const Points w = uniforms(rng, 50, next.dim);
    const Points u = copula->inverse_rosenblatt(w);
    EXPECT_TRUE((u.col(0) == w.col(0)).all());
    EXPECT_LE((copula->rosenblatt(u) - w).abs().maxCoeff(), 1e-11);
    // The same with leading coordinates given, in every row or once for all.
    for (int given = 1; given < next.dim; ++given) {
      const Points rest = w.rightCols(next.dim - given);
      EXPECT_TRUE((copula->inverse_rosenblatt(rest, u.leftCols(given)) == u).all()) << given;
      const Points once = copula->inverse_rosenblatt(rest.row(7), u.leftCols(given).row(7));
      EXPECT_TRUE((once == u.row(7)).all()) << given;
      const Points shared = copula->inverse_rosenblatt(rest, u.leftCols(given).row(7));
      EXPECT_TRUE((shared.row(7) == u.row(7)).all()) << given;
    }
  }
}

}  // namespace
}  // namespace sklar::test
