/// Draws against exact cell probabilities, and conditional draws against h.

#include <array>
#include <cstdlib>
#include <numeric>

#include "copula/inference/dependence.hpp"
#include "copula/mixture.hpp"
#include "copula/rotated.hpp"
#include "tests/conformance/family_test.hpp"

namespace sklar::test {
namespace {

SKLAR_FAMILY_SUITE(Sampler);

/// 100000, or $SKLAR_DRAWS: a million take about 5 minutes.
Index draw_count() {
  const char* given = std::getenv("SKLAR_DRAWS");
  return given == nullptr ? 100000 : std::atol(given);
}

const Index kDraws = draw_count();

/// Number of chi-square tests in this file, all families together, for the level of each.
int test_count() {
  return static_cast<int>(families::all().size()) * 150;
}

/// Weak, medium and strong dependence, of either sign where the family has it.
std::vector<FamilyCase> weak_medium_strong(const FamilyInfo& family, int dim) {
  std::vector<FamilyCase> chosen;
  for (const double tau : {-0.9, -0.3, 0.03, 0.4, 0.95}) {
    for (FamilyCase& next : family_cases_near(tau, {dim})) {
      const bool known = std::ranges::any_of(chosen, [&](const FamilyCase& c) { return c.theta == next.theta; });
      if (next.family == &family && !known && std::abs(next.tau() - tau) < 0.3) chosen.push_back(std::move(next));
    }
  }
  return chosen;
}

/// Cells of [0,1]^d between the same edges in every coordinate, the first coordinate fastest.
class Cells {
 public:
  Cells(std::vector<double> edges, int dim) : edges_(std::move(edges)), dim_(dim) {}

  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(std::pow(static_cast<double>(edges_.size() - 1), dim_) + 0.5);
  }

  [[nodiscard]] std::size_t index(const Points& u, Index row) const {
    std::size_t cell = 0;
    for (int k = dim_; k-- > 0;) {
      const auto above = std::upper_bound(edges_.begin() + 1, edges_.end() - 1, u(row, k));
      cell = cell * (edges_.size() - 1) + static_cast<std::size_t>(above - edges_.begin() - 1);
    }
    return cell;
  }

  /// The C-volume of every cell: C at all corners, differenced along each coordinate in turn.
  [[nodiscard]] std::vector<double> probabilities(const Copula& copula) const {
    const std::size_t n = edges_.size();
    Points corners(static_cast<Index>(std::pow(static_cast<double>(n), dim_) + 0.5), dim_);
    for (Index i = 0; i < corners.rows(); ++i) {
      auto rest = static_cast<std::size_t>(i);
      for (int k = 0; k < dim_; ++k, rest /= n) corners(i, k) = edges_[rest % n];
    }
    const Column cdf = copula.cdf(corners);
    std::vector<double> values(cdf.begin(), cdf.end());
    for (int k = 0; k < dim_; ++k) values = differences(values, k);
    return values;
  }

 private:
  // Coordinates before k have one value a cell already, those after it one value a corner.
  [[nodiscard]] std::vector<double> differences(const std::vector<double>& values, int k) const {
    const std::size_t n = edges_.size();
    const auto stride = static_cast<std::size_t>(std::pow(static_cast<double>(n - 1), k) + 0.5);
    std::vector<double> result;
    for (std::size_t block = 0; block < values.size(); block += stride * n) {
      for (std::size_t i = 0; i < stride * (n - 1); ++i) {
        result.push_back(values[block + i + stride] - values[block + i]);
      }
    }
    return result;
  }

  std::vector<double> edges_;
  int dim_;
};

/// Every route that the copula has.
std::vector<Route> routes(const Copula& copula) {
  if (!copula.has_frailty()) return {Route::conditional, Route::radial};
  return {Route::conditional, Route::frailty, Route::radial};
}

Cells cells_of(int dim) {
  if (dim == 2) {
    return {{0, 1e-4, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99, 0.999, 1 - 1e-4, 1},
            2};
  }
  if (dim == 3) return {{0, 1e-3, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 0.999, 1}, 3};
  return {{0, 0.01, 0.3, 0.7, 0.99, 1}, dim};
}

class Draws {
 public:
  Draws(CopulaPtr copula, std::string name)
      : copula_(std::move(copula)), name_(std::move(name)), cells_(cells_of(copula_->dim())) {
    expected_ = cells_.probabilities(*copula_);
    EXPECT_NEAR(std::accumulate(expected_.begin(), expected_.end(), 0.0), 1, 1e-12);
    for (double& mass : expected_) mass = std::max(mass, 0.0) * static_cast<double>(kDraws);
  }

  void expect_distribution(Route route, Rng& rng) const {
    SCOPED_TRACE(route == Route::conditional ? "conditional" : route == Route::frailty ? "frailty" : "radial");
    const Points u = copula_->sample_by(route, kDraws, rng);
    std::vector<double> observed(cells_.count());
    for (Index i = 0; i < kDraws; ++i) ++observed[cells_.index(u, i)];
    expect_chi_square(observed, expected_, test_count(), name_);
  }

  [[nodiscard]] const Copula& copula() const { return *copula_; }

