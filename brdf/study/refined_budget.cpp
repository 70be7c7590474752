#include "brdf/study/refined_budget.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "copula/study/timing.hpp"
#include "families/registry.hpp"

namespace sklar::brdf {
namespace {

/// The models of one fit, one a precision.
std::vector<FrontPoint> points_of(const MeasuredTable& table, const RefinedFit& fit, const std::string& family,
                                  double fit_s, const std::vector<int>& all_bits) {
  std::vector<FrontPoint> points;
  for (const int bits : all_bits) {
    FrontPoint& point = points.emplace_back(FrontPoint{.fit = with_bits(fit, bits), .family = family, .bits = bits});
    point.figures = figures_of(*point.fit.brdf, cell_errors(table, predict(*point.fit.brdf, table)));
    point.figures.fit_s = fit_s;
  }
  return points;
}

bool same_names(const std::vector<FamilyInfo>& a, const std::vector<FamilyInfo>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const FamilyInfo& x, const FamilyInfo& y) { return x.name == y.name; });
}

}  // namespace

const std::vector<RefinedStructure>& structure_ladder() {
  const auto rung = [](int components, int half, int difference, std::array<int, 2> colour,
                       std::array<int, 2> azimuth) {
    return RefinedStructure{.components = components,
                            .half = half,
                            .difference = difference,
                            .colour_half = colour[0],
                            .colour_difference = colour[1],
                            .azimuth = azimuth[0],
                            .azimuth_difference = azimuth[1]};
  };
  static const std::vector<RefinedStructure> kLadder = {
      rung(2, 12, 8, {4, 4}, {3, 5}),  rung(4, 12, 8, {4, 4}, {3, 5}),   rung(5, 16, 11, {4, 6}, {4, 6}),
      rung(6, 24, 14, {4, 6}, {4, 8}), rung(7, 32, 18, {5, 6}, {4, 10}), rung(8, 48, 24, {6, 8}, {4, 12})};
  return kLadder;
}

BudgetSearch usual_search() {
  BudgetSearch search{.families = {families::find("independence"), families::find("frank")}};
  search.colours = {{4, 4}, {8, 10}};
  search.substitutes = {search.families.front()};
  for (const FamilyInfo& family : families::all()) {
    if (family.parameters.size() != 1 || !family.theta_from_tau) continue;
    for (const char* rotation : {"", "@90", "@180", "@270"}) {
      search.substitutes.push_back(families::find(family.name + rotation));
    }
  }
  return search;
}

std::size_t stored_bytes(const RefinedStructure& structure, int bits, bool coupled) {
  const auto components = static_cast<std::size_t>(structure.components);
  const RefinedLayout layout(structure, std::vector<bool>(components, coupled));
  return refined_bytes(structure, layout, bits);
}

RefinedStructure largest_structure(double max_bytes, int bits) {
  const std::vector<RefinedStructure>& ladder = structure_ladder();
  require_bytes({.max_bytes = max_bytes}, stored_bytes(ladder.front(), bits, true));
  return *std::find_if(ladder.rbegin(), ladder.rend(), [&](const RefinedStructure& structure) {
    return static_cast<double>(stored_bytes(structure, bits, true)) <= max_bytes;
  });
}

namespace {

/// The fits of a search, structure by structure.
class Searcher {
 public:
  Searcher(const MeasuredTable& table, const Budget& budget, const BudgetSearch& search, RefinedFitOptions options,
           const std::function<void(const std::string&)>& progress)
      : table_(table), budget_(budget), search_(search), options_(std::move(options)), progress_(progress) {
    require_bytes(budget, smallest(structure_ladder().front()));
    for (const RefinedStructure& structure : structure_ladder()) {
      if (static_cast<double>(smallest(structure)) <= budget.max_bytes) structures_.push_back(structure);
    }
  }

  /// Returns whether a model of the structure meets the budget.
  bool fit(const RefinedStructure& structure) {
    const std::size_t before = points_.size();
    options_.structure = structure;
    RefinedFit last;
    for (const FamilyInfo& family : search_.families) last = fit_family(family);
    if (!search_.substitutes.empty()) fit_substitutes(last);
    fit_colours(structure, before);
    return std::any_of(points_.begin() + static_cast<std::ptrdiff_t>(before), points_.end(),
                       [&](const FrontPoint& point) { return meets(point.figures, budget_); });
  }

  [[nodiscard]] const std::vector<RefinedStructure>& structures() const { return structures_; }

  /// The best model by `less` of those that meet the budget.
  template <class Less>
  [[nodiscard]] BudgetChoice choice(const Less& less) {
    std::sort(points_.begin(), points_.end(), [](const FrontPoint& a, const FrontPoint& b) {
      return std::tie(a.figures.bytes, a.figures.log1p_mae) < std::tie(b.figures.bytes, b.figures.log1p_mae);
    });
    const FrontPoint* best = nullptr;
    for (const FrontPoint& point : points_) {
      if (meets(point.figures, budget_) && (best == nullptr || less(point.figures, best->figures))) best = &point;
    }
    if (best == nullptr) throw std::runtime_error(missed_budget(most_exact()));
    BudgetChoice result{};
    double least = std::numeric_limits<double>::infinity();
    for (const FrontPoint& point : points_) {
      if (&point != best && !(point.figures.log1p_mae < least)) continue;
      least = std::min(least, point.figures.log1p_mae);
      if (&point == best) result.chosen = result.front.size();
      result.front.push_back(point);
    }
    return result;
  }

