#include "copula/inference/diagnostics.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "copula/archimedean_copula.hpp"
#include "copula/error.hpp"
#include "copula/inference/checks.hpp"

namespace sklar {
namespace {

/// Adds to each row of `order` the number of rows before it that are not above it in y, and sorts `order` by y.
void count_not_above(std::span<Index> order, const ColumnRef& y, Column& count) {
  if (order.size() < 2) return;
  const std::size_t middle = order.size() / 2;
  count_not_above(order.first(middle), y, count);
  count_not_above(order.subspan(middle), y, count);
  std::size_t before = 0;
  for (const Index row : order.subspan(middle)) {
    while (before < middle && y[order[before]] <= y[row]) ++before;
    count[row] += static_cast<double>(before);
  }
  std::inplace_merge(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(middle), order.end(),
                     [&y](Index a, Index b) { return y[a] < y[b]; });
}

/// For each row the number of others that are not above it in x nor in y.
Column pairs_below(const ColumnRef& x, const ColumnRef& y) {
  std::vector<Index> order(static_cast<std::size_t>(x.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return x[a] < x[b] || (x[a] == x[b] && y[a] < y[b]); });
  Column below = Column::Zero(x.size());
  std::vector<Index> sorted = order;
  count_not_above(sorted, y, below);
  for (std::size_t i = order.size(); i-- > 1;) {  // of equal rows the last one counts all others
    const Index row = order[i - 1], next = order[i];
    if (x[row] == x[next] && y[row] == y[next]) below[row] = below[next];
  }
  return below;
}

/// The same in any number of columns.
Column rows_below(const PointsRef& x) {
  Column below(x.rows());
  Column nowhere_above(x.rows());  // 1 or 0
  for (Index row = 0; row < x.rows(); ++row) {
    nowhere_above.setOnes();
    for (Index column = 0; column < x.cols(); ++column) {
      nowhere_above *= (x.col(column) <= x(row, column)).cast<double>();
    }
    below[row] = nowhere_above.sum() - 1;
  }
  return below;
}

/// What is left out of the distribution of an order statistic at each end.
constexpr double kLeftOut = 1e-17;

/// Where the sum of d standard exponentials is above s with probability p: log w = -s has K_0(w) = p.
double exponential_sum(int dim, double p) {
  return p >= 1 ? 0 : boost::math::gamma_q_inv(static_cast<double>(dim), p);
}

}  // namespace

Column joint_ranks(const PointsRef& x) {
  require_enough_rows("joint_ranks", "x", x.rows(), 2);
  if (x.cols() < 2) {
    throw std::invalid_argument("joint_ranks: x must have 2 or more columns, got " + std::to_string(x.cols()));
  }
  require_finite("joint_ranks", "x", x);
  const Column below = x.cols() == 2 ? pairs_below(x.col(0), x.col(1)) : rows_below(x);
  return below / static_cast<double>(x.rows() - 1);
}

double expected_joint_rank(Index i, Index n, int dim) {
  if (n < 1 || i < 1 || i > n || dim < 1) {
    throw std::invalid_argument("expected_joint_rank: needs 1 <= i <= n and dim >= 1, got i = " + std::to_string(i) +
                                ", n = " + std::to_string(n) + ", dim = " + std::to_string(dim));
  }
  const auto a = static_cast<double>(i);
  const auto b = static_cast<double>(n - i + 1);
  const double shape = dim;
  const double lowest = exponential_sum(dim, boost::math::ibetac_inv(a, b, kLeftOut));
  const double highest = exponential_sum(dim, boost::math::ibeta_inv(a, b, kLeftOut));
  // Over s = -log w: K_0 at w is the upper tail of a gamma distribution at s, and its i-th order statistic a beta one.
  const auto integrand = [&](double s) {
    const double p = boost::math::gamma_q(shape, s);
    return std::exp(-s) * boost::math::gamma_p_derivative(shape, s) * boost::math::ibeta_derivative(a, b, p);
  };
  return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(integrand, lowest, highest, 10, 1e-12);
}

Column kendall_distribution(const Copula& copula, const ColumnRef& t) {
  if (const auto* archimedean = dynamic_cast<const ArchimedeanCopula*>(&copula)) return archimedean->kendall_cdf(t);
  require_unit_cube("kendall_distribution", "t", t);
  Rng rng(1);
  Column levels = copula.cdf(copula.sample(kKendallDraws, rng));
  std::sort(levels.begin(), levels.end());
  return t.unaryExpr([&](double value) {
    const auto below = std::upper_bound(levels.begin(), levels.end(), value) - levels.begin();
    return static_cast<double>(below) / static_cast<double>(kKendallDraws);
  });
}

Points normal_scores(const PointsRef& u) {
  require_open_unit_cube("normal_scores", "u", u);
  return u.unaryExpr([](double p) { return -std::sqrt(2.0) * boost::math::erfc_inv(2 * p); });
}

Column squared_normal_scores(const Copula& copula, const PointsRef& u) {
  require_open_unit_cube("squared_normal_scores", "u", u);
  Column sum = Column::Zero(u.rows());
  for (Index k = 1; k <= u.cols(); ++k) {
    // The smaller of both tails keeps its digits: q(p)^2 = q(1 - p)^2.
    const Column tail = copula.h(u.leftCols(k)).min(copula.h_upper(u.leftCols(k)));
    sum += tail.unaryExpr([](double p) { return 2 * std::pow(boost::math::erfc_inv(2 * p), 2); });
  }
  return sum;
}

double chi_square_quantile(double p, int degrees) {
  return 2 * boost::math::gamma_p_inv(degrees / 2.0, p);
}

}  // namespace sklar
