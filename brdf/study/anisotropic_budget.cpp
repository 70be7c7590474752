#include "brdf/study/anisotropic_budget.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <tuple>

#include "brdf/study/metrics.hpp"
#include "copula/study/timing.hpp"

namespace sklar::brdf {
namespace {

AnisotropicPoint fit_point(const AnisotropicTable& table, const AnisotropicFitOptions& options) {
  const Stopwatch stopwatch;
  AnisotropicPoint point{.fit = fit_anisotropic(table, options)};
  const double fit_s = stopwatch.seconds();
  point.figures = figures_of(*point.fit.brdf, cell_errors(table, *point.fit.brdf));
  point.figures.fit_s = fit_s;
  return point;
}

}  // namespace

const std::vector<AnisotropicStructure>& anisotropic_ladder() {
  static const std::vector<AnisotropicStructure> kLadder = [] {
    AnisotropicStructure shared{.half_harmonics = 1, .half_harmonics_degree = 2};
    const auto rung = [&](int components, std::array<int, 2> shape, std::array<int, 2> colour,
                          std::array<int, 2> azimuth, std::array<int, 2> masking) {
      AnisotropicStructure structure = shared;
      structure.components = components;
      std::tie(structure.half, structure.difference) = std::tie(shape[0], shape[1]);
      std::tie(structure.colour_half, structure.colour_difference) = std::tie(colour[0], colour[1]);
      std::tie(structure.azimuth, structure.azimuth_difference) = std::tie(azimuth[0], azimuth[1]);
      std::tie(structure.masking, structure.masking_harmonics) = std::tie(masking[0], masking[1]);
      return structure;
    };
    std::vector<AnisotropicStructure> ladder = {
        rung(2, {10, 5}, {1, 2}, {1, 1}, {3, 1}), rung(4, {10, 5}, {2, 3}, {1, 2}, {3, 2}),
        rung(6, {14, 7}, {2, 3}, {2, 3}, {4, 2}), rung(8, {18, 9}, {3, 4}, {2, 4}, {4, 2})};
    ladder.back().half_harmonics = 2;
    ladder.back().half_harmonics_degree = 3;
    return ladder;
  }();
  return kLadder;
}

AnisotropicChoice choose_anisotropic(const AnisotropicTable& table, const Budget& budget, AnisotropicFitOptions options,
                                     const std::function<void(const std::string&)>& progress) {
  require_budget(budget, "choose_anisotropic");
  std::vector<AnisotropicStructure> ladder = anisotropic_ladder();
  const bool tilted = !repeats_after_half_turn(table);
  for (AnisotropicStructure& structure : ladder) structure.tilted = tilted;
  const auto bytes = [&](const AnisotropicStructure& structure) { return anisotropic_bytes(structure, options.bits); };
  require_bytes(budget, bytes(ladder.front()));
  std::erase_if(ladder,
                [&](const auto& structure) { return static_cast<double>(bytes(structure)) > budget.max_bytes; });
  const bool smallest_first = budget.max_error > 0;
  if (!smallest_first) std::reverse(ladder.begin(), ladder.end());
  AnisotropicChoice choice{};
  for (const AnisotropicStructure& structure : ladder) {
    if (progress) progress(std::to_string(bytes(structure)) + " bytes");
    options.structure = structure;
    choice.front.push_back(fit_point(table, options));
    choice.chosen = choice.front.size() - 1;
    if (meets(choice.front.back().figures, budget)) return choice;
  }
  const auto better = [](const AnisotropicPoint& a, const AnisotropicPoint& b) {
    return a.figures.log1p_mae < b.figures.log1p_mae;
  };
  throw std::runtime_error(missed_budget(std::min_element(choice.front.begin(), choice.front.end(), better)->figures));
}

std::string to_markdown(const AnisotropicChoice& choice) {
  std::string text =
      "| components | half x difference | bytes | log1p_mae | logrel_mae | eval ns | fit s | |\n"
      "| ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n";
  for (std::size_t i = 0; i < choice.front.size(); ++i) {
    const AnisotropicPoint& point = choice.front[i];
    const ModelFigures& figures = point.figures;
    const AnisotropicStructure& structure = point.fit.brdf->structure();
    char row[160];
    std::snprintf(row, sizeof row, "| %d | %d x %d | %zu | %.5f | %.4f | %.1f | %.1f | %s |\n", structure.components,
                  structure.half, structure.difference, figures.bytes, figures.log1p_mae, figures.logrel_mae,
                  figures.eval_ns, figures.fit_s, i == choice.chosen ? "chosen" : "");
    text += row;
  }
  return text;
}

}  // namespace sklar::brdf