 private:
  RefinedFit fit_family(const FamilyInfo& family) {
    options_.families = {family};
    say(family.name);
    const Stopwatch stopwatch;
    RefinedFit fit = fit_refined(table_, options_);
    keep(fit, family.name, stopwatch);
    return fit;
  }

  void fit_substitutes(const RefinedFit& last) {
    say("a family for each component");
    const Stopwatch stopwatch;
    options_.families = choose_families(table_, options_, last, search_.substitutes);
    if (same_names(options_.families, last.brdf->families())) return;
    keep(refit_refined(table_, options_, last), "mixed", stopwatch);
  }

  /// With the families of the most exact model of the structure, whose models begin at `first`.
  void fit_colours(const RefinedStructure& structure, std::size_t first) {
    const FrontPoint best =
        *std::min_element(points_.begin() + static_cast<std::ptrdiff_t>(first), points_.end(), more_exact);
    for (const auto& [half, difference] : search_.colours) {
      options_.structure = structure;
      options_.structure.colour_half = half;
      options_.structure.colour_difference = difference;
      if (options_.structure == structure || static_cast<double>(smallest(options_.structure)) > budget_.max_bytes)
        continue;
      options_.families = best.fit.brdf->families();
      say("colours of " + std::to_string(half) + " x " + std::to_string(difference));
      const Stopwatch stopwatch;
      keep(fit_refined(table_, options_), best.family, stopwatch);
    }
  }

  void keep(const RefinedFit& fit, const std::string& family, const Stopwatch& stopwatch) {
    for (FrontPoint& point : points_of(table_, fit, family, stopwatch.seconds(), search_.bits)) {
      points_.push_back(std::move(point));
    }
  }

  void say(const std::string& what) const {
    if (progress_) progress_(std::to_string(smallest(options_.structure)) + " bytes and more, " + what);
  }

  [[nodiscard]] std::size_t smallest(const RefinedStructure& structure) const {
    const bool coupled = std::all_of(search_.families.begin(), search_.families.end(),
                                     [](const FamilyInfo& family) { return !family.parameters.empty(); });
    return stored_bytes(structure, *std::min_element(search_.bits.begin(), search_.bits.end()), coupled);
  }
  [[nodiscard]] ModelFigures most_exact() const {
    return std::min_element(points_.begin(), points_.end(), more_exact)->figures;
  }
  static bool more_exact(const FrontPoint& a, const FrontPoint& b) { return a.figures.log1p_mae < b.figures.log1p_mae; }

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
  require_budget(budget, "choose_model");
  if (search.bits.empty()) throw std::invalid_argument("choose_model: no bits to try");
  if (search.families.empty()) throw std::invalid_argument("choose_model: no families to try");
  Searcher searcher(table, budget, search, std::move(options), progress);
  const std::vector<RefinedStructure>& structures = searcher.structures();
  if (budget.max_error > 0) {
    for (const RefinedStructure& structure : structures) {
      if (searcher.fit(structure)) break;
    }
    return searcher.choice([](const ModelFigures& a, const ModelFigures& b) { return a.bytes < b.bytes; });
  }
  bool found = false;
  for (std::size_t tried = 0; tried < structures.size() && !(found && tried >= 2); ++tried) {
    found = searcher.fit(structures[structures.size() - 1 - tried]) || found;
  }
  return searcher.choice([](const ModelFigures& a, const ModelFigures& b) { return a.log1p_mae < b.log1p_mae; });
}

BudgetChoice fit_largest(const MeasuredTable& table, double max_bytes, const BudgetSearch& search,
                         RefinedFitOptions options, const std::function<void(const std::string&)>& progress) {
  const int bits = search.bits.front();
  const FamilyInfo& family = search.families.front();
  options.families = {family};
  options.structure = largest_structure(max_bytes, bits);
  if (progress) progress(family.name);
  const Stopwatch stopwatch;
  const RefinedFit fit = fit_refined(table, options);
  return {.front = points_of(table, fit, family.name, stopwatch.seconds(), {bits}), .chosen = 0};
}

std::string to_markdown(const BudgetChoice& choice) {
  std::string text =
      "| components | theta_h x theta_d | colours | copula | bits | bytes | log1p_mae | logrel_mae | eval ns | fit s | "
      "|\n"
      "| ---: | ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n";
  for (std::size_t i = 0; i < choice.front.size(); ++i) {
    const FrontPoint& point = choice.front[i];
    const ModelFigures& figures = point.figures;
    const RefinedStructure& structure = point.fit.brdf->structure();
    char row[200];
    std::snprintf(row, sizeof row, "| %d | %d x %d | %d x %d | %s | %d | %zu | %.5f | %.4f | %.1f | %.1f | %s |\n",
                  structure.components, structure.half, structure.difference, structure.colour_half,
                  structure.colour_difference, point.family.c_str(), point.bits, figures.bytes, figures.log1p_mae,
                  figures.logrel_mae, figures.eval_ns, figures.fit_s, i == choice.chosen ? "chosen" : "");
    text += row;
  }
  return text;
}

}  // namespace sklar::brdf
