#include "examples/cli/fit_options.hpp"

#include <map>
#include <stdexcept>

namespace sklar::cli {
namespace {

template <class Value>
std::map<std::string, Value> by_text(std::initializer_list<Value> values) {
  std::map<std::string, Value> result;
  for (const Value value : values) result[std::string(to_text(value))] = value;
  return result;
}

}  // namespace

void add_provenance(CLI::App& command, brdf::Provenance& provenance) {
  using brdf::Provenance;
  command
      .add_option("--provenance", provenance,
                  "what the data of a file are that does not say (all but .bsdf), for titles and tables")
      ->transform(CLI::CheckedTransformer(
          by_text({Provenance::measured, Provenance::reconstruction, Provenance::synthetic, Provenance::unknown})))
      ->default_str("unknown");
}

void add_fit_options(CLI::App& command, FitOptions& options, const std::vector<std::string>& modes) {
  using brdf::CellMeasure;
  using brdf::RefinedObjective;
  options.mode = modes.front();
  command.add_option("--mode", options.mode, "the model")->check(CLI::IsMember(modes))->capture_default_str();
  command.add_option("--slices", options.paper.slices, "paper: theta_d slices, a divisor of 90")->capture_default_str();
  const std::map<std::string, FitMethod> methods = {
      {"ls", FitMethod::least_squares}, {"ml", FitMethod::maximum_likelihood}, {"tau", FitMethod::tau_inversion}};
  command.add_option("--method", options.paper.method, "paper: ls (Eq. 17), ml (Eq. 16) or tau")
      ->transform(CLI::CheckedTransformer(methods))
      ->default_str("ls");
  command.add_option("--objective", options.refined.objective, "refined: what the fit makes small")
      ->transform(CLI::CheckedTransformer(
          by_text({RefinedObjective::balanced, RefinedObjective::log1p, RefinedObjective::log_relative,
                   RefinedObjective::cube_root, RefinedObjective::likelihood, RefinedObjective::image})))
      ->default_str("balanced");
  command.add_option("--bits", options.bits,
                     "refined: bits of a stored coefficient, 6 to 16; omitted: 12, with a budget 8, 10, 12 and 14");
  command.add_option("--evaluations", options.evaluations,
                     "refined: of the objective in one fit, at most; omitted: 800, anisotropic 600");
  command.add_option("--max-bytes", options.budget.max_bytes, "refined: bytes of the stored model, at most");
  command.add_option("--measure", options.measure, "what a cell counts: one (cell) or its solid angle")
      ->transform(CLI::CheckedTransformer(by_text({CellMeasure::per_cell, CellMeasure::per_solid_angle})))
      ->default_str("cell");
  add_provenance(command, options.provenance);
}

void settle_fit_options(const CLI::App& command, FitOptions& options) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string& text = option->get_description();
    const std::string other = options.mode == "refined" ? "paper" : "refined";
    if (options.mode == "both" || option->count() == 0 || text.rfind(other + ":", 0) != 0) continue;
    throw std::invalid_argument(option->get_name() + " belongs to --mode " + other);
  }
  options.paper.measure = options.measure;
  options.refined.measure = options.measure;
  options.refined.evaluations = options.evaluations.value_or(options.refined.evaluations);
}

}  // namespace sklar::cli
