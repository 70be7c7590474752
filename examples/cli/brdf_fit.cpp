#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "brdf/model/model_io.hpp"
#include "brdf/study/anisotropic_budget.hpp"
#include "brdf/study/energy.hpp"
#include "brdf/study/metrics.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "examples/cli/brdf_fit_scene.hpp"
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
  SceneOptions scene = {};
  std::string max_error;
  double max_albedo = std::numeric_limits<double>::infinity();
  std::string output;
};

constexpr double kUsualBytes = 4096;  // of a model where nothing was asked for
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

void print_json(const brdf::StoredBrdf& stored, const brdf::CellErrors& errors, const std::string& mode,
                const Json& more) {
  Json json = {{"material", stored.material},
               {"mode", mode},
               {"bytes", stored.brdf()->bytes()},
               {"log1p_mae", errors.log1p_mae.mean()},
               {"logrel_mae", errors.logrel_mae.mean()}};
  json.update(more);
  std::cout << json.dump() << '\n';
}

brdf::CellErrors errors_of(const brdf::StoredBrdf& stored, const brdf::MeasuredTable& table) {
  return brdf::cell_errors(table, brdf::predict(*stored.brdf(), table));
}

/// What the chosen model of a front says of itself.
template <class Point>
Json json_point(const Point& point) {
  return {{"objective", point.fit.objective},
          {"evaluations", point.fit.evaluations},
          {"status", point.fit.converged ? "converged" : "evaluations spent"},
          {"eval_ns", point.figures.eval_ns},
          {"fit_s", point.figures.fit_s}};
}

void run_paper(const Options& options, const brdf::MeasuredTable& table, bool json) {
  const FamilyInfo& family = families::resolve(options.family.empty() ? "frank" : options.family);
  const brdf::PaperFit fit = brdf::fit_paper(table, family, options.fit.paper, progress_bar("fitting"));
  const brdf::StoredBrdf stored{
      .material = table.name, .provenance = table.provenance, .model = fit.brdf, .method = options.fit.paper.method};
  brdf::write_brdf(options.output, stored);
  if (!json) return print_fits(fit);
  print_json(stored, errors_of(stored, table), "paper", {{"family", family.name}, {"fits", json_fits(fit)}});
}

/// Without a budget one structure, of the usual size; with one a search.
brdf::BudgetChoice choose(const Options& options, const brdf::MeasuredTable& table) {
  const StepLine steps;
  const auto progress = [&](const std::string& what) { steps.show(table.name + ": " + what); };
  brdf::BudgetSearch search = brdf::usual_search();
  if (!options.family.empty()) search = {.families = {families::resolve(options.family)}};
  if (options.fit.bits) search.bits = {*options.fit.bits};
  const brdf::Budget& budget = options.fit.budget;
  if (budget.limits()) return choose_model(table, budget, search, options.fit.refined, progress);
  search.bits = {options.fit.bits.value_or(brdf::kLadderBits)};
  return fit_largest(table, kUsualBytes, search, options.fit.refined, progress);
}

/// The model, lowered where --max-albedo asks for it.
template <class Model>
brdf::Limited<Model> limit(const Options& options, const std::shared_ptr<const Model>& model) {
  if (std::isinf(options.max_albedo)) return {.brdf = model};
  return brdf::limit_albedo(model, options.max_albedo);
}

template <class Model>
void print_limit(const Options& options, const brdf::Limited<Model>& limited) {
  if (std::isinf(options.max_albedo)) return;
  std::cout << "\nlargest directional albedo " << digits(limited.albedo_before) << ", limited "
            << digits(limited.albedo_after) << "; values multiplied by " << digits(limited.lowest_factor) << " to 1\n";
}

template <class Model>
void add_limit(const Options& options, const brdf::Limited<Model>& limited, Json& to) {
  if (std::isinf(options.max_albedo)) return;
  to.update({{"albedo_before", limited.albedo_before},
             {"albedo", limited.albedo_after},
             {"lowest_factor", limited.lowest_factor}});
}

void run_refined(const Options& options, const brdf::MeasuredTable& table, bool json) {
  const brdf::BudgetChoice choice = choose(options, table);
  const brdf::FrontPoint& point = choice.front[choice.chosen];
  const auto limited = limit(options, point.fit.brdf);
  const brdf::StoredBrdf stored{.material = table.name, .provenance = table.provenance, .model = limited.brdf};
  brdf::write_brdf(options.output, stored);
  const double deviation = table.report.isotropy_deviation;
  if (!json) {
    if (deviation > 0) std::cout << "isotropy deviation " << digits(deviation) << ": fitted as isotropic\n\n";
    std::cout << to_markdown(choice);
    print_limit(options, limited);
    return;
  }
  Json more = {{"family", point.family}, {"bits", point.bits}};
  more.update(json_point(point));
  if (deviation > 0) more["isotropy_deviation"] = deviation;
  add_limit(options, limited, more);
  print_json(stored, errors_of(stored, table), "refined", more);
}

