#include "brdf/study/budget.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "brdf/study/compare.hpp"
#include "brdf/study/metrics.hpp"
#include "copula/error.hpp"
#include "families/registry.hpp"

namespace sklar::brdf {
namespace {

void require_positive(const char* name, double value) {
  if (!(value > 0)) {
    throw std::invalid_argument("choose_model: " + std::string(name) + " is " + sklar::to_text(value) +
                                ", it must be positive");
  }
}

/// The models of one fit, one a precision.
std::vector<FrontPoint> fit_points(const MeasuredTable& table, const RefinedFitOptions& options,
                                   const std::vector<int>& all_bits) {
  const auto start = std::chrono::steady_clock::now();
  FrontPoint point{.fit = fit_refined(table, options), .family = options.families.front().name};
  point.fit_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  point.eval_ns = evaluation_ns(*point.fit.brdf);
  std::vector<FrontPoint> points;
  for (const int bits : all_bits) {
    const RefinedBrdf& fitted = *point.fit.brdf;
    FrontPoint& next = points.emplace_back(point);
    next.bits = bits;
    next.fit.brdf = std::make_shared<RefinedBrdf>(
        fitted.structure(), fitted.families(),
        pack(fitted.layout(), fitted.structure().components, bits, point.fit.coefficients));
    const CellErrors errors = cell_errors(table, predict(*next.fit.brdf, table));
    next.bytes = next.fit.brdf->bytes();
    next.log1p_mae = errors.log1p_mae.mean();
    next.logrel_mae = errors.logrel_mae.mean();
  }
  return points;
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

RefinedStructure largest_structure(double max_bytes, int bits) {
  const std::vector<RefinedStructure>& ladder = structure_ladder();
  for (auto structure = ladder.rbegin(); structure != ladder.rend(); ++structure) {
    if (static_cast<double>(stored_bytes(*structure, bits, true)) <= max_bytes) return *structure;
  }
  throw std::runtime_error("no model has at most " + sklar::to_text(max_bytes) + " bytes; the smallest has " +
                           std::to_string(stored_bytes(ladder.front(), bits, true)));
}

namespace {

/// The fits of a search, structure by structure.
class Searcher {
 public:
  Searcher(const MeasuredTable& table, const Budget& budget, const BudgetSearch& search, RefinedFitOptions options,
           const std::function<void(const std::string&)>& progress)
      : table_(table), budget_(budget), search_(search), options_(std::move(options)), progress_(progress) {
    if (search_.families.empty()) search_.families = {families::find("independence"), families::find("frank")};
    for (const RefinedStructure& structure : structure_ladder()) {
      if (static_cast<double>(smallest(structure)) <= budget.max_bytes) structures_.push_back(structure);
    }
    if (structures_.empty()) {
      throw std::runtime_error("no model has at most " + sklar::to_text(budget.max_bytes) +
                               " bytes; the smallest has " + std::to_string(smallest(structure_ladder().front())));
    }
  }

  /// Returns whether a model of the structure meets the budget.
  bool fit(const RefinedStructure& structure) {
    options_.structure = structure;
    bool found = false;
    for (const FamilyInfo& family : search_.families) {
      options_.families = {family};
      if (progress_) progress_(std::to_string(smallest(structure)) + " bytes and more, " + family.name);
      for (FrontPoint& point : fit_points(table_, options_, search_.bits)) {
        found = found || meets(point);
        points_.push_back(std::move(point));
      }
    }
    return found;
  }

  [[nodiscard]] const std::vector<RefinedStructure>& structures() const { return structures_; }

  /// The best model by `less` of those that meet the budget.
  template <class Less>
  [[nodiscard]] BudgetChoice choice(const Less& less) {
    std::sort(points_.begin(), points_.end(), [](const FrontPoint& a, const FrontPoint& b) {
      return a.bytes != b.bytes ? a.bytes < b.bytes : a.log1p_mae < b.log1p_mae;
    });
    const FrontPoint* best = nullptr;
    for (const FrontPoint& point : points_) {
      if (meets(point) && (best == nullptr || less(point, *best))) best = &point;
    }
    if (best == nullptr) throw std::runtime_error("no model meets the budget; the most exact one has " + most_exact());
    BudgetChoice result{};
    double least = std::numeric_limits<double>::infinity();
    for (const FrontPoint& point : points_) {
      if (&point != best && !(point.log1p_mae < least)) continue;
      least = std::min(least, point.log1p_mae);
      if (&point == best) result.chosen = result.front.size();
      result.front.push_back(point);
    }
    return result;
  }

 private:
  [[nodiscard]] std::size_t smallest(const RefinedStructure& structure) const {
    const bool coupled = std::all_of(search_.families.begin(), search_.families.end(),
                                     [](const FamilyInfo& family) { return !family.parameters.empty(); });
    return stored_bytes(structure, *std::min_element(search_.bits.begin(), search_.bits.end()), coupled);
  }
  [[nodiscard]] bool meets(const FrontPoint& point) const {
    return static_cast<double>(point.bytes) <= budget_.max_bytes && point.eval_ns <= budget_.max_ns &&
           (budget_.max_error == 0 || point.log1p_mae <= budget_.max_error);
  }
  [[nodiscard]] std::string most_exact() const {
    return figures(*std::min_element(points_.begin(), points_.end(), [](const FrontPoint& a, const FrontPoint& b) {
      return a.log1p_mae < b.log1p_mae;
    }));
  }

  const MeasuredTable& table_;
  Budget budget_;
  BudgetSearch search_;
  RefinedFitOptions options_;
  const std::function<void(const std::string&)>& progress_;
  std::vector<RefinedStructure> structures_;
  std::vector<FrontPoint> points_;
};

}  // namespace

BudgetChoice choose_model(const MeasuredTable& table, const Budget& budget, const BudgetSearch& search,
                          RefinedFitOptions options, const std::function<void(const std::string&)>& progress) {
  require_positive("max_bytes", budget.max_bytes);
  require_positive("max_ns", budget.max_ns);
  if (budget.max_error != 0) require_positive("max_error", budget.max_error);
  if (search.bits.empty()) throw std::invalid_argument("choose_model: no bits to try");
  Searcher searcher(table, budget, search, std::move(options), progress);
  const std::vector<RefinedStructure>& structures = searcher.structures();
  if (budget.max_error > 0) {
    for (const RefinedStructure& structure : structures) {
      if (searcher.fit(structure)) break;
    }
    return searcher.choice([](const FrontPoint& a, const FrontPoint& b) { return a.bytes < b.bytes; });
  }
  bool found = false;
  for (std::size_t tried = 0; tried < structures.size() && !(found && tried >= 2); ++tried) {
    found = searcher.fit(structures[structures.size() - 1 - tried]) || found;
  }
  return searcher.choice([](const FrontPoint& a, const FrontPoint& b) { return a.log1p_mae < b.log1p_mae; });
}

BudgetChoice fit_largest(const MeasuredTable& table, double max_bytes, const BudgetSearch& search,
                         RefinedFitOptions options, const std::function<void(const std::string&)>& progress) {
  const int bits = search.bits.front();
  const FamilyInfo& family = search.families.front();
  options.families = {family};
  options.structure = largest_structure(max_bytes, bits);
  if (progress) progress(family.name);
  return {.front = fit_points(table, options, {bits}), .chosen = 0};
}

std::string to_markdown(const BudgetChoice& choice) {
  std::string text =
      "| components | theta_h x theta_d | copula | bits | bytes | log1p_mae | logrel_mae | eval ns | fit s | |\n"
      "| ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n";
  for (std::size_t i = 0; i < choice.front.size(); ++i) {
    const FrontPoint& point = choice.front[i];
    const RefinedStructure& structure = point.fit.brdf->structure();
    char row[200];
    std::snprintf(row, sizeof row, "| %d | %d x %d | %s | %d | %zu | %.5f | %.4f | %.1f | %.1f | %s |\n",
                  structure.components, structure.half, structure.difference, point.family.c_str(), point.bits,
                  point.bytes, point.log1p_mae, point.logrel_mae, point.eval_ns, point.fit_s,
                  i == choice.chosen ? "chosen" : "");
    text += row;
  }
  return text;
}

}  // namespace sklar::brdf
