/// One experiment, run with several families: only the family handed to it changes.

#include <cstdio>

#include "copula/inference/dependence.hpp"
#include "copula/inference/fit.hpp"
#include "families/registry.hpp"

namespace {

using namespace sklar;

/// Losses of two portfolios in 2000 weeks: with heavier losses they move together more (the survival Clayton copula
/// and exponential margins). Each row is a week.
Points losses() {
  Rng rng(7);
  const Points u = families::find("clayton").make(2, {2.0})->sample(2000, rng);
  return -u.log();
}

/// Fits the family to the ranks, then asks how likely it is that both losses exceed their 99 % quantiles and, given
/// that one of them does just so, that the other does too.
void experiment(const FamilyInfo& family) {
  const FitResult fit = fit_maximum_likelihood(family, pseudo_observations(losses()));
  const CopulaPtr copula = family.make(2, fit.theta);
  const Points corner = Points::Constant(1, 2, 0.99);
  const double both = 1 - 2 * 0.99 + copula->cdf(corner)(0);
  const double other = copula->h_upper(corner)(0);
  std::printf("%-13s tau %5.3f  log-likelihood %7.1f  P(both) %.5f  P(other | one) %.4f\n", family.name.c_str(),
              fit.tau, fit.log_likelihood, both, other);
}

}  // namespace

int main() {
  for (const char* name : {"independence", "frank", "clayton", "gumbel"}) {
    experiment(families::find(name));  // the line that changes
  }
}