 private:
  CopulaPtr copula_;
  std::string name_;
  Cells cells_;
  std::vector<double> expected_;
};

void expect_uniform(const Column& u) {
  constexpr std::size_t kBins = 20;
  std::vector<double> observed(kBins);
  const std::vector<double> expected(kBins, static_cast<double>(u.size()) / kBins);
  for (const double value : u) ++observed[std::min(static_cast<std::size_t>(value * kBins), kBins - 1)];
  expect_chi_square(observed, expected, test_count(), "margin");
}

TEST_P(Sampler, EveryRouteFollowsTheCellProbabilities) {
  Rng rng(seed_of_this_test());
  for (const int dim : {2, 3, 5}) {
    for (const FamilyCase& next : weak_medium_strong(family(), dim)) {
      SCOPED_TRACE(next.name());
      const Draws draws(next.copula(), next.name());
      for (const Route route : routes(draws.copula())) draws.expect_distribution(route, rng);
    }
  }
}

TEST_P(Sampler, RoutesOfRotationsAndMixtures) {
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : cases_near(0.4, {2, 3})) {
    SCOPED_TRACE(next.name());
    std::vector<bool> first(static_cast<std::size_t>(next.dim), false);
    first.front() = true;
    const CopulaPtr rotated = std::make_shared<Rotated>(next.copula(), first);
    const CopulaPtr mixture =
        std::make_shared<Mixture>(std::vector{rotated, survival_copula(next.copula())}, std::vector{0.3, 0.7});
    for (const CopulaPtr& copula : {rotated, mixture}) {
      const Draws draws(copula, next.name());
      for (const Route route : routes(*copula)) {
        if (route != Route::conditional) draws.expect_distribution(route, rng);
      }
    }
  }
}

// The support of an Archimedean copula is an upper set: a draw at its edge may be outside by rounding, no further.
TEST_P(Sampler, NoDrawWhereTheDensityIs0) {
  Rng rng(seed_of_this_test());
  for (const int dim : {2, 3}) {
    for (const FamilyCase& next : weak_medium_strong(family(), dim)) {
      SCOPED_TRACE(next.name());
      const CopulaPtr copula = next.copula();
      for (const Route route : routes(*copula)) {
        const Points u = copula->sample_by(route, kDraws / 10, rng);
        const Column log_pdf = copula->log_pdf((u * (1 + 4e-16)).min(1 - 0x1p-53));
        EXPECT_TRUE((log_pdf > -std::numeric_limits<double>::infinity()).all()) << static_cast<int>(route);
      }
    }
  }
}

// Kendall's tau of pairs and the uniformity of each coordinate, also where cells are too many to count.
TEST_P(Sampler, RoutesHaveTheTauAndTheMargins) {
  const Index kPoints = kDraws / 5;
  Rng rng(seed_of_this_test());
  for (const int dim : {2, 100}) {
    for (const FamilyCase& next : weak_medium_strong(family(), dim)) {
      SCOPED_TRACE(next.name());
      const CopulaPtr copula = next.copula();
      for (const Route route : routes(*copula)) {
        const Index n = dim == 2 ? kPoints : std::max(kPoints / 80, Index{250});
        const Points u = copula->sample_by(route, n, rng);
        // The standard error of tau is at most sqrt(2 (1 - tau^2) / n).
        const double error = std::sqrt(2 * (1 - next.tau() * next.tau()) / static_cast<double>(n));
        EXPECT_NEAR(kendall_tau(u.col(0), u.col(dim - 1)), next.tau(), 4 * error) << static_cast<int>(route);
        for (const int k : {0, dim / 2, dim - 1}) expect_uniform(u.col(k));
      }
    }
  }
}

TEST_P(Sampler, ConditionalDrawsFollowH) {
  const Index kConditionalDraws = kDraws / 4;
  constexpr Index kCells = 40;
  Rng rng(seed_of_this_test());
  for (const FamilyCase& next : weak_medium_strong(family(), 3)) {
    const CopulaPtr copula = next.copula();
    for (const double first : {1e-6, 0.3, 1 - 1e-6}) {
      SCOPED_TRACE(next.name() + " given " + to_text(first));
      // Two coordinates given, one perhaps extreme; edges equally spaced between the outer quantiles.
      Points given(1, 2);
      given << first, 0;
      given(0, 1) = copula->h_inv((Points(1, 2) << first, 0.4).finished())(0);
      const Points u = copula->sample(kConditionalDraws, rng, given);
      EXPECT_TRUE((u.col(0) == given(0, 0)).all() && (u.col(1) == given(0, 1)).all());
      const double low = copula->h_inv((Points(1, 3) << given, 1e-3).finished())(0);
      const double high = copula->h_inv((Points(1, 3) << given, 1 - 1e-3).finished())(0);
      Points edges = given.replicate(kCells + 1, 1);
      edges.conservativeResize(kCells + 1, 3);
      for (Index i = 0; i <= kCells; ++i) edges(i, 2) = low + (high - low) * static_cast<double>(i) / kCells;
      edges(0, 2) = 0;
      edges(kCells, 2) = 1;
      const Column h = copula->h(edges);
      std::vector<double> expected, observed(kCells);
      for (Index i = 0; i < kCells; ++i) expected.push_back((h(i + 1) - h(i)) * static_cast<double>(kConditionalDraws));
      for (Index i = 0; i < kConditionalDraws; ++i) {
        const auto edge = std::upper_bound(edges.col(2).begin() + 1, edges.col(2).end() - 1, u(i, 2));
        ++observed[static_cast<std::size_t>(edge - edges.col(2).begin() - 1)];
      }
      expect_chi_square(observed, expected, test_count(), next.name());
    }
  }
}

}  // namespace
}  // namespace sklar::test
