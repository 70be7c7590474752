/// Losses and expenses of 1500 insurance claims, some losses capped, by full maximum likelihood: Pareto margins and a
/// copula at once, beside published estimates. docs/worked_example.md explains it. Fails where a published number that
/// can be had is not.

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "copula/inference/csv.hpp"
#include "copula/inference/information.hpp"
#include "copula/inference/minimise.hpp"
#include "families/registry.hpp"

namespace {

using namespace sklar;

/// lambda_1, theta_1, lambda_2, theta_2 of the margins F(x) = 1 - (lambda / (lambda + x))^theta, and alpha of the
/// copula.
using Parameters = std::vector<double>;

/// As printed, with alpha of Frank's copula in our sign. The course notes of B. Avanzi, University of Melbourne, 2022,
/// module "copulas", the comments of its page: github.com/UniMelb-Actuarial/ACTL20004-ACTL90021-2024.
struct Published {
  const char* family;
  Parameters estimates, errors;
  double log_likelihood, aic;  ///< aic a row
};

const std::array<Published, 3> kPublished{{
    {"independence", {14552, 1.139, 15210, 2.231}, {1404, 0.067, 1661, 0.178}, -31950.81, 42.61},
    {"gumbel", {14001, 1.120, 14122, 2.108, 1.454}, {1292, 0.062, 1409, 0.151, 0.034}, -31748.81, 42.34},
    {"frank", {14323, 1.106, 16306, 2.274, 3.162}, {1359, 0.064, 1762, 0.181, 0.175}, -31778.45, 42.38},
}};

/// Half a unit of the last printed digit; errors of lambda move by two units with the rounding of theta.
constexpr double kHalfCent = 0.0051;
constexpr std::array<double, 5> kErrorDigits{2.0, 0.0006, 2.0, 0.0006, 0.0006};

/// Means and standard deviations of the same page, of all losses, all expenses, and the losses that are not capped.
constexpr std::array<double, 6> kPublishedMoments{41208, 102748, 12588, 28146, 37110, 92513};

struct Claims {
  Points open;    ///< loss and expense
  Points capped;  ///< the loss is at least this
};

Claims read_claims(const std::string& folder) {
  const Points all = read_csv(folder + "/loss_alae.csv").values;
  const Column capped_rows = read_csv(folder + "/loss_alae_capped.csv").values.col(0);
  std::vector<Index> open, capped;
  for (Index row = 0; row < all.rows(); ++row) {
    ((capped_rows == static_cast<double>(row + 1)).any() ? capped : open).push_back(row);
  }
  return {all(open, Eigen::all), all(capped, Eigen::all)};
}

/// @return whether the data are those that were described.
bool describe(const Claims& claims) {
  const auto all = [&](Index column) {
    Column values(claims.open.rows() + claims.capped.rows());
    values << claims.open.col(column), claims.capped.col(column);
    return values;
  };
  const std::array<Column, 3> columns{all(0), all(1), claims.open.col(0)};
  constexpr std::array<const char*, 3> kNames{"loss", "expense", "loss, not capped"};
  std::printf("%-16s %5s %7s %10s %7s %10s\n", "US dollars", "rows", "mean", "published", "s.d.", "published");
  bool same = true;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto n = static_cast<double>(columns[i].size());
    const double mean = columns[i].mean();
    const double deviation = std::sqrt((columns[i] - mean).square().sum() / (n - 1));
    const double mean_there = kPublishedMoments[2 * i], deviation_there = kPublishedMoments[2 * i + 1];
    std::printf("%-16s %5.0f %7.0f %10.0f %7.0f %10.0f\n", kNames[i], n, mean, mean_there, deviation, deviation_there);
    same = same && std::round(mean) == mean_there && std::round(deviation) == deviation_there;
  }
  return same;
}

/// log(lambda / (lambda + x)).
Column log_share(const Column& x, double lambda) {
  return -(x / lambda).log1p();
}

Column pareto_log_pdf(const Column& x, double lambda, double theta) {
  return std::log(theta / lambda) + (theta + 1) * log_share(x, lambda);
}

Column pareto_cdf(const Column& x, double lambda, double theta) {
  return -(theta * log_share(x, lambda)).expm1();
}

