#include "brdf/analytic/synthetic.hpp"

#include <cmath>
#include <numbers>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/sum.hpp"
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

BrdfPtr brushed_metal() {
  const Rgb f0(0.80, 0.65, 0.42);
  return with_diffuse({0.05, 0.04, 0.03}, std::make_shared<const Ggx>(f0, 0.12, 0.40), f0);
}

AnisotropicTable builtin_anisotropic_material(const AnisotropicSynthetic& options) {
  constexpr const char* kFunction = "builtin_anisotropic_material";
  require_inside(kFunction, "scatter", {0, 1}, options.scatter);
  require_inside(kFunction, "masked_share", {.lowest = 0, .highest = 1, .highest_included = false},
                 options.masked_share);
  AnisotropicTable table =
      tabulate_anisotropic(*brushed_metal(), kAnisotropicSynthetic, Provenance::synthetic, options.grid);
  Rng rng(options.seed);
  for (std::size_t cell = 0; cell < table.valid.size(); ++cell) {
    if (!table.valid[cell]) continue;
    const bool masked = options.masked_share > 0 && uniform(rng) < options.masked_share;
    table.valid[cell] = masked ? 0 : 1;
    for (std::vector<float>& plane : table.values) {
      const double factor = std::exp(options.scatter * standard_normal(rng));
      plane[cell] = masked ? 0.0F : static_cast<float>(static_cast<double>(plane[cell]) * factor);
    }
  }
  table.report.isotropy_deviation = isotropy_deviation(table);
  return table;
}

}  // namespace sklar::brdf
