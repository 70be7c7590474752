#include "copula/inference/goodness.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "copula/error.hpp"
#include "copula/inference/checks.hpp"
#include "copula/inference/dependence.hpp"
#include "copula/inference/ranks.hpp"

namespace sklar {
namespace {

/// For each row the number of rows, itself among them, that are at most as large in every coordinate. A word holds
/// which of 64 rows are so in one column: in the order of the column it grows, and a row keeps what all columns agree
/// on.
std::vector<int> rows_not_above(const PointsRef& u) {
  const Index n = u.rows();
  std::vector<std::vector<Index>> orders;
  for (Index k = 0; k < u.cols(); ++k) orders.push_back(sorted_order(u.col(k)));
  std::vector<int> counts(static_cast<std::size_t>(n));
  std::vector<std::uint64_t> common(static_cast<std::size_t>(n));
  constexpr Index kBits = 64;
  for (Index block = 0; block < n; block += kBits) {
    std::fill(common.begin(), common.end(), ~std::uint64_t{0});
    for (Index k = 0; k < u.cols(); ++k) {
      const std::vector<Index>& order = orders[static_cast<std::size_t>(k)];
      std::uint64_t seen = 0;
      for_each_run(u.col(k), order, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          const Index bit = order[i] - block;
          if (bit >= 0 && bit < kBits) seen |= std::uint64_t{1} << bit;
        }
        for (std::size_t i = first; i < last; ++i) common[static_cast<std::size_t>(order[i])] &= seen;
      });
    }
    for (std::size_t row = 0; row < common.size(); ++row) counts[row] += std::popcount(common[row]);
  }
  return counts;
}

double measure(GoodnessStatistic statistic, const Copula& copula, const PointsRef& u) {
  return statistic == GoodnessStatistic::cramer_von_mises ? cramer_von_mises(copula, u)
                                                          : rosenblatt_distance(copula, u);
}

}  // namespace

double cramer_von_mises(const Copula& copula, const PointsRef& u) {
  require_enough_rows("cramer_von_mises", "u", u.rows(), 1);
  require_finite("cramer_von_mises", "u", u);
  const Column expected = copula.cdf(u);
  const std::vector<int> counts = rows_not_above(u);
  const auto n = static_cast<double>(u.rows());
  double sum = 0;
  for (Index i = 0; i < u.rows(); ++i) {
    const double difference = counts[static_cast<std::size_t>(i)] / n - expected[i];
    sum += difference * difference;
  }
  return sum;
}

double rosenblatt_distance(const Copula& copula, const PointsRef& u) {
  require_enough_rows("rosenblatt_distance", "u", u.rows(), 1);
  require_finite("rosenblatt_distance", "u", u);
  const Points w = copula.rosenblatt(u);
  const Index n = w.rows();
  double single = 0, pairs = 0;
  for (Index i = 0; i < n; ++i) {
    single += (1 - w.row(i).square()).prod();
    // Every pair i < j twice, and i with itself.
    const Index rest = n - i - 1;
    Column product = Column::Constant(rest, 2);
    for (Index k = 0; k < w.cols(); ++k) product *= 1 - w.col(k).tail(rest).max(w(i, k));
    pairs += product.sum() + (1 - w.row(i)).prod();
  }
  const auto d = static_cast<double>(w.cols());
  return static_cast<double>(n) / std::pow(3, d) - single * std::exp2(1 - d) + pairs / static_cast<double>(n);
}

std::string_view to_text(GoodnessStatistic statistic) {
  return statistic == GoodnessStatistic::cramer_von_mises ? "cvm" : "rosenblatt";
}

GoodnessResult test_goodness(const FamilyInfo& family, const PointsRef& x, const GoodnessOptions& options) {
  const auto seen = [&options](const PointsRef& points) {
    return options.ranks ? pseudo_observations(points) : Points(points);
  };
  const Points u = seen(x);
  FitOptions fit_options = options.fit;
  GoodnessResult result{.fit = fit(family, options.method, u, Column(), fit_options)};
  for (const Index tied : tied_rows(x)) result.tied += tied;
  if (result.fit.status == FitStatus::failed) return result;
  const auto dim = static_cast<int>(u.cols());
  const CopulaPtr copula = family.make(dim, result.fit.theta);
  result.statistic = measure(options.statistic, *copula, u);

  fit_options.standard_errors = false;
  std::vector<double> replicated(static_cast<std::size_t>(std::max(options.bootstrap.replicates, 0)), result.kNone);
  for_each_replicate(*copula, u.rows(), options.bootstrap, [&](int replicate, const Points& drawn) {
    const Points sample = seen(drawn);
    const FitResult refit = fit(family, options.method, sample, Column(), fit_options);
    if (refit.status == FitStatus::failed) return;
    replicated[static_cast<std::size_t>(replicate)] =
        measure(options.statistic, *family.make(dim, refit.theta), sample);
  });
  result.failed = static_cast<int>(std::ranges::count_if(replicated, [](double t) { return std::isnan(t); }));
  result.replicates = options.bootstrap.replicates - result.failed;
  if (result.replicates == 0 || std::isnan(result.statistic)) return result;
  const auto above = std::ranges::count_if(replicated, [&](double t) { return t >= result.statistic; });
  result.p_value = static_cast<double>(1 + above) / (result.replicates + 1);
  result.p_error = std::sqrt(result.p_value * (1 - result.p_value) / result.replicates);
  return result;
}

}  // namespace sklar
