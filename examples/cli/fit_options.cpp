#include "examples/cli/fit_options.hpp"

#include <map>
#include <string>

namespace sklar::cli {

void add_fit_options(CLI::App& command, brdf::PaperFitOptions& options, brdf::Provenance& provenance) {
  command.add_option("--mode", "the model: paper")->check(CLI::IsMember({"paper"}))->default_str("paper");
  command.add_option("--slices", options.slices, "theta_d slices, a divisor of 90")->capture_default_str();
  const std::map<std::string, FitMethod> methods = {
      {"ls", FitMethod::least_squares}, {"ml", FitMethod::maximum_likelihood}, {"tau", FitMethod::tau_inversion}};
  command.add_option("--method", options.method, "ls (paper Eq. 17), ml (Eq. 16) or tau")
      ->transform(CLI::CheckedTransformer(methods))
      ->default_str("ls");
  const std::map<std::string, brdf::CellMeasure> measures = {{"cell", brdf::CellMeasure::per_cell},
                                                             {"solid-angle", brdf::CellMeasure::per_solid_angle}};
  command
      .add_option("--measure", options.measure, "what a cell's mass is: its value (cell) or that times its solid angle")
      ->transform(CLI::CheckedTransformer(measures))
      ->default_str("cell");
  std::map<std::string, brdf::Provenance> provenances;
  for (const auto value : {brdf::Provenance::measured, brdf::Provenance::reconstruction, brdf::Provenance::synthetic,
                           brdf::Provenance::unknown}) {
    provenances[to_text(value)] = value;
  }
  command.add_option("--provenance", provenance, "what the data of a .binary file are, for titles and tables")
      ->transform(CLI::CheckedTransformer(provenances))
      ->default_str("unknown");
}

}  // namespace sklar::cli
