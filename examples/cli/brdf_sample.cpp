#include <memory>
#include <numbers>

#include "brdf/geometry/frame.hpp"
#include "copula/error.hpp"
#include "copula/random.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

struct Options {
  std::string material, wo, output;
  Index n = 0;
};

/// Of "theta,phi" in degrees.
brdf::Vec3 parse_wo(const std::string& text) {
  constexpr double kDegree = std::numbers::pi / 180;
  const std::vector<double> angles = parse_numbers(text, ',', "--wo");
  if (angles.size() != 2) throw std::invalid_argument("--wo: expected theta,phi in degrees, got '" + text + "'");
  if (!(angles[0] >= 0 && angles[0] < 90)) {
    throw std::domain_error("--wo: theta must be in [0, 90) degrees, got " + to_text(angles[0]));
  }
  if (!std::isfinite(angles[1])) throw std::domain_error("--wo: phi must be finite, got " + to_text(angles[1]));
  return brdf::spherical_direction(angles[0] * kDegree, angles[1] * kDegree);
}

void run(const Options& options, const Common& common) {
  const brdf::Vec3 wo = parse_wo(options.wo);
  const brdf::BrdfPtr material = load_sampled_brdf(options.material);
  Rng rng(common.seed);
  const Points u = uniforms(rng, options.n, 2);
  const brdf::Samples draws = material->sample(wo.transpose().array().replicate(options.n, 1), u);
  Points rows(options.n, 7);
  rows << draws.wi, draws.pdf, draws.weight;
  write_table(options.output, {"wi_x", "wi_y", "wi_z", "pdf", "weight_r", "weight_g", "weight_b"}, rows, common.json);
}

}  // namespace

void add_brdf_sample(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand(
      "sample", "draw incident directions for a wo: wi, pdf per solid angle, weight f_r cos(theta_i) / pdf");
  const auto options = std::make_shared<Options>();
  add_material(*command, options->material);
  command->add_option("--wo", options->wo, "theta,phi of the outgoing direction, degrees; theta in [0, 90)")
      ->required();
  command->add_option("-n", options->n, "number of directions")
      ->required()
      ->check(CLI::Range(Index{1}, Index{1} << 31));
  command->add_option("-o", options->output, "write here, not to standard output");
  finish_command(*command, common, [options, &common] { run(*options, common); });
}

}  // namespace sklar::cli
