#include <memory>
#include <numbers>

#include "brdf/study/albedo.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

void run(const std::string& path, const std::string& output, bool json) {
  const brdf::AlbedoCurve curve = brdf::directional_albedo(*load_isotropic_brdf(path));
  Points rows(curve.albedo.rows(), 4);
  rows << curve.theta_o * (180 / std::numbers::pi), curve.albedo;
  write_table(output, {"theta_o", "r", "g", "b"}, rows, json);
}

}  // namespace

void add_brdf_albedo(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("albedo", "directional albedo at each degree of theta_o");
  const auto path = std::make_shared<std::string>();
  const auto output = std::make_shared<std::string>();
  add_material(*command, *path);
  command->add_option("-o", *output, "write here, not to standard output");
  finish_command(*command, common, [=, &common] { run(*path, *output, common.json); });
}

}  // namespace sklar::cli
