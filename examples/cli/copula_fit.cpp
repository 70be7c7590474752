#include <algorithm>
#include <iostream>
#include <map>
#include <memory>

#include "copula/file.hpp"
#include "copula/inference/select.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/copula_data.hpp"
#include "examples/cli/copula_fits.hpp"
#include "examples/cli/fit_intervals.hpp"
#include "examples/cli/fit_report.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

enum class Select { aic, bic, cv, holdout };

struct Options {
  DataOptions data;
  std::string families = "all";
  std::string margins = "empirical";
  Ties ties = Ties::average;
  FitMethod method = FitMethod::maximum_likelihood;
  bool together = false;
  Select select = Select::aic;
  int folds = 5;
  IntervalSettings intervals;
  std::string model;
  std::string output;
  std::string report;
};

Criterion criterion_of(Select select) {
  if (select == Select::aic) return Criterion::aic;
  return select == Select::bic ? Criterion::bic : Criterion::held_out;
}

void require_joint(const std::vector<MarginSpec>& specs) {
  const auto parametric = [](const MarginSpec& spec) { return is_parametric(spec.kind); };
  if (!specs.empty() && std::all_of(specs.begin(), specs.end(), parametric)) return;
  throw std::invalid_argument("--fit joint needs --margins normal, gamma or beta for every column");
}

/// The margins and what they make of the data.
struct Uniforms {
  std::vector<MarginFit> margins;
  Points u;
};

Uniforms uniforms_by(const Options& options, const std::vector<MarginSpec>& specs, const Sample& sample,
                     std::uint64_t seed) {
  if (specs.empty()) return {{}, sample.x};
  std::vector<MarginFit> margins = fit_margins(specs, sample.x, sample.weights);
  Points u = uniforms_of(margins, sample.x, sample.weights, {.ties = options.ties, .seed = seed});
  return {std::move(margins), std::move(u)};
}

Fits fit_families(const Options& options, const std::vector<const FamilyInfo*>& chosen,
                  const std::vector<MarginSpec>& specs, const Sample& sample, const Uniforms& uniforms) {
  Fits fits{.together = options.together, .densities = !specs.empty()};
  for (const MarginSpec& spec : specs) fits.densities = fits.densities && spec.kind != MarginKind::empirical;
  for (FitResult& result : fit_all(chosen, options.method, uniforms.u, sample.weights)) {
    const auto family =
        std::find_if(chosen.begin(), chosen.end(), [&](const FamilyInfo* info) { return info->name == result.family; });
    JointFit fit = two_step_fit(uniforms.margins, std::move(result), sample.total_weight());
    if (options.together) fit = fit_together(**family, fit, sample.x, sample.weights);
    fits.families.push_back({.family = *family, .fit = std::move(fit)});
  }
  return fits;
}

void add_held_out(const Options& options, const std::vector<MarginSpec>& specs, const Sample& sample,
                  std::uint64_t seed, Fits& fits) {
  std::vector<const FamilyInfo*> families;
  for (const FamilyFit& family : fits.families) families.push_back(family.family);
  const HeldOutOptions held_out{
      .folds = options.folds, .every_fold = options.select == Select::cv, .together = options.together, .seed = seed};
  const std::vector<HeldOut> found =
      held_out_likelihood(families, options.method, specs, sample.x, sample.weights, held_out);
  for (std::size_t i = 0; i < found.size(); ++i) fits.families[i].held_out = found[i];
}

void add_intervals(const Options& options, const Sample& sample, const Common& common, Fits& fits) {
  if (!options.intervals.confidence) return;
  const RankOptions ranking{.ties = options.ties, .seed = common.seed};
  for (FamilyFit& family : fits.families) {
    family.intervals = intervals_of(*family.family, family.fit, sample, options.intervals, ranking);
  }
}

std::vector<FitResult> copula_fits(const Fits& fits) {
  std::vector<FitResult> results;
  for (const FamilyFit& family : fits.families) results.push_back(family.fit.copula);
  return results;
}

