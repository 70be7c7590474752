#include <algorithm>
#include <memory>

#include "copula/error.hpp"
#include "copula/inference/csv.hpp"
#include "copula/inference/model_io.hpp"
#include "copula/inference/predict.hpp"
#include "copula/listed.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/text.hpp"
#include "families/registry.hpp"

namespace sklar::cli {
namespace {

struct Options {
  std::string model;
  std::string data;
  std::string columns;
  std::string quantiles = "0.05,0.5,0.95";
  long long n = 0;
  std::string output;
};

/// A copula without margins has uniform ones.
std::shared_ptr<const JointDistribution> joint_of(CopulaModel model) {
  if (model.margins.empty()) {
    model.margins.assign(static_cast<std::size_t>(model.dim), HistogramMarginal({0, 1}, {1}));
  }
  return std::make_shared<const JointDistribution>(make_joint(model, families::all()));
}

/// The names that the model holds, or for a model without them those of --columns or x1, x2, ..
std::vector<std::string> column_names(const std::string& columns, const CopulaModel& model) {
  if (!model.columns.empty()) {
    if (columns.empty()) return model.columns;
    throw std::invalid_argument("--columns: the model has the names of its columns: " + listed(model.columns));
  }
  std::vector<std::string> names = columns.empty() ? std::vector<std::string>{} : split_csv(columns);
  if (columns.empty()) {
    for (int k = 1; k <= model.dim; ++k) names.push_back("x" + std::to_string(k));
  }
  if (names.size() == static_cast<std::size_t>(model.dim)) return names;
  throw std::invalid_argument("--columns: the model has " + std::to_string(model.dim) + " columns, got " +
                              std::to_string(names.size()) + " names");
}

std::vector<int> given_columns(const Table& table, const std::string& path, const std::vector<std::string>& names) {
  std::vector<int> given;
  for (const std::string& name : table.names) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
      throw FileError(path, "the model has no column '" + name + "'; its columns: " + listed(names));
    }
    given.push_back(static_cast<int>(found - names.begin()));
  }
  return given;
}

std::vector<double> parse_levels(const std::string& text) {
  const std::vector<double> levels = parse_numbers(text, ',', "--quantiles");
  for (const double level : levels) {
    if (!(level >= 0 && level <= 1)) {
      throw std::invalid_argument("--quantiles must be in [0,1], got " + to_text(level));
    }
  }
  return levels;
}

void write_quantiles(const Options& options, const Prediction& prediction, const std::vector<std::string>& names,
                     const Points& given, bool json) {
  const std::vector<double> levels = parse_levels(options.quantiles);
  std::vector<std::string> header;
  Points values(given.rows(), static_cast<Index>(prediction.missing().size() * levels.size()));
  for (const int column : prediction.missing()) {
    for (const double level : levels) {
      values.col(static_cast<Index>(header.size())) =
          prediction.quantile(column, given, Column::Constant(given.rows(), level));
      header.push_back(names[static_cast<std::size_t>(column)] + "_q" + to_text(level));
    }
  }
  write_table(options.output, header, values, json);
}

void write_samples(const Options& options, const Prediction& prediction, const std::vector<std::string>& names,
                   const Points& given, const Common& common) {
  Rng rng(common.seed);
  Points values(given.rows() * options.n, static_cast<Index>(names.size()));
  for (Index row = 0; row < given.rows(); ++row) {
    values.middleRows(row * options.n, options.n) = prediction.sample(options.n, rng, given.row(row));
  }
  write_table(options.output, names, values, common.json);
}

void run(const Options& options, const Common& common) {
  const CopulaModel model = read_model(options.model, families::all());
  const std::vector<std::string> names = column_names(options.columns, model);
  const Table table = read_csv(options.data);
  const Prediction prediction(joint_of(model), given_columns(table, options.data, names));
  if (options.n > 0) {
    write_samples(options, prediction, names, table.values, common);
  } else {
    write_quantiles(options, prediction, names, table.values, common.json);
  }
}

}  // namespace

void add_copula_predict(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("predict", "predict the other columns of a stored joint distribution");
  const auto options = std::make_shared<Options>();
  command->add_option("MODEL", options->model, "a stored copula with its margins; without them they are uniform")
      ->required();
  command->add_option("DATA", options->data, "a header with some of the model's columns, then their values")
      ->required();
  command->add_option("--columns", options->columns,
                      "names of the columns of a model that holds none, in order; by default x1,x2,..");
  auto* quantiles = command->add_option("--quantiles", options->quantiles, "of each column that is not given, alone")
                        ->capture_default_str();
  command->add_option("-n", options->n, "instead: draw so many points for every line, all columns together")
      ->check(CLI::Range(1LL, 1'000'000'000LL))
      ->excludes(quantiles);
  command->add_option("-o", options->output, "write here, not to standard output");
  finish_command(*command, common, [options, &common] { run(*options, common); });
}

}  // namespace sklar::cli
