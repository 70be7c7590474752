#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "examples/cli/command.hpp"
#include "examples/cli/families_page.hpp"
#include "examples/cli/text.hpp"
#include "families/registry.hpp"

namespace sklar::cli {
namespace {

/// Whether any example admissible in the dimension has tail dependence.
TailDependence strongest_tails(const FamilyInfo& family, int dim) {
  TailDependence strongest{0, 0};
  for (const Theta& theta : family.examples) {
    if (!family.admits(dim, theta)) continue;
    const TailDependence tails = family.tails(theta);
    strongest = {std::max(tails.lower, strongest.lower), std::max(tails.upper, strongest.upper)};  // the first if NaN
  }
  return strongest;
}

std::string tails_text(const TailDependence& tails) {
  if (std::isnan(tails.lower)) return "by pair";
  if (tails.lower > 0 && tails.upper > 0) return "both";
  if (tails.lower > 0) return "lower";
  return tails.upper > 0 ? "upper" : "none";
}

bool has_tau_range(const FamilyInfo& family, int dim) {
  return family.parameters.size() == 1 && !std::isnan(family.tau_range(dim).lowest);
}

std::string tau_text(const FamilyInfo& family, int dim) {
  if (family.parameters.empty()) return std::isnan(family.tau({})) ? "" : digits(family.tau({}));
  return has_tau_range(family, dim) ? family.tau_range(dim).to_text() : "";
}

/// The range of tau to a few digits, for people.
std::string short_tau_text(const FamilyInfo& family, int dim) {
  if (!has_tau_range(family, dim)) return tau_text(family, dim);
  const auto rounded = [](double tau) { return std::round(tau * 1e6) / 1e6; };
  Interval range = family.tau_range(dim);
  range.lowest = rounded(range.lowest);
  range.highest = rounded(range.highest);
  return range.to_text();
}

Cells table_row(const FamilyInfo& family, int dim) {
  std::string parameters;
  for (const ParameterInfo& parameter : family.parameters) {
    if (!parameters.empty()) parameters += "; ";
    parameters += parameter.name + " in " + parameter.domain(dim).to_text();
  }
  return {family.name, parameters.empty() ? "none" : parameters, short_tau_text(family, dim),
          tails_text(strongest_tails(family, dim)), family.source};
}

nlohmann::ordered_json json_row(const FamilyInfo& family, int dim) {
  auto parameters = nlohmann::ordered_json::array();
  for (const ParameterInfo& parameter : family.parameters) {
    const Interval domain = parameter.domain(dim);
    parameters.push_back({{"name", parameter.name},
                          {"lowest", json_number(domain.lowest)},
                          {"highest", json_number(domain.highest)},
                          {"domain", domain.to_text()}});
  }
  return {
      {"name", family.name},      {"title", family.title},        {"psi", family.psi},
      {"parameters", parameters}, {"tau", tau_text(family, dim)}, {"tails", tails_text(strongest_tails(family, dim))},
      {"source", family.source}};
}

struct Options {
  int dim = 2;
  bool page = false;
  std::string families = "all";
  std::string output;
};

void run(const Options& options, bool json) {
  const int dim = options.dim;
  const std::vector<const FamilyInfo*> families = parse_families(options.families);
  if (options.page) return write_output(options.output, families_page(families));
  if (dim < 2) throw std::invalid_argument("families: dim must be 2 or more, got " + std::to_string(dim));
  for (const FamilyInfo* family : families) family->require_dimension(dim);
  if (json) {
    nlohmann::ordered_json document{{"dim", dim}, {"families", nlohmann::ordered_json::array()}};
    for (const FamilyInfo* family : families) document["families"].push_back(json_row(*family, dim));
    return write_output(options.output, document.dump() + '\n');
  }
  std::vector<Cells> rows{{"family", "parameters, d = " + std::to_string(dim), "tau", "tails", "source"}};
  for (const FamilyInfo* family : families) rows.push_back(table_row(*family, dim));
  write_output(options.output, aligned(rows));
}

}  // namespace

void add_families(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand(
      "families", "list the copula families; rotations of them, as clayton@180, are taken wherever a name is");
  const auto options = std::make_shared<Options>();
  command->add_option("--dim", options->dim, "dimension for which the domains are shown")->capture_default_str();
  command->add_option("--families", options->families, kFamiliesHelp)->capture_default_str();
  command->add_flag("--page", options->page, "Markdown with formulas, as docs/families.md");
  command->add_option("-o", options->output, "write here, not to standard output");
  finish_command(*command, common, [options, &common] { run(*options, common.json); });
}

}  // namespace sklar::cli
