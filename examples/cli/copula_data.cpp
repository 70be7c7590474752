#include "examples/cli/copula_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "copula/error.hpp"
#include "copula/inference/csv.hpp"
#include "copula/listed.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

std::string place(Index line, const std::string& column) {
  return "line " + std::to_string(line) + ", column " + column + ": ";
}

/// @throws FileError naming line and column of the first value that is not allowed.
template <class Allowed>
void require_values(const Sample& sample, const std::string& name, const ColumnRef& values, const std::string& what,
                    Allowed allowed) {
  for (Index row = 0; row < values.size(); ++row) {
    if (allowed(values[row])) continue;
    throw FileError(sample.path,
                    place(sample.lines[static_cast<std::size_t>(row)], name) + what + ", got " + to_text(values[row]));
  }
}

/// Takes the column of weights out of a table. @throws FileError for a table without it.
Column take_weights(Table& table, const std::string& name, const std::string& path) {
  const auto found = std::find(table.names.begin(), table.names.end(), name);
  if (found == table.names.end()) throw FileError(path, "line 1: no column '" + name + "' for --weights");
  const auto taken = static_cast<Index>(found - table.names.begin());
  const Column weights = table.values.col(taken);
  Points rest(table.values.rows(), table.values.cols() - 1);
  rest << table.values.leftCols(taken), table.values.rightCols(rest.cols() - taken);
  table.values = std::move(rest);
  table.names.erase(found);
  return weights;
}

constexpr std::array kMarginKinds = {MarginKind::empirical, MarginKind::kernel, MarginKind::normal, MarginKind::gamma,
                                     MarginKind::beta};

/// One item of --margins, or what is wrong with it.
std::string parse_margin(const std::string& item, MarginSpec& spec) {
  const std::string name = item.substr(0, item.find(':'));
  for (const MarginKind kind : kMarginKinds) {
    if (name != to_text(kind)) continue;
    spec = {.kind = kind};
    if (name == item) return {};
    if (kind != MarginKind::beta) return "only beta takes a support, got '" + item + "'";
    const std::size_t second = item.find(':', name.size() + 1);
    const auto lowest = parse_number(item.substr(name.size() + 1, second - name.size() - 1));
    const auto highest = parse_number(second == std::string::npos ? "" : item.substr(second + 1));
    if (!lowest || !highest || !(*lowest < *highest))
      return "expected beta:LOW:HIGH with LOW < HIGH, got '" + item + "'";
    spec.lowest = *lowest;
    spec.highest = *highest;
    return {};
  }
  return "unknown margin '" + name +
         "'; margins: " + listed(kMarginKinds, [](MarginKind kind) { return to_text(kind); }) + ", none";
}

}  // namespace

double Sample::total_weight() const {
  return weights.size() > 0 ? weights.sum() : static_cast<double>(x.rows());
}

void add_data_options(CLI::App& command, DataOptions& options) {
  command.add_option("FILE", options.path, "a header, then one observation a line")->required();
  command.add_option("--columns", options.columns, "names of the columns, separated by commas; by default all");
  command
      .add_option("--missing", options.drop,
                  "rows with a missing value (an empty field, NA, NaN, nan or .): error or drop")
      ->transform(CLI::CheckedTransformer(std::map<std::string, bool>{{"error", false}, {"drop", true}}))
      ->default_str("error");
}

Sample read_sample(const DataOptions& options) {
  CsvOptions csv{.missing = options.drop ? Missing::drop : Missing::refuse};
  if (!options.columns.empty()) {
    csv.columns = split_csv(options.columns);
    if (!options.weights.empty()) csv.columns.push_back(options.weights);
  }
  Table table = read_csv(options.path, csv);
  Sample sample{.path = options.path, .lines = table.lines, .dropped = table.dropped};
  if (!options.weights.empty()) {
    sample.weights = take_weights(table, options.weights, options.path);
    require_values(sample, options.weights, sample.weights, "a weight must be finite and 0 or more",
                   [](double weight) { return std::isfinite(weight) && weight >= 0; });
  }
  sample.names = std::move(table.names);
  sample.x = std::move(table.values);
  for (Index i = 0; i < sample.x.cols(); ++i) {
    require_values(sample, sample.names[static_cast<std::size_t>(i)], sample.x.col(i), "must be finite",
                   [](double value) { return std::isfinite(value); });
  }
  return sample;
}

std::string check_margins(const std::string& text) {
  if (text == "none") return {};
  for (const std::string& item : split_csv(text)) {
    MarginSpec spec;
    const std::string wrong = parse_margin(item, spec);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

std::vector<MarginSpec> margins_for(const std::string& text, const Sample& sample) {
  std::vector<MarginSpec> specs;
  if (text != "none") {
    for (const std::string& item : split_csv(text)) (void)parse_margin(item, specs.emplace_back());
    if (specs.size() == 1) specs.resize(sample.names.size(), specs.front());
    if (specs.size() != sample.names.size()) {
      throw std::invalid_argument("--margins names " + std::to_string(specs.size()) + " margins for " +
                                  std::to_string(sample.names.size()) + " columns; give one, or one a column");
    }
  }
  for (std::size_t i = 0; i < sample.names.size(); ++i) {
    const Interval inside = specs.empty() ? Interval{0, 1, false, false} : support(specs[i]);
    const std::string margin =
        specs.empty() ? "--margins none" : "a " + std::string(to_text(specs[i].kind)) + " margin";
    require_values(sample, sample.names[i], sample.x.col(static_cast<Index>(i)),
                   margin + " needs values in " + inside.to_text(),
                   [&](double value) { return inside.contains(value); });
  }
  return specs;
}

}  // namespace sklar::cli
