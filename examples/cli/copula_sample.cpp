#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "copula/error.hpp"
#include "copula/inference/csv.hpp"
#include "copula/inference/model_io.hpp"
#include "copula/random.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/text.hpp"
#include "families/registry.hpp"

namespace sklar::cli {
namespace {

struct Options {
  std::string family = "frank";
  std::string model;
  std::string theta;
  std::optional<double> tau;
  std::optional<int> dim;
  long long n = 0;
  std::string given;
  Route route = Route::conditional;
  std::string output;
};

std::string json_text(const FamilyInfo& family, const Theta& theta, std::uint64_t seed,
                      const std::vector<std::string>& columns, const Points& u) {
  const nlohmann::ordered_json document{{"family", family.name}, {"theta", theta},     {"dim", u.cols()},
                                        {"seed", seed},          {"columns", columns}, {"rows", json_rows(u)}};
  return document.dump() + '\n';
}

Points sample_by(const Options& options, const Copula& copula, const Points& given, Rng& rng) {
  if (given.cols() > 0) throw std::invalid_argument("--given needs the conditional route");
  return copula.sample_by(options.route, options.n, rng);
}

Points given_of(const Options& options) {
  const std::vector<double> values = parse_numbers(options.given, ',', "--given");
  return Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Index>(values.size())).transpose();
}

std::vector<std::string> numbered(const std::string& letter, Index columns) {
  std::vector<std::string> names;
  for (Index k = 1; k <= columns; ++k) names.push_back(letter + std::to_string(k));
  return names;
}

/// Points of a stored copula with its margins.
void sample_model(const Options& options, const Common& common) {
  const CopulaModel model = read_model(options.model, families::all());
  if (model.margins.empty()) throw FileError(options.model, "has no margins; --family draws from a copula alone");
  Rng rng(common.seed);
  const Points x = make_joint(model, families::all()).sample(options.n, rng, given_of(options));
  write_table(options.output, model.columns.empty() ? numbered("x", x.cols()) : model.columns, x, common.json);
}

void run(const Options& options, const Common& common) {
  if (!options.model.empty()) return sample_model(options, common);
  const FamilyInfo& family = families::resolve(options.family);
  const int dim = options.dim.value_or(family.dimensions.lowest);
  const Theta theta = options.tau ? family.from_tau(dim, *options.tau) : parse_numbers(options.theta, ',', "--theta");
  const CopulaPtr copula = family.make(dim, theta);
  const Points given = given_of(options);
  Rng rng(common.seed);
  const Points u = options.route == Route::conditional ? copula->sample(options.n, rng, given)
                                                       : sample_by(options, *copula, given, rng);
  const std::vector<std::string> columns = numbered("u", dim);
  write_output(options.output, common.json ? json_text(family, theta, common.seed, columns, u) : to_csv(columns, u));
}

}  // namespace

void add_copula_sample(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("sample", "draw points of a copula, leading coordinates given or not");
  const auto options = std::make_shared<Options>();
  auto* family = command->add_option("--family", options->family, kFamilyHelp)->capture_default_str();
  auto* theta = command->add_option("--theta", options->theta, "parameters, separated by commas");
  auto* tau = command->add_option("--tau", options->tau, "Kendall's tau in place of the parameter");
  theta->excludes(tau);
  auto* dim = command->add_option("--dim", options->dim, "dimension; by default the lowest that the family has");
  command->add_option("-n", options->n, "number of points")->required();
  command->add_option("--given", options->given,
                      "leading coordinates in [0,1] (with --model values of its margins), separated by commas");
  const std::map<std::string, Route> routes = {
      {"conditional", Route::conditional}, {"frailty", Route::frailty}, {"radial", Route::radial}};
  auto* route =
      command->add_option("--route", options->route, "how: by inverse conditionals, a frailty, or the radial part")
          ->transform(CLI::CheckedTransformer(routes))
          ->default_str("conditional");
  auto* model = command->add_option(
      "--model", options->model, "a copula with margins, as `copula fit --model` writes them; draws values of these");
  for (auto* other : {family, theta, tau, dim, route}) model->excludes(other);
  command->add_option("-o", options->output, "write here, not to standard output");
  finish_command(*command, common, [options, &common] { run(*options, common); });
}

}  // namespace sklar::cli