void run_anisotropic(const Options& options, const brdf::AnisotropicTable& table, bool json) {
  if (!options.scene.scene.empty()) {
    throw std::invalid_argument("--scene: '" + table.name + "' is anisotropic, models of a scene are isotropic");
  }
  if (!options.family.empty() && options.family != "independence") {
    throw std::invalid_argument("--family " + options.family + ": the lobes of an anisotropic model have no copula");
  }
  brdf::AnisotropicFitOptions fit_options{.objective = options.fit.refined.objective,
                                          .measure = options.fit.measure,
                                          .bits = options.fit.bits.value_or(brdf::kLadderBits)};
  fit_options.evaluations = options.fit.evaluations.value_or(fit_options.evaluations);
  brdf::Budget budget = options.fit.budget;
  if (!budget.limits()) budget.max_bytes = kUsualBytes;
  const StepLine steps;
  const brdf::AnisotropicChoice choice = brdf::choose_anisotropic(
      table, budget, fit_options, [&](const std::string& what) { steps.show(table.name + ": " + what); });
  const brdf::AnisotropicPoint& point = choice.front[choice.chosen];
  const auto limited = limit(options, point.fit.brdf);
  const brdf::StoredBrdf stored{.material = table.name, .provenance = table.provenance, .model = limited.brdf};
  brdf::write_brdf(options.output, stored);
  if (!json) {
    std::cout << "isotropy deviation " << digits(table.report.isotropy_deviation) << ": fitted as anisotropic\n\n"
              << to_markdown(choice);
    print_limit(options, limited);
    return;
  }
  Json more = json_point(point);
  add_limit(options, limited, more);
  more["isotropy_deviation"] = table.report.isotropy_deviation;
  print_json(stored, brdf::cell_errors(table, *limited.brdf), "anisotropic", more);
}

void run(const Options& options, std::uint64_t seed, bool json) {
  require_writable(options.output);
  if (!options.fit.is_refined()) {
    if (brdf::is_binary_path(options.output)) throw FileError(options.output, "a model of mode 'paper' is .json");
    return run_paper(options, *load_table(options.material, options.fit.provenance), json);
  }
  const brdf::Material material = load_any_table(options.material, options.fit.provenance);
  if (const auto* table = std::get_if<brdf::AnisotropicTable>(&material)) return run_anisotropic(options, *table, json);
  const auto& table = std::get<brdf::MeasuredTable>(material);
  if (options.scene.scene.empty()) return run_refined(options, table, json);
  const std::string tolerance = options.max_error.empty() ? "40dB" : options.max_error;
  run_scene_fit(table, options.scene, options.fit, parse_tolerance(tolerance), seed, options.output, json);
}

/// Without a scene --max-error is a number.
void settle_budget(Options& options) {
  double& error = options.fit.budget.max_error;
  if (options.max_error.empty() || !options.scene.scene.empty()) return;
  if (CLI::detail::lexical_cast(options.max_error, error)) return;
  throw std::invalid_argument("--max-error " + options.max_error + ": without --scene it is a log1p_mae, a number");
}

}  // namespace

void add_brdf_fit(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand(
      "fit", "fit a model to a material; refined fits take the anisotropic model where the material is");
  const auto options = std::make_shared<Options>();
  add_material(*command, options->material);
  command->add_option(
      "--family", options->family,
      std::string(kFamilyHelp) +
          "; omitted: frank (paper), independence (refined); with a budget frank, too, and one for each component");
  command->add_option("-o", options->output, "MODEL.json, or refined MODEL.sklar, binary")->required();
  add_fit_options(*command, options->fit, {"refined", "paper"});
  command->add_option(
      "--max-error", options->max_error,
      "refined: the smallest model with at most this log1p_mae; with --scene as 40dB, the least PSNR of "
      "its picture, or 0.5dE, the largest mean CIEDE2000");
  add_scene_options(*command, options->scene);
  command->add_option("--max-ns", options->fit.budget.max_ns, "refined: nanoseconds an RGB value in a batch, at most");
  command->add_option("--max-albedo", options->max_albedo,
                      "refined: lower the model where its directional albedo is larger, at some wo or channel");
  finish_command(*command, common, [command, options, &common] {
    settle_fit_options(*command, options->fit);
    settle_budget(*options);
    run(*options, common.seed, common.json);
  });
}

}  // namespace sklar::cli
