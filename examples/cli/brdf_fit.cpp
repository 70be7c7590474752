#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "brdf/model/model_io.hpp"
#include "brdf/study/metrics.hpp"
#include "copula/file.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/fit_options.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/text.hpp"
#include "families/registry.hpp"

namespace sklar::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string material;
  std::string family;
  FitOptions fit;
  std::string output;
};

constexpr std::array<const char*, 3> kChannels = {"red", "green", "blue"};

void print_fits(const brdf::PaperFit& fit) {
  std::cout << "channel,slice,theta,tau,status,evaluations\n";
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t slice = 0; slice < fit.fits[channel].size(); ++slice) {
      const FitResult& result = fit.fits[channel][slice];
      std::cout << kChannels[channel] << ',' << slice << ',' << digits(result.theta) << ',' << digits(result.tau) << ','
                << to_text(result.status) << ',' << result.evaluations << '\n';
    }
  }
}

Json json_fits(const brdf::PaperFit& fit) {
  Json rows = Json::array();
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t slice = 0; slice < fit.fits[channel].size(); ++slice) {
      const FitResult& result = fit.fits[channel][slice];
      rows.push_back({{"channel", kChannels[channel]},
                      {"slice", slice},
                      {"theta", json_numbers(result.theta)},
                      {"tau", json_number(result.tau)},
                      {"status", to_text(result.status)},
                      {"evaluations", result.evaluations}});
    }
  }
  return rows;
}

void print_json(const brdf::StoredBrdf& stored, const brdf::MeasuredTable& table, const std::string& family,
                const std::string& mode, Json more) {
  const brdf::BrdfPtr model = stored.brdf();
  const brdf::CellErrors errors = brdf::cell_errors(table, brdf::predict(*model, table));
  Json json = {{"material", table.name},
               {"family", family},
               {"mode", mode},
               {"bytes", model->bytes()},
               {"log1p_mae", errors.log1p_mae.mean()},
               {"logrel_mae", errors.logrel_mae.mean()}};
  json.update(more);
  std::cout << json.dump() << '\n';
}

void run_paper(const Options& options, const brdf::MeasuredTable& table, bool json) {
  const FamilyInfo& family = families::resolve(options.family.empty() ? "frank" : options.family);
  const brdf::PaperFit fit = brdf::fit_paper(table, family, options.fit.paper, progress_bar("fitting"));
  const brdf::StoredBrdf stored{
      .material = table.name, .provenance = table.provenance, .model = fit.brdf, .method = options.fit.paper.method};
  write_file(options.output, to_json(stored));
  if (!json) return print_fits(fit);
  print_json(stored, table, family.name, "paper", {{"fits", json_fits(fit)}});
}

void run_refined(const Options& options, const brdf::MeasuredTable& table, bool json) {
  const FamilyInfo& family = families::resolve(options.family.empty() ? "independence" : options.family);
  brdf::RefinedFitOptions refined = options.fit.refined;
  refined.families = {family};
  brdf::Budget budget = options.fit.budget;
  if (std::isinf(budget.max_bytes) && budget.max_error == 0) {
    constexpr double kUsual = 4096;
    budget.max_bytes = kUsual;
  }
  const StepLine steps;
  const brdf::BudgetChoice choice = brdf::choose_model(
      table, budget, refined, [&](const std::string& what) { steps.show(table.name + ": " + what); });
  const brdf::FrontPoint& point = choice.front[choice.chosen];
  const brdf::StoredBrdf stored{.material = table.name, .provenance = table.provenance, .model = point.fit.brdf};
  write_file(options.output, to_json(stored));
  if (!json) {
    std::cout << to_markdown(choice);
    return;
  }
  print_json(stored, table, family.name, "refined",
             {{"objective", point.fit.objective},
              {"evaluations", point.fit.evaluations},
              {"status", point.fit.converged ? "converged" : "evaluations spent"},
              {"eval_ns", point.eval_ns},
              {"fit_s", point.fit_s}});
}

}  // namespace

void add_brdf_fit(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("fit", "fit a model to a material");
  const auto options = std::make_shared<Options>();
  add_material(*command, options->material);
  command->add_option("--family", options->family,
                      std::string(kFamilyHelp) + "; omitted: frank (paper), independence (refined)");
  command->add_option("-o", options->output, "MODEL.json")->required();
  add_fit_options(*command, options->fit, "refined");
  command->add_option("--max-error", options->fit.budget.max_error,
                      "refined: the smallest model with at most this log1p_mae");
  command->add_option("--max-ns", options->fit.budget.max_ns, "refined: nanoseconds an RGB value in a batch, at most");
  finish_command(*command, common, [command, options, &common] {
    settle_fit_options(*command, options->fit);
    const auto table = load_table(options->material, options->fit.provenance);
    options->fit.is_refined() ? run_refined(*options, *table, common.json) : run_paper(*options, *table, common.json);
  });
}

}  // namespace sklar::cli