/// A claim counts f1 f2 c(F1, F2); one with a capped loss f2 P(U1 > F1 | U2 = F2).
double log_likelihood(const FamilyInfo& family, const Claims& claims, const Parameters& p) {
  const CopulaPtr copula = family.make(2, {p.begin() + 4, p.end()});
  const auto uniforms = [&](const Points& x, Index first) {
    Points u(x.rows(), 2);
    u.col(first) = pareto_cdf(x.col(0), p[0], p[1]);
    u.col(1 - first) = pareto_cdf(x.col(1), p[2], p[3]);
    return u;
  };
  const double open = (pareto_log_pdf(claims.open.col(0), p[0], p[1]) + pareto_log_pdf(claims.open.col(1), p[2], p[3]) +
                       copula->log_pdf(uniforms(claims.open, 0)))
                          .sum();
  const Points given_expense = uniforms(claims.capped, 1);
  return open + (pareto_log_pdf(claims.capped.col(1), p[2], p[3]) + copula->h_upper(given_expense).log()).sum();
}

std::vector<double> errors_at(const FamilyInfo& family, const Claims& claims, const Parameters& p) {
  constexpr double kStep = 1e-4;  // of a parameter
  const Score score = [&](const Theta& at) {
    std::vector<double> slope;
    for (std::size_t i = 0; i < at.size(); ++i) {
      Parameters high = at, low = at;
      high[i] *= 1 + kStep;
      low[i] *= 1 - kStep;
      slope.push_back((log_likelihood(family, claims, high) - log_likelihood(family, claims, low)) /
                      (high[i] - low[i]));
    }
    return slope;
  };
  std::vector<double> step;
  for (const double value : p) step.push_back(1e-3 * value);
  return standard_errors(score, p, std::vector<Interval>(p.size(), {0, INFINITY}), step);
}

/// Searches the logarithms of the parameters.
Parameters maximise(const FamilyInfo& family, const Claims& claims, const Parameters& start) {
  const auto parameters = [](const std::vector<double>& z) {
    Parameters p;
    for (const double value : z) p.push_back(std::exp(value));
    return p;
  };
  std::vector<double> z;
  for (const double value : start) z.push_back(std::log(value));
  Box box{std::vector<double>(z.size(), -3), std::vector<double>(z.size(), 15)};
  if (z.size() == 5) box.lower[4] = 0.01;  // above 1, where Gumbel's begins
  const Objective objective = [&](const std::vector<double>& at) {
    return Evaluation{-log_likelihood(family, claims, parameters(at)), 0};
  };
  return parameters(minimise(objective, z, box, {.step = 0.05, .tolerance = 1e-8, .max_evaluations = 5000}).z);
}

void print(const char* what, const Parameters& p) {
  std::printf("  %-22s", what);
  constexpr std::array<int, 5> kDigits{0, 3, 0, 3, 3};
  for (std::size_t i = 0; i < p.size(); ++i) std::printf(" %9.*f", kDigits[i], p[i]);
  std::printf("\n");
}

/// @return whether the published numbers that can be had are.
bool compare(const Published& published, const Claims& claims) {
  const FamilyInfo& family = families::find(published.family);
  const auto aic = [&](double value) {
    return (2 * static_cast<double>(published.estimates.size()) - 2 * value) / 1500;
  };
  const double there = log_likelihood(family, claims, published.estimates);
  const std::vector<double> errors_there = errors_at(family, claims, published.estimates);
  const Parameters best = maximise(family, claims, published.estimates);
  const double highest = log_likelihood(family, claims, best);
  std::printf("%s: log likelihood, aic a row\n", published.family);
  std::printf("  published    %10.2f %6.2f\n", published.log_likelihood, published.aic);
  std::printf("  ours, there  %10.2f %6.2f\n", there, aic(there));
  std::printf("  the maximum  %10.2f %6.2f\n", highest, aic(highest));
  std::printf("%s: lambda_1, theta_1, lambda_2, theta_2, alpha\n", published.family);
  print("published", published.estimates);
  print("the maximum", best);
  print("errors, published", published.errors);
  print("errors, ours, there", errors_there);
  print("errors at the maximum", errors_at(family, claims, best));
  bool same = std::abs(there - published.log_likelihood) < kHalfCent &&
              std::abs(aic(there) - published.aic) < kHalfCent && std::abs(aic(highest) - published.aic) < kHalfCent;
  for (std::size_t i = 0; i < best.size(); ++i) {
    same = same && std::abs(errors_there[i] - published.errors[i]) < kErrorDigits[i];
    same = same && std::abs(best[i] - published.estimates[i]) < 0.3 * published.errors[i];
  }
  return same && highest > there;
}

}  // namespace

int main() {
  const Claims claims = read_claims(SKLAR_EXAMPLE_DATA);
  bool same = describe(claims);
  for (const Published& published : kPublished) same = compare(published, claims) && same;
  return same ? 0 : 1;
}