/// What the reader should know of the data, on stderr.
void print_notes(const Sample& sample, const std::vector<MarginSpec>& specs) {
  if (sample.dropped > 0) {
    std::cerr << "sklar: " << sample.dropped << " of " << sample.dropped + sample.x.rows()
              << " rows dropped for missing values\n";
  }
  const std::vector<Index> tied = tied_rows(sample.x);
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (specs[i].kind != MarginKind::empirical || tied[i] == 0) continue;
    std::cerr << "sklar: column " << sample.names[i] << ": " << tied[i] << " of " << sample.x.rows()
              << " rows share their value with another; --ties says which rank they get\n";
  }
}

void run(const Options& options, const Common& common) {
  const std::vector<const FamilyInfo*> chosen = parse_families(options.families);
  const Sample sample = read_sample(options.data);
  const std::vector<MarginSpec> specs = margins_for(options.margins, sample);
  if (options.together) require_joint(specs);
  const Uniforms uniforms = uniforms_by(options, specs, sample, common.seed);
  Fits fits = fit_families(options, chosen, specs, sample, uniforms);
  if (criterion_of(options.select) == Criterion::held_out) add_held_out(options, specs, sample, common.seed, fits);
  sort_by(criterion_of(options.select), fits);
  const FamilyFit& best = fits.families.front();
  if (best.fit.copula.status == FitStatus::failed) {
    throw std::runtime_error("no family could be fitted; " + best.fit.copula.family + ": " + best.fit.copula.message);
  }
  add_intervals(options, sample, common, fits);
  if (!options.model.empty()) write_file(options.model, to_json(model_of(best, sample.names)));
  if (!options.report.empty()) {
    write_fit_report(options.report, {options.margins, sample.names, uniforms.u}, chosen, copula_fits(fits));
  }
  write_output(options.output, common.json ? json_of(fits, sample) : csv_of(fits));
  print_notes(sample, specs);
}

template <class Value>
void add_choice(CLI::App& command, const std::string& name, Value& value, const std::string& help,
                const std::map<std::string, Value>& choices, const std::string& by_default) {
  command.add_option(name, value, help)->transform(CLI::CheckedTransformer(choices))->default_str(by_default);
}

}  // namespace

void add_copula_fit(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("fit", "fit families to the columns of a CSV file, the best first");
  const auto options = std::make_shared<Options>();
  add_data_options(*command, options->data);
  command->add_option("--weights", options->data.weights,
                      "name of a column of frequencies: a row of weight k counts k times");
  command->add_option("--families", options->families, kFamiliesHelp)->capture_default_str();
  command->add_option("--margins", options->margins, kMarginsHelp)
      ->check(CLI::Validator([](const std::string& text) { return check_margins(text); }, ""))
      ->capture_default_str();
  add_choice<Ties>(
      *command, "--ties", options->ties, "rank of equal values: average, min, max or random",
      {{"average", Ties::average}, {"min", Ties::lowest}, {"max", Ties::highest}, {"random", Ties::random}}, "average");
  add_choice<FitMethod>(*command, "--method", options->method,
                        "maximum likelihood, least squares on cells, inversion of tau or of rho",
                        {{"ml", FitMethod::maximum_likelihood},
                         {"ls", FitMethod::least_squares},
                         {"tau", FitMethod::tau_inversion},
                         {"rho", FitMethod::rho_inversion}},
                        "ml");
  add_choice<bool>(*command, "--fit", options->together,
                   "two-step: margins first; joint: then all parameters together, by likelihood",
                   {{"two-step", false}, {"joint", true}}, "two-step");
  add_choice<Select>(*command, "--select", options->select,
                     "the best by AIC, BIC, or the likelihood of rows held out: in turn (cv) or once (holdout)",
                     {{"aic", Select::aic}, {"bic", Select::bic}, {"cv", Select::cv}, {"holdout", Select::holdout}},
                     "aic");
  command->add_option("--folds", options->folds, "cv, holdout: parts of the data")->capture_default_str();
  add_interval_options(*command, options->intervals);
  command->add_option("--model", options->model, "write the best copula with its margins and the columns' names here");
  command->add_option("-o", options->output, "write here, not to standard output");
  command->add_option("--report", options->report, "write a page for a browser here, with table and plots");
  finish_command(*command, common, [options, &common] { run(*options, common); });
}

}  // namespace sklar::cli
