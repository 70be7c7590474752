#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "copula/inference/goodness.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/copula_data.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/text.hpp"
#include "families/registry.hpp"

namespace sklar::cli {
namespace {

struct Options {
  DataOptions data;
  std::string family;
  GoodnessOptions test;
  std::string margins = "empirical";
  std::string output;
};

std::string json_of(const GoodnessResult& result, const GoodnessOptions& options) {
  const nlohmann::ordered_json document{{"family", result.fit.family},
                                        {"method", to_text(options.method)},
                                        {"theta", json_numbers(result.fit.theta)},
                                        {"tau", json_number(result.fit.tau)},
                                        {"statistic", to_text(options.statistic)},
                                        {"value", json_number(result.statistic)},
                                        {"p_value", json_number(result.p_value)},
                                        {"p_error", json_number(result.p_error)},
                                        {"replicates", result.replicates},
                                        {"failed", result.failed},
                                        {"tied", result.tied},
                                        {"seed", options.bootstrap.seed}};
  return document.dump(2) + '\n';
}

std::string csv_of(const GoodnessResult& result, const GoodnessOptions& options) {
  return "family,method,theta,tau,statistic,value,p_value,p_error,replicates,failed,tied\n" +
         csv_field(result.fit.family) + ',' + std::string(to_text(options.method)) + ',' + digits(result.fit.theta) +
         ',' + digits(result.fit.tau) + ',' + std::string(to_text(options.statistic)) + ',' + digits(result.statistic) +
         ',' + digits(result.p_value) + ',' + digits(result.p_error) + ',' + std::to_string(result.replicates) + ',' +
         std::to_string(result.failed) + ',' + std::to_string(result.tied) + '\n';
}

void run(const Options& options, const Common& common) {
  GoodnessOptions test = options.test;
  test.ranks = options.margins == "empirical";
  test.bootstrap.seed = common.seed;
  test.bootstrap.progress = progress_bar("replicates");
  const FamilyInfo& family = families::resolve(options.family);
  const GoodnessResult result = test_goodness(family, read_sample(options.data).x, test);
  if (result.fit.status == FitStatus::failed) {
    throw std::runtime_error(family.name + " could not be fitted: " + result.fit.message);
  }
  if (result.tied > 0) {
    std::cerr << "sklar: " << result.tied << " values have a tie in their column; samples of a copula have none, so "
              << "the p-value is only approximate\n";
  }
  write_output(options.output, common.json ? json_of(result, test) : csv_of(result, test));
}

}  // namespace

void add_copula_test(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("test", "test whether a family describes the columns of a CSV file");
  const auto options = std::make_shared<Options>();
  GoodnessOptions& test = options->test;
  add_data_options(*command, options->data);
  command->add_option("--family", options->family, kFamilyHelp)->required();
  const std::map<std::string, GoodnessStatistic> statistics = {{"cvm", GoodnessStatistic::cramer_von_mises},
                                                               {"rosenblatt", GoodnessStatistic::rosenblatt}};
  command
      ->add_option("--statistic", test.statistic,
                   "distance of the empirical copula from the fitted one, or of the Rosenblatt transforms from "
                   "independence")
      ->transform(CLI::CheckedTransformer(statistics))
      ->default_str("cvm");
  const std::map<std::string, FitMethod> methods = {{"ml", FitMethod::maximum_likelihood},
                                                    {"ls", FitMethod::least_squares},
                                                    {"tau", FitMethod::tau_inversion},
                                                    {"rho", FitMethod::rho_inversion}};
  command->add_option("--method", test.method, "maximum likelihood, least squares on cells, inversion of tau or of rho")
      ->transform(CLI::CheckedTransformer(methods))
      ->default_str("ml");
  command->add_option("--margins", options->margins, "empirical: ranks; none: the columns are in (0,1) already")
      ->check(CLI::IsMember({"empirical", "none"}))
      ->capture_default_str();
  command->add_option("--replicates", test.bootstrap.replicates, "samples of the fitted copula")->capture_default_str();
  command->add_option("-o", options->output, "write here, not to standard output");
  finish_command(*command, common, [options, &common] { run(*options, common); });
}

}  // namespace sklar::cli
