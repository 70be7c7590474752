#include <iostream>

#include "families/registry.hpp"

int main() {
  using namespace sklar;
  const FamilyInfo& family = families::find("frank");
  const CopulaPtr copula = family.make(3, family.from_tau(3, 0.5));  // dimension 3, Kendall's tau 1/2

  Points u(2, 3);  // one point a row
  u << 0.1, 0.2, 0.3, 1e-300, 0.5, 0.999;
  std::cout << "log density  " << copula->log_pdf(u).transpose() << '\n';
  std::cout << "C(u)         " << copula->cdf(u).transpose() << '\n';
  std::cout << "P(U3 <= u3 | u1, u2)  " << copula->h(u).transpose() << '\n';

  Rng rng(1);
  const Points given = Points::Constant(1, 1, 0.9);  // U1 = 0.9, draw the others
  std::cout << copula->sample(3, rng, given) << '\n';
}
