#include "brdf/analytic/synthetic.hpp"

#include <cmath>
#include <numbers>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/data/tabulate.hpp"
#include "copula/random.hpp"

namespace sklar::brdf {
namespace {

constexpr double kScatter = 0.02;
constexpr Rng::result_type kSeed = 1;

/// Box and Muller 1958: the same numbers from one seed with every standard library.
double standard_normal(Rng& rng) {
  const double radius = std::sqrt(-2 * std::log(uniform(rng)));
  return radius * std::cos(2 * std::numbers::pi * uniform(rng));
}

}  // namespace

MeasuredTable builtin_material() {
  MeasuredTable table = tabulate(Lambert({0.06, 0.14, 0.30}), "synthetic", Provenance::synthetic);
  const MeasuredTable gloss = tabulate(Ggx({0.05, 0.05, 0.05}, 0.25), "gloss", Provenance::synthetic);
  Rng rng(kSeed);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t cell = 0; cell < Grid::cells; ++cell) {
      if (!table.valid[cell]) continue;
      double& value = table.values[channel][cell];
      value = (value + gloss.values[channel][cell]) * std::exp(kScatter * standard_normal(rng));
    }
  }
  table.report.mirror_asymmetry = mirror_asymmetry(table);
  return table;
}

}  // namespace sklar::brdf
