#include <memory>
#include <numbers>

#include "brdf/sampling/sampled_brdf.hpp"
#include "brdf/study/albedo.hpp"
#include "brdf/study/furnace.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

struct Options {
  std::string material, output;
  Index furnace = 0;
};

void run(const Options& options, const Common& common) {
  const brdf::BrdfPtr material = load_isotropic_brdf(options.material);
  const brdf::AlbedoCurve curve = brdf::directional_albedo(*material);
  std::vector<std::string> columns = {"theta_o", "r", "g", "b"};
  Points rows(curve.albedo.rows(), 4);
  rows << curve.theta_o * (180 / std::numbers::pi), curve.albedo;
  if (options.furnace > 0) {
    const brdf::FurnaceCurve furnace =
        brdf::furnace_albedo(brdf::SampledBrdf(material), curve.theta_o, options.furnace, common.seed);
    columns.insert(columns.end(), {"furnace_r", "furnace_g", "furnace_b", "sigma_r", "sigma_g", "sigma_b"});
    Points both(rows.rows(), 10);
    both << rows, furnace.albedo, furnace.sigma;
    rows = std::move(both);
  }
  write_table(options.output, columns, rows, common.json);
}

}  // namespace

void add_brdf_albedo(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("albedo", "directional albedo at each degree of theta_o");
  const auto options = std::make_shared<Options>();
  add_material(*command, options->material);
  command
      ->add_option("--furnace", options->furnace,
                   "also the mean weight of so many draws of the sampler for each theta_o, and its standard error")
      ->check(CLI::Range(Index{2}, Index{1} << 31));
  command->add_option("-o", options->output, "write here, not to standard output");
  finish_command(*command, common, [options, &common] { run(*options, common); });
}

}  // namespace sklar::cli
