// One question, answered with each accuracy that the library offers, and by the formula of a textbook.

#include <cmath>
#include <cstdio>

#include "copula/symbolic/formula_family.hpp"
#include "families/registry.hpp"

/// Nelsen (2006), eq. 4.2.1, differentiated, d = 2.
double textbook(double u, double v, double theta) {
  const double sum = std::pow(u, -theta) + std::pow(v, -theta) - 1;
  return std::log(1 + theta) - (1 + theta) * std::log(u * v) - (2 + 1 / theta) * std::log(sum);
}

int main() {
  using namespace sklar;
  const double theta = 20;
  const FamilyInfo& family = families::find("clayton");
  const CopulaPtr copula = family.make(2, {theta});
  Points u(2, 2);
  u << 0.3, 0.31,    //
      1e-16, 2e-16;  // far in the tail

  const Column fast = copula->log_pdf(u, Accuracy::fast);
  const Column standard = copula->log_pdf(u);
  const Column symbolic = symbolic::formula_of(family).make(2, {theta})->log_pdf(u);
  const std::vector<BigFloat> exact = copula->exact(Quantity::log_pdf, u, 30);
  for (Index i = 0; i < u.rows(); ++i) {
    std::printf("textbook  %.17g\n", textbook(u(i, 0), u(i, 1), theta));
    std::printf("fast      %.5g\n", fast(i));
    std::printf("standard  %.17g\n", standard(i));
    std::printf("symbolic  %.17g\n", symbolic(i));
    std::printf("exact     %s\n\n", to_text(exact[static_cast<std::size_t>(i)], 30).c_str());
  }
}
