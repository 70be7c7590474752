#include "brdf/study/anisotropic_budget.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>

#include "brdf/study/compare.hpp"
#include "brdf/study/metrics.hpp"
#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

void require_positive(const char* name, double value) {
  if (!(value > 0)) {
    throw std::invalid_argument("choose_anisotropic: " + std::string(name) + " is " + sklar::to_text(value) +
                                ", it must be positive");
  }
}

AnisotropicPoint fit_point(const AnisotropicTable& table, const AnisotropicFitOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  AnisotropicPoint point{.fit = fit_anisotropic(table, options)};
  point.fit_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const CellErrors errors = cell_errors(table, *point.fit.brdf);
  point.bytes = point.fit.brdf->bytes();
  point.log1p_mae = errors.log1p_mae.mean();
  point.logrel_mae = errors.logrel_mae.mean();
  point.eval_ns = evaluation_ns(*point.fit.brdf);
  return point;
}

std::string figures(const AnisotropicPoint& point) {
  char text[128];
  std::snprintf(text, sizeof text, "%zu bytes, log1p_mae %.5f, %.1f ns", point.bytes, point.log1p_mae, point.eval_ns);
  return text;
}

}  // namespace

const std::vector<AnisotropicStructure>& anisotropic_ladder() {
  static const std::vector<AnisotropicStructure> kLadder = {{.components = 2,
                                                             .half = 10,
                                                             .difference = 5,
                                                             .colour_half = 1,
                                                             .colour_difference = 2,
                                                             .azimuth = 1,
                                                             .azimuth_difference = 1,
                                                             .masking = 3,
                                                             .masking_harmonics = 1,
                                                             .half_harmonics = 1,
                                                             .half_harmonics_degree = 2},
                                                            {.components = 4,
                                                             .half = 10,
                                                             .difference = 5,
                                                             .colour_half = 2,
                                                             .colour_difference = 3,
                                                             .azimuth = 1,
                                                             .azimuth_difference = 2,
                                                             .masking = 3,
                                                             .masking_harmonics = 2,
                                                             .half_harmonics = 1,
                                                             .half_harmonics_degree = 2},
                                                            {.components = 6,
                                                             .half = 14,
                                                             .difference = 7,
                                                             .colour_half = 2,
                                                             .colour_difference = 3,
                                                             .azimuth = 2,
                                                             .azimuth_difference = 3,
                                                             .masking = 4,
                                                             .masking_harmonics = 2,
                                                             .half_harmonics = 1,
                                                             .half_harmonics_degree = 2},
                                                            {.components = 8,
                                                             .half = 18,
                                                             .difference = 9,
                                                             .colour_half = 3,
                                                             .colour_difference = 4,
                                                             .azimuth = 2,
                                                             .azimuth_difference = 4,
                                                             .masking = 4,
                                                             .masking_harmonics = 2,
                                                             .half_harmonics = 2,
                                                             .half_harmonics_degree = 3}};
  return kLadder;
}

AnisotropicChoice choose_anisotropic(const AnisotropicTable& table, const Budget& budget, AnisotropicFitOptions options,
                                     const std::function<void(const std::string&)>& progress) {
  require_positive("max_bytes", budget.max_bytes);
  require_positive("max_ns", budget.max_ns);
  if (budget.max_error != 0) require_positive("max_error", budget.max_error);
  std::vector<AnisotropicStructure> ladder = anisotropic_ladder();
  const bool tilted = !repeats_after_half_turn(table);
  for (AnisotropicStructure& structure : ladder) structure.tilted = tilted;
  const auto bytes = [&](const AnisotropicStructure& structure) { return anisotropic_bytes(structure, options.bits); };
  const std::size_t smallest = bytes(ladder.front());
  std::erase_if(ladder,
                [&](const auto& structure) { return static_cast<double>(bytes(structure)) > budget.max_bytes; });
  if (ladder.empty()) {
    throw std::runtime_error("no model has at most " + sklar::to_text(budget.max_bytes) + " bytes; the smallest has " +
                             std::to_string(smallest));
  }
  const bool smallest_first = budget.max_error > 0;
  if (!smallest_first) std::reverse(ladder.begin(), ladder.end());
  AnisotropicChoice choice{};
  for (const AnisotropicStructure& structure : ladder) {
    if (progress) progress(std::to_string(bytes(structure)) + " bytes");
    options.structure = structure;
    choice.front.push_back(fit_point(table, options));
    const AnisotropicPoint& point = choice.front.back();
    choice.chosen = choice.front.size() - 1;
    if (point.eval_ns <= budget.max_ns && (!smallest_first || point.log1p_mae <= budget.max_error)) return choice;
  }
  const auto better = [](const AnisotropicPoint& a, const AnisotropicPoint& b) { return a.log1p_mae < b.log1p_mae; };
  throw std::runtime_error("no model meets the budget; the most exact one has " +
                           figures(*std::min_element(choice.front.begin(), choice.front.end(), better)));
}

std::string to_markdown(const AnisotropicChoice& choice) {
  std::string text =
      "| components | half x difference | bytes | log1p_mae | logrel_mae | eval ns | fit s | |\n"
      "| ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n";
  for (std::size_t i = 0; i < choice.front.size(); ++i) {
    const AnisotropicPoint& point = choice.front[i];
    const AnisotropicStructure& structure = point.fit.brdf->structure();
    char row[160];
    std::snprintf(row, sizeof row, "| %d | %d x %d | %zu | %.5f | %.4f | %.1f | %.1f | %s |\n", structure.components,
                  structure.half, structure.difference, point.bytes, point.log1p_mae, point.logrel_mae, point.eval_ns,
                  point.fit_s, i == choice.chosen ? "chosen" : "");
    text += row;
  }
  return text;
}

}  // namespace sklar::brdf
