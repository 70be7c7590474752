#include "brdf/model/anisotropic_fit.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include "brdf/model/anisotropic_problem.hpp"
#include "brdf/model/staged_search.hpp"

namespace sklar::brdf {

bool repeats_after_half_turn(const AnisotropicTable& table) {
  const AnisotropicGrid& grid = table.grid;
  if (grid.turns % 2 == 0) return true;
  if (grid.phi_h % (2 * grid.turns) != 0 || (grid.mirrored && grid.phi_h % (4 * grid.turns) != 0)) return false;
  return deviation(table, 2 * grid.turns, grid.mirrored) <= kSymmetricDeviation;
}

AnisotropicFit fit_anisotropic(const AnisotropicTable& table, const AnisotropicFitOptions& options,
                               const Progress& progress) {
  require_structure(options.structure);
  require_bits("anisotropic model", options.bits);
  if (options.evaluations < 1) throw std::invalid_argument("fit_anisotropic: evaluations must be at least 1");
  if (options.samples < 1) throw std::invalid_argument("fit_anisotropic: samples must be at least 1");
  AnisotropicCells cells = anisotropic_cells(table, options.structure, options.measure, options.samples);
  const double log_scale = std::log(cells.scale);
  const AnisotropicProblem problem(options.structure, std::move(cells));
  std::vector<double> x = problem.start();
  const StagedSearch search = search_in_stages(staged(problem), options.objective, options.evaluations, progress, x);
  const AnisotropicLayout& layout = problem.layout();
  for (int k = 0; k < options.structure.components; ++k) {  // the weights of a spline sum to 1
    const auto first = x.begin() + layout.first(k, AnisotropicPart::shape);
    for (int i = 0; i < layout.count(AnisotropicPart::shape); ++i) first[i] -= log_scale;
  }
  return {.brdf = std::make_shared<AnisotropicModel>(options.structure, pack(layout, options.bits, x)),
          .start = search.start,
          .objective = search.objective,
          .evaluations = search.evaluations,
          .converged = search.converged};
}

}  // namespace sklar::brdf
