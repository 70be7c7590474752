#include "brdf/study/budget.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "brdf/study/compare.hpp"
#include "brdf/study/metrics.hpp"
#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

void require_positive(const char* name, double value) {
  if (!(value > 0)) {
    throw std::invalid_argument("choose_model: " + std::string(name) + " is " + sklar::to_text(value) +
                                ", it must be positive");
  }
}

FrontPoint fit_point(const MeasuredTable& table, const RefinedFitOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  FrontPoint point{.structure = options.structure, .fit = fit_refined(table, options)};
  point.fit_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const CellErrors errors = cell_errors(table, predict(*point.fit.brdf, table));
  point.bytes = point.fit.brdf->bytes();
  point.log1p_mae = errors.log1p_mae.mean();
  point.logrel_mae = errors.logrel_mae.mean();
  point.eval_ns = evaluation_ns(*point.fit.brdf);
  return point;
}

std::string figures(const FrontPoint& point) {
  char text[128];
  std::snprintf(text, sizeof text, "%zu bytes, log1p_mae %.5f, %.1f ns", point.bytes, point.log1p_mae, point.eval_ns);
  return text;
}

}  // namespace

const std::vector<RefinedStructure>& structure_ladder() {
  static const std::vector<RefinedStructure> kLadder = {{.components = 2,
                                                         .half = 12,
                                                         .difference = 8,
                                                         .colour_half = 4,
                                                         .colour_difference = 4,
                                                         .azimuth = 3,
                                                         .azimuth_difference = 5},
                                                        {.components = 4,
                                                         .half = 12,
                                                         .difference = 8,
                                                         .colour_half = 4,
                                                         .colour_difference = 4,
                                                         .azimuth = 3,
                                                         .azimuth_difference = 5},
                                                        {.components = 5,
                                                         .half = 16,
                                                         .difference = 11,
                                                         .colour_half = 4,
                                                         .colour_difference = 6,
                                                         .azimuth = 4,
                                                         .azimuth_difference = 6},
                                                        {.components = 6,
                                                         .half = 24,
                                                         .difference = 14,
                                                         .colour_half = 4,
                                                         .colour_difference = 6,
                                                         .azimuth = 4,
                                                         .azimuth_difference = 8},
                                                        {.components = 7,
                                                         .half = 32,
                                                         .difference = 18,
                                                         .colour_half = 5,
                                                         .colour_difference = 6,
                                                         .azimuth = 4,
                                                         .azimuth_difference = 10},
                                                        {.components = 8,
                                                         .half = 48,
                                                         .difference = 24,
                                                         .colour_half = 6,
                                                         .colour_difference = 8,
                                                         .azimuth = 4,
                                                         .azimuth_difference = 12}};
  return kLadder;
}

std::size_t stored_bytes(const RefinedStructure& structure, int bits, bool coupled) {
  const auto components = static_cast<std::size_t>(structure.components);
  const RefinedLayout layout(structure, std::vector<bool>(components, coupled));
  return refined_bytes(components, bits, static_cast<std::size_t>(layout.size()));
}

namespace {

std::vector<RefinedStructure>::const_iterator end_of_ladder(double max_bytes, int bits, bool coupled) {
  const std::vector<RefinedStructure>& ladder = structure_ladder();
  const auto end = std::find_if(ladder.begin(), ladder.end(), [&](const RefinedStructure& structure) {
    return static_cast<double>(stored_bytes(structure, bits, coupled)) > max_bytes;
  });
  if (end != ladder.begin()) return end;
  throw std::runtime_error("no model has at most " + sklar::to_text(max_bytes) + " bytes; the smallest has " +
                           std::to_string(stored_bytes(ladder.front(), bits, coupled)));
}

}  // namespace

RefinedStructure largest_structure(double max_bytes, int bits) {
  return *std::prev(end_of_ladder(max_bytes, bits, true));
}

BudgetChoice choose_model(const MeasuredTable& table, const Budget& budget, RefinedFitOptions options,
                          const std::function<void(const std::string&)>& progress) {
  require_positive("max_bytes", budget.max_bytes);
  require_positive("max_ns", budget.max_ns);
  if (budget.max_error != 0) require_positive("max_error", budget.max_error);
  const bool coupled = std::any_of(options.families.begin(), options.families.end(),
                                   [](const FamilyInfo& family) { return !family.parameters.empty(); });
  const std::vector<RefinedStructure>& ladder = structure_ladder();
  const auto end = end_of_ladder(budget.max_bytes, options.bits, coupled);
  BudgetChoice choice{};
  const auto fit = [&](const RefinedStructure& structure) {
    options.structure = structure;
    if (progress) progress(std::to_string(stored_bytes(structure, options.bits, coupled)) + " bytes");
    choice.front.push_back(fit_point(table, options));
    const FrontPoint& point = choice.front.back();
    return point.log1p_mae <= budget.max_error && point.eval_ns <= budget.max_ns;
  };
  if (budget.max_error > 0) {
    for (auto structure = ladder.begin(); structure != end; ++structure) {
      if (!fit(*structure)) continue;
      choice.chosen = choice.front.size() - 1;
      return choice;
    }
  } else {
    for (auto structure = end; structure != ladder.begin();) {
      fit(*--structure);
      if (choice.front.back().eval_ns <= budget.max_ns) {
        choice.chosen = choice.front.size() - 1;
        return choice;
      }
    }
  }
  const auto better = [](const FrontPoint& a, const FrontPoint& b) { return a.log1p_mae < b.log1p_mae; };
  throw std::runtime_error("no model meets the budget; the most exact one has " +
                           figures(*std::min_element(choice.front.begin(), choice.front.end(), better)));
}

std::string to_markdown(const BudgetChoice& choice) {
  std::string text =
      "| components | theta_h x theta_d | bytes | log1p_mae | logrel_mae | eval ns | fit s | |\n"
      "| ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n";
  for (std::size_t i = 0; i < choice.front.size(); ++i) {
    const FrontPoint& point = choice.front[i];
    char row[160];
    std::snprintf(row, sizeof row, "| %d | %d x %d | %zu | %.5f | %.4f | %.1f | %.1f | %s |\n",
                  point.structure.components, point.structure.half, point.structure.difference, point.bytes,
                  point.log1p_mae, point.logrel_mae, point.eval_ns, point.fit_s, i == choice.chosen ? "chosen" : "");
    text += row;
  }
  return text;
}

}  // namespace sklar::brdf
