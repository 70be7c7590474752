#include "brdf/study/budget.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "brdf/study/evaluation_time.hpp"
#include "copula/error.hpp"

namespace sklar::brdf {

bool Budget::limits() const {
  return max_error != 0 || !std::isinf(max_bytes) || !std::isinf(max_ns);
}

void require_budget(const Budget& budget, const std::string& caller) {
  const auto require_positive = [&](const char* name, double value) {
    if (value > 0) return;
    throw std::invalid_argument(caller + ": " + name + " is " + sklar::to_text(value) + ", it must be positive");
  };
  require_positive("max_bytes", budget.max_bytes);
  require_positive("max_ns", budget.max_ns);
  if (budget.max_error != 0) require_positive("max_error", budget.max_error);
}

void require_bytes(const Budget& budget, std::size_t smallest) {
  if (static_cast<double>(smallest) <= budget.max_bytes) return;
  throw std::runtime_error("no model has at most " + sklar::to_text(budget.max_bytes) + " bytes; the smallest has " +
                           std::to_string(smallest));
}

ModelFigures figures_of(const Brdf& brdf, const CellErrors& errors) {
  return {.bytes = brdf.bytes(),
          .log1p_mae = errors.log1p_mae.mean(),
          .logrel_mae = errors.logrel_mae.mean(),
          .eval_ns = evaluation_ns(brdf)};
}

bool meets(const ModelFigures& figures, const Budget& budget) {
  return static_cast<double>(figures.bytes) <= budget.max_bytes && figures.eval_ns <= budget.max_ns &&
         (budget.max_error == 0 || figures.log1p_mae <= budget.max_error);
}

std::string missed_budget(const ModelFigures& most_exact) {
  char text[160];
  std::snprintf(text, sizeof text,
                "no model meets the budget; the most exact one has %zu bytes, log1p_mae %.5f, %.1f ns",
                most_exact.bytes, most_exact.log1p_mae, most_exact.eval_ns);
  return text;
}

}  // namespace sklar::brdf
