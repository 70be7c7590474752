#include "brdf/study/model_tradeoff.hpp"

#include <algorithm>
#include <stdexcept>

#include "brdf/model/paper_fit.hpp"
#include "brdf/study/evaluation_time.hpp"
#include "brdf/study/metrics.hpp"
#include "copula/study/timing.hpp"

namespace sklar::brdf {
namespace {

/// Fills the row with the figures of what fit() returns, or with why it has none.
template <class Fit>
void measure(ModelTradeoffRow& row, const MeasuredTable& table, const Fit& fit) {
  const Stopwatch stopwatch;
  BrdfPtr brdf;
  try {
    brdf = fit();
  } catch (const std::runtime_error& error) {
    row.error = error.what();
    return;
  }
  row.fit_s = stopwatch.seconds();
  row.bytes = brdf->bytes();
  row.batch_ns = evaluation_ns(*brdf);
  row.single_ns = single_evaluation_ns(*brdf);
  const CellErrors errors = cell_errors(table, predict(*brdf, table));
  row.log1p_mae = errors.log1p_mae.mean();
  row.logrel_mae = errors.logrel_mae.mean();
}

/// Whether no other row is better in one of error and cost and as good in the other.
template <class Cost>
bool is_best(std::span<const ModelTradeoffRow> rows, const ModelTradeoffRow& row, const Cost& cost) {
  const auto beats = [&](const ModelTradeoffRow& other) {
    if (!other.error.empty() || cost(other) > cost(row) || other.log1p_mae > row.log1p_mae) return false;
    return cost(other) < cost(row) || other.log1p_mae < row.log1p_mae;
  };
  return row.error.empty() && std::none_of(rows.begin(), rows.end(), beats);
}

std::string text_of(const RefinedStructure& structure) {
  return std::to_string(structure.components) + " x " + std::to_string(structure.half) + " x " +
         std::to_string(structure.difference);
}

}  // namespace

std::vector<ModelTradeoffRow> measure_model_tradeoff(const MeasuredTable& table,
                                                     std::span<const FamilyInfo* const> families,
                                                     const ModelTradeoffOptions& options,
                                                     const std::function<void(const std::string&)>& progress) {
  std::vector<ModelTradeoffRow> rows;
  const auto add = [&](const char* mode, const FamilyInfo& family, const std::string& structure, const auto& fit) {
    if (progress) progress(std::string(mode) + ", " + family.name + ", " + structure);
    measure(rows.emplace_back(ModelTradeoffRow{.mode = mode, .family = family.name, .structure = structure}), table,
            fit);
  };
  for (const FamilyInfo* family : families) {
    for (const int slices : options.slices) {
      add("paper", *family, std::to_string(slices) + (slices == 1 ? " slice" : " slices"),
          [&] { return fit_paper(table, *family, {.slices = slices}).brdf; });
    }
  }
  for (const FamilyInfo* family : families) {
    for (const RefinedStructure& structure : options.ladder) {
      RefinedFitOptions refined = options.refined;
      refined.structure = structure;
      refined.families = {*family};
      add("refined", *family, text_of(structure), [&] { return fit_refined(table, refined).brdf; });
    }
  }
  mark_best(rows);
  return rows;
}

void mark_best(std::span<ModelTradeoffRow> rows) {
  for (ModelTradeoffRow& row : rows) {
    row.best_for_bytes = is_best(rows, row, [](const auto& x) { return static_cast<double>(x.bytes); });
    row.best_for_ns = is_best(rows, row, [](const auto& x) { return x.batch_ns; });
  }
}

}  // namespace sklar::brdf
