#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "copula/error.hpp"
#include "copula/inference/csv.hpp"
#include "copula/inference/dependence.hpp"
#include "copula/inference/select.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/fit_report.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

struct Options {
  std::string path;
  std::string families = "all";
  std::string margins = "empirical";
  std::string method = "ml";
  std::string output;
  std::string report;
};

/// Precondition: the name of one, as the option allows.
FitMethod find_method(const std::string& name) {
  for (const FitMethod method : {FitMethod::least_squares, FitMethod::tau_inversion}) {
    if (to_text(method) == name) return method;
  }
  return FitMethod::maximum_likelihood;
}

/// @throws FileError naming the line of a value that is not finite.
Table read_data(const std::string& path) {
  Table table = read_csv(path);
  for (Index row = 0; row < table.values.rows(); ++row) {
    if (table.values.row(row).allFinite()) continue;
    throw FileError(path, "line " + std::to_string(row + 2) + ": every value must be finite");
  }
  return table;
}

std::string json_of(const std::vector<FitResult>& results) {
  nlohmann::ordered_json document;
  for (const FitResult& result : results) {
    document["families"].push_back({{"name", result.family},
                                    {"theta", json_numbers(result.theta)},
                                    {"tau", json_number(result.tau)},
                                    {"loglik", json_number(result.log_likelihood)},
                                    {"aic", json_number(result.aic)},
                                    {"bic", json_number(result.bic)},
                                    {"se", json_numbers(result.standard_error)},
                                    {"status", to_text(result.status)},
                                    {"evaluations", result.evaluations},
                                    {"message", result.message}});
  }
  document["best"] = results.front().family;
  return document.dump(2) + '\n';
}

std::string csv_of(const std::vector<FitResult>& results) {
  std::string out = "name,theta,tau,loglik,aic,bic,se,status,evaluations,message\n";
  for (const FitResult& result : results) {
    out += csv_field(result.family) + ',' + digits(result.theta) + ',' + digits(result.tau) + ',' +
           digits(result.log_likelihood) + ',' + digits(result.aic) + ',' + digits(result.bic) + ',' +
           digits(result.standard_error) + ',' + std::string(to_text(result.status)) + ',' +
           std::to_string(result.evaluations) + ',' + csv_field(result.message) + '\n';
  }
  return out;
}

void run(const Options& options, bool json) {
  const std::vector<const FamilyInfo*> chosen = parse_families(options.families);
  const Table data = read_data(options.path);
  const Points u = options.margins == "empirical" ? pseudo_observations(data.values) : data.values;
  const std::vector<FitResult> results = fit_all(chosen, find_method(options.method), u);
  if (results.front().status == FitStatus::failed) {
    throw std::runtime_error("no family could be fitted; " + results.front().family + ": " + results.front().message);
  }
  if (!options.report.empty()) write_fit_report(options.report, {options.margins, data.names, u}, chosen, results);
  write_output(options.output, json ? json_of(results) : csv_of(results));
}

}  // namespace

void add_copula_fit(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("fit", "fit families to the columns of a CSV file, the best first");
  const auto options = std::make_shared<Options>();
  command->add_option("FILE", options->path, "a header, then one observation a line")->required();
  command->add_option("--families", options->families, kFamiliesHelp)->capture_default_str();
  command->add_option("--margins", options->margins, "empirical: ranks; none: the columns are in (0,1) already")
      ->check(CLI::IsMember({"empirical", "none"}))
      ->capture_default_str();
  command->add_option("--method", options->method, "maximum likelihood, least squares on cells, inversion of tau")
      ->check(CLI::IsMember({"ml", "ls", "tau"}))
      ->capture_default_str();
  command->add_option("-o", options->output, "write here, not to standard output");
  command->add_option("--report", options->report, "write a page for a browser here, with table and plots");
  finish_command(*command, common, [options, &common] { run(*options, common.json); });
}

}  // namespace sklar::cli
