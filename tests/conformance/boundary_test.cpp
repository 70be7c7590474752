/// Points with coordinates 0 or 1: the limits that copula.hpp promises, and never NaN.

#include <array>
#include <functional>

#include "copula/archimedean_copula.hpp"
#include "tests/conformance/family_test.hpp"

namespace sklar::test {
namespace {

SKLAR_FAMILY_SUITE(Boundary);

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// n points with coordinates 0, 1, the smallest double, the largest below 1 and ordinary ones.
Points boundary_points(Index n, int dim, Rng& rng) {
  constexpr std::array<double, 8> kValues = {0, 1, 0, 1, 5e-324, 1e-12, 0.4, 1 - 0x1p-53};
  Points u(n, dim);
  for (Index i = 0; i < n; ++i) {
    for (int k = 0; k < dim; ++k) u(i, k) = kValues[rng() % kValues.size()];
  }
  return u;
}

void expect_no_nan(const Column& values, const Points& u, const char* quantity) {
  for (Index i = 0; i < values.size(); ++i) ASSERT_FALSE(std::isnan(values(i))) << quantity << row_text(u, i);
}

/// The ends of a single parameter's domain, and values far out in it.
std::vector<FamilyCase> ends(const FamilyInfo& family, const std::vector<int>& dims) {
  std::vector<FamilyCase> found;
  for (const int dim : dims) {
    if (family.parameters.size() != 1) break;
    const Interval domain = family.parameters[0].domain(dim);
    for (const double end : {domain.lowest, domain.highest, -1e6, 1e6, 1e12, 5e-324, -5e-324}) {
      if (domain.contains(end)) found.push_back({&family, dim, {end}});
    }
  }
  return found;
}

TEST_P(Boundary, NothingIsNaN) {
  Rng rng(seed_of_this_test());
  const std::vector<int> dims = {2, 3, 5};
  std::vector<FamilyCase> all = cases(dims);
  for (FamilyCase& next : ends(family(), dims)) all.push_back(std::move(next));
  for (const FamilyCase& next : all) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    const Points u = boundary_points(100, next.dim, rng);
    expect_no_nan(copula->log_pdf(u), u, "log_pdf");
    expect_no_nan(copula->log_cdf(u), u, "log_cdf");
    expect_no_nan(copula->h(u), u, "h");
    expect_no_nan(copula->h_upper(u), u, "h_upper");
    expect_no_nan(copula->h_inv(u), u, "h_inv");
    expect_no_nan(copula->h_inv_upper(u), u, "h_inv_upper");
  }
}

TEST_P(Boundary, CdfIsThatOfTheOtherCoordinates) {
  constexpr double kTolerance = 2e-13;  // two logarithms of 9.5e-14
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({3, 5})) {
    SCOPED_TRACE(next.name());
    Points u = hard_points(20, next.dim, rng);
    u.col(1) = 1;
    Points others(u.rows(), next.dim - 1);
    others << u.col(0), u.rightCols(next.dim - 2);
    const Column whole = next.copula()->log_cdf(u);
    const Column part = family().make(next.dim - 1, next.theta)->log_cdf(others);
    for (Index i = 0; i < u.rows(); ++i) {
      EXPECT_TRUE(whole(i) == part(i) || std::abs(whole(i) - part(i)) <= kTolerance * std::max(1.0, std::abs(part(i))))
          << row_text(u, i) << ": " << whole(i) << " and " << part(i);
    }
    u.col(1) = 0;
    EXPECT_TRUE((next.copula()->cdf(u) == 0).all());
  }
}

TEST_P(Boundary, ConditionalEndsAtZeroAndOne) {
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3, 5})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    Points u = boundary_points(50, next.dim, rng);
    for (const double end : {0.0, 1.0}) {
      u.col(next.dim - 1) = end;
      EXPECT_TRUE((copula->h(u) == end).all());
      EXPECT_TRUE((copula->h_upper(u) == 1 - end).all());
      EXPECT_TRUE((copula->h_inv(u) == end).all());
      EXPECT_TRUE((copula->h_inv_upper(u) == 1 - end).all());
    }
  }
}

/// f(clip(u, eps, 1 - eps)) must tend to f(u): ever nearer, or ever further out toward an infinite limit.
void expect_limit(const std::function<Column(const Points&)>& f, const Points& u) {
  constexpr double kResolution = 1e-9;
  const Column limit = f(u);
  Column last = f(u.max(1e-3).min(1 - 1e-3));
  for (const double eps : {1e-6, 1e-12}) {
    const Column value = f(u.max(eps).min(1 - eps));
    for (Index i = 0; i < u.rows(); ++i) {
      const double distance = std::isinf(limit(i)) ? std::copysign(1.0, limit(i)) * (last(i) - value(i))
                                                   : std::abs(value(i) - limit(i)) - std::abs(last(i) - limit(i));
      EXPECT_TRUE(distance <= kResolution || value(i) == limit(i))
          << row_text(u, i) << ": limit " << limit(i) << ", but " << last(i) << " then " << value(i) << " at " << eps;
    }
    last = value;
  }
}

TEST_P(Boundary, ValuesAreLimits) {
  constexpr std::array<double, 4> kValues = {0, 0.3, 0.8, 1};
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases({2, 3})) {
    const double tau = std::abs(next.tau());
    if (tau != 0 && (tau < 0.1 || tau > 0.8)) continue;  // the limit shows only far below the smallest double
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    Points u(40, next.dim);
    for (Index i = 0; i < u.size(); ++i) u(i) = kValues[rng() % kValues.size()];
    expect_limit([&](const Points& x) { return copula->log_pdf(x); }, u);
    u.col(next.dim - 1) = 0.6;
    expect_limit([&](const Points& x) { return copula->h(x); }, u);
    expect_limit([&](const Points& x) { return copula->h_inv(x); }, u);
  }
}

TEST_P(Boundary, DerivativesOfPsiAtZeroAndInfinity) {
  Column t(2);
  t << 0, kInfinity;
  for (const FamilyCase& next : cases({2, 3, 10})) {
    SCOPED_TRACE(next.name());
    const CopulaPtr copula = next.copula();
    const auto* archimedean = dynamic_cast<const ArchimedeanCopula*>(copula.get());
    if (archimedean == nullptr) continue;
    EXPECT_EQ(archimedean->log_abs_dpsi(0, t)(0), 0);
    for (int order = 0; order <= next.dim; ++order) {
      const Column value = archimedean->log_abs_dpsi(order, t);
      EXPECT_EQ(value(1), -kInfinity) << order;
      EXPECT_FALSE(std::isnan(value(0))) << order;
    }
  }
}

}  // namespace
}  // namespace sklar::test
