// A family of one's own in C++: its copula beside the one made of nothing but the text of psi, then a fit.

#include <cstdio>

#include "copula/inference/fit.hpp"
#include "copula/symbolic/formula_family.hpp"
#include "examples/families/half_tail.hpp"

int main() {
  using namespace sklar;
  const FamilyInfo family = families::half_tail::info();
  const CopulaPtr copula = family.make(3, {0.7});

  Rng rng(1);
  const Points u = copula->sample(2000, rng);
  const FamilyInfo formula = symbolic::formula_of(family);
  const double difference = (copula->log_pdf(u) - formula.make(3, {0.7})->log_pdf(u)).abs().maxCoeff();
  std::printf("log density as by the formula, to 1e-13: %s\n", difference < 1e-13 ? "yes" : "no");
  std::printf("tau of theta = 0.7: %.9f, by the formula %.9f\n", family.tau({0.7}), formula.tau({0.7}));

  const FitResult fit = fit_maximum_likelihood(family, u);
  std::printf("fitted to 2000 points: theta %.3f +- %.3f\n", fit.theta[0], fit.standard_error[0]);
}
