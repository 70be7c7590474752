#include "brdf/study/contender.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "brdf/analytic/analytic_fit.hpp"
#include "brdf/analytic/registry.hpp"
#include "brdf/basis/registry.hpp"
#include "brdf/model/paper_fit.hpp"
#include "brdf/sampling/sampled_brdf.hpp"
#include "brdf/study/refined_budget.hpp"
#include "copula/error.hpp"
#include "families/registry.hpp"

namespace sklar::brdf {
namespace {

constexpr const char* kFamily = "frank";

template <class Model>
ContenderFit sampled(const std::shared_ptr<const Model>& model, std::string note) {
  return {std::make_shared<const SampledBrdf>(model), model->bytes(), std::move(note), model};
}

Contender refined(double max_bytes) {
  return {.model = "refined",
          .kind = "copula",
          .title = "refined copula model",
          .source = "this library, docs/refined.md",
          .max_bytes = max_bytes,
          .fit = [max_bytes](const ContenderData& data) {
            const RefinedFitOptions options{.structure = largest_structure(max_bytes, kLadderBits),
                                            .families = {families::find(kFamily)},
                                            .bits = kLadderBits};
            const RefinedFit fit = fit_refined(*data.table, options);
            return sampled(fit.brdf, fit.converged ? "" : "stopped by its number of evaluations");
          }};
}

Contender paper() {
  return {.model = "paper",
          .kind = "copula",
          .title = "the paper's copula model",
          .source = "the paper's Eqs. 9 to 19",
          .fit = [](const ContenderData& data) {
            return sampled(fit_paper(*data.table, families::find(kFamily)).brdf, "");
          }};
}

Contender analytic_contender(const AnalyticInfo& info) {
  return {.model = info.name,
          .kind = "analytic",
          .title = info.title,
          .source = info.source,
          .fit =
              [&info](const ContenderData& data) {
                const AnalyticFit fit = fit_analytic(info, *data.table);
                const bool converged = fit.status == AnalyticFitStatus::converged;
                return ContenderFit{fit.brdf, fit.brdf->bytes(), converged ? "" : std::string(to_text(fit.status))};
              },
          .isotropic_form = info.isotropic_form};
}

Contender basis_contender(const BasisInfo& info, double max_bytes) {
  return {.model = info.name,
          .kind = "basis",
          .title = info.title,
          .source = info.source,
          .max_bytes = max_bytes,
          .learns = info.learns_from > 0,
          .fit = [&info, max_bytes](const ContenderData& data) {
            std::string note;
            const double most = max_bytes > 0 ? max_bytes : std::numeric_limits<double>::infinity();
            const BrdfPtr brdf = info.fit({.table = *data.table,
                                           .others = data.others,
                                           .on_message = [&](std::string_view message) { note = message; }},
                                          most);
            return ContenderFit{brdf, brdf->bytes(), note};
          }};
}

/// Those that all_contenders leaves out included.
std::vector<Contender> every_contender(std::span<const double> budgets) {
  if (budgets.empty()) throw std::invalid_argument("all_contenders: no budget given");
  for (const double budget : budgets) {
    if (!(budget > 0 && std::isfinite(budget))) {
      throw std::invalid_argument("all_contenders: a budget is " + sklar::to_text(budget) +
                                  " bytes; allowed are finite numbers above 0");
    }
  }
  std::vector<Contender> list;
  for (const double budget : budgets) list.push_back(refined(budget));
  list.push_back(paper());
  for (const AnalyticInfo& info : analytic::all()) list.push_back(analytic_contender(info));
  for (const BasisInfo& info : basis::all()) {
    if (info.name == "table") {
      list.push_back(basis_contender(info, 0));
      continue;
    }
    for (const double budget : budgets) list.push_back(basis_contender(info, budget));
  }
  return list;
}

}  // namespace

std::string Contender::name() const {
  return max_bytes > 0 ? model + "-" + sklar::to_text(max_bytes) : model;
}

std::vector<Contender> all_contenders(std::span<const double> budgets) {
  std::vector<Contender> list = every_contender(budgets);
  std::erase_if(list, [](const Contender& contender) { return !contender.isotropic_form.empty(); });
  return list;
}

std::vector<Contender> find_contenders(std::span<const std::string> models, std::span<const double> budgets) {
  const std::vector<Contender> all = every_contender(budgets);
  std::vector<Contender> result;
  for (const std::string& model : models) {
    const std::size_t before = result.size();
    std::copy_if(all.begin(), all.end(), std::back_inserter(result),
                 [&](const Contender& contender) { return contender.model == model; });
    if (result.size() > before) continue;
    std::string known, last;
    for (const Contender& contender : all) {
      if (contender.model != last) known.append(", ").append(contender.model);
      last = contender.model;
    }
    throw std::invalid_argument(std::string("unknown model '").append(model).append("'; known models: all") + known);
  }
  return result;
}

}  // namespace sklar::brdf
