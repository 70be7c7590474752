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

struct Options {
  std::string material;
  std::string family = "frank";
  brdf::PaperFitOptions fit;
  brdf::Provenance provenance = brdf::Provenance::unknown;
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

nlohmann::ordered_json json_fits(const brdf::PaperFit& fit) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
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

void run(const Options& options, bool json) {
  const FamilyInfo& family = families::resolve(options.family);
  const auto table = load_table(options.material, options.provenance);
  const brdf::PaperFit fit = brdf::fit_paper(*table, family, options.fit, progress_bar("fitting"));
  const brdf::StoredBrdf stored{
      .material = table->name, .provenance = table->provenance, .method = options.fit.method, .brdf = fit.brdf};
  write_file(options.output, to_json(stored));
  if (!json) return print_fits(fit);
  const brdf::CellErrors errors = brdf::cell_errors(*table, brdf::predict(*fit.brdf, *table));
  std::cout << nlohmann::ordered_json{{"material", table->name},
                                      {"family", family.name},
                                      {"mode", "paper"},
                                      {"bytes", fit.brdf->bytes()},
                                      {"log1p_mae", errors.log1p_mae.mean()},
                                      {"fits", json_fits(fit)}}
                   .dump()
            << '\n';
}

}  // namespace

void add_brdf_fit(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("fit", "fit a model to a material");
  const auto options = std::make_shared<Options>();
  add_material(*command, options->material);
  command->add_option("--family", options->family, kFamilyHelp)->capture_default_str();
  command->add_option("-o", options->output, "MODEL.json")->required();
  add_fit_options(*command, options->fit, options->provenance);
  finish_command(*command, common, [options, &common] { run(*options, common.json); });
}

}  // namespace sklar::cli
