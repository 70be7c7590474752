#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "copula/symbolic/formula_family.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/table.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

Points points_of(std::span<Row* const> rows) {
  Points points(static_cast<Index>(rows.size()), static_cast<Index>(rows.front()->arguments.size()));
  for (Index row = 0; row < points.rows(); ++row) {
    const std::vector<double>& arguments = rows[static_cast<std::size_t>(row)]->arguments;
    for (Index column = 0; column < points.cols(); ++column) {
      points(row, column) = arguments[static_cast<std::size_t>(column)];
    }
  }
  return points;
}

enum class Level { fast, standard, symbolic, exact };

struct Options {
  std::string path;
  std::string output;
  Level level = Level::standard;
  int digits = 50;
};

void evaluate_exactly(const Group& group, const Copula& copula, std::span<Row* const> rows, int digits) {
  const std::vector<BigFloat> values = group.quantity.exact(copula, points_of(rows), digits);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i]->value = static_cast<double>(values[i]);
    rows[i]->digits = to_text(values[i], digits);
  }
}

/// All rows in one call; where that throws, one by one, so that each row has its own answer.
void evaluate(const Group& group, const Copula& copula, std::span<Row* const> rows, const Options& options) {
  try {
    if (options.level == Level::exact) return evaluate_exactly(group, copula, rows, options.digits);
    const Accuracy accuracy = options.level == Level::fast ? Accuracy::fast : Accuracy::standard;
    const Column values = group.quantity.evaluate(copula, points_of(rows), accuracy);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i]->value = values(static_cast<Index>(i));
  } catch (const std::logic_error& error) {
    if (rows.size() == 1) {
      rows.front()->failure = error.what();
    } else {
      for (std::size_t i = 0; i < rows.size(); ++i) evaluate(group, copula, rows.subspan(i, 1), options);
    }
  }
}

std::string text_of(const Row& row) {
  if (!row.failure.empty()) return "error: " + row.failure;
  return row.digits.empty() ? digits(row.value) : row.digits;
}

void judge_row(const Group& group, const Copula& copula, Row& row) {
  row.verdict = judge(group.quantity.rule, row.value, *row.expected);
  if (group.quantity.rule != Rule::inverse || row.verdict.passes() || !(row.value >= 0 && row.value <= 1)) return;
  Points u = points_of(std::vector{&row});
  const Index last = u.cols() - 1;
  const double p = u(0, last);
  u(0, last) = row.fields[kQuantity] == "h_inv_upper" ? 1 - row.value : row.value;
  row.best_double = is_best_double(row.value, p, copula.h(u)(0), std::exp(copula.log_conditional_pdf(u)(0)));
}

void answer(Group& group, const Options& options) {
  CopulaPtr copula;
  try {
    const bool symbolic = options.level == Level::symbolic;
    const FamilyInfo family = symbolic ? symbolic::formula_of(*group.family) : *group.family;
    copula = family.make(group.quantity.dim_for(group.dim), group.theta);
  } catch (const std::logic_error& error) {
    for (Row* row : group.rows) row->failure = error.what();
    return;
  }
  evaluate(group, *copula, group.rows, options);
  for (Row* row : group.rows) {
    if (row->expected && row->failure.empty()) judge_row(group, *copula, *row);
  }
}

/// Of the rows of one family and quantity.
struct Summary {
  std::string family{};
  std::string quantity{};
  int rows = 0;
  int failures = 0;     ///< without a value
  int judged = 0;       ///< with a value and an expected one
  int passes = 0;       ///< as the best double included
  int best_double = 0;  ///< only as the best double
  const Row* worst = nullptr;
};

void count(Summary& summary, const Row& row) {
  ++summary.rows;
  summary.failures += !row.failure.empty();
  if (!row.failure.empty() || !row.expected) return;
  ++summary.judged;
  summary.passes += row.verdict.passes() || row.best_double;
  summary.best_double += row.best_double;
  const Verdict* worst = summary.worst == nullptr ? nullptr : &summary.worst->verdict;
  if (worst == nullptr || row.verdict.share > worst->share || std::isnan(row.verdict.share)) summary.worst = &row;
}

std::vector<Summary> summarise(const Table& table) {
  std::vector<Summary> summaries;
  for (const Row& row : table.rows) {
    const std::string& family = row.fields[kFamily];
    const std::string& quantity = row.fields[kQuantity];
    auto found = std::find_if(summaries.begin(), summaries.end(),
                              [&](const Summary& s) { return s.family == family && s.quantity == quantity; });
    if (found == summaries.end()) found = summaries.insert(found, Summary{.family = family, .quantity = quantity});
    count(*found, row);
  }
  return summaries;
}

std::string text_of(const Summary& summary) {
  std::string text = summary.family + " " + summary.quantity + ": " + std::to_string(summary.rows) + " rows";
  if (summary.failures > 0) text += ", " + std::to_string(summary.failures) + " without a value";
  if (summary.judged == 0) return text;
  text += ", " + std::to_string(summary.passes) + " of " + std::to_string(summary.judged) + " pass";
  if (summary.best_double > 0) {
    text += " (" + std::to_string(summary.best_double) + " as the best double there is)";
  }
  const Verdict& worst = summary.worst->verdict;
  char numbers[64];
  std::snprintf(numbers, sizeof numbers, "%.3g (%.3g of the bound)", worst.error, worst.share);
  return text + ", worst error " + numbers + " in line " + std::to_string(summary.worst->line);
}

std::string csv_of(const Table& table, bool with_expected) {
  std::string out;
  for (const std::string& name : table.header) out += name + ",";
  out += with_expected ? "value,error\n" : "value\n";
  for (const Row& row : table.rows) {
    for (const std::string& field : row.fields) out += csv_field(field) + ",";
    out += row.failure.empty() ? text_of(row) : in_quotes(text_of(row));
    if (with_expected) out += ",";
    if (row.expected && row.failure.empty()) out += digits(row.verdict.error);
    out += '\n';
  }
  return out;
}

std::string json_of(const Table& table, const std::vector<Summary>& summaries) {
  nlohmann::ordered_json document;
  for (const Row& row : table.rows) {
    nlohmann::ordered_json entry;
    for (std::size_t i = 0; i < row.fields.size(); ++i) entry[table.header[i]] = row.fields[i];
    const bool number = row.failure.empty() && row.digits.empty();
    entry["value"] = number ? json_number(row.value) : nlohmann::ordered_json(text_of(row));
    if (row.expected && row.failure.empty()) entry["error"] = json_number(row.verdict.error);
    document["rows"].push_back(std::move(entry));
  }
  for (const Summary& summary : summaries) {
    nlohmann::ordered_json entry{
        {"family", summary.family},          {"quantity", summary.quantity}, {"rows", summary.rows},
        {"failures", summary.failures},      {"judged", summary.judged},     {"passes", summary.passes},
        {"best_double", summary.best_double}};
    if (summary.worst != nullptr) {
      entry["worst_error"] = json_number(summary.worst->verdict.error);
      entry["worst_line"] = summary.worst->line;
    }
    document["summary"].push_back(std::move(entry));
  }
  return document.dump(1) + '\n';
}

void run(const Options& options, bool json) {
  Table table = read_table(options.path);
  for (auto& [key, group] : table.groups) answer(group, options);
  const std::vector<Summary> summaries = summarise(table);
  write_output(options.output, json ? json_of(table, summaries) : csv_of(table, table.header.size() > kExpected));
  for (const Summary& summary : summaries) std::cerr << text_of(summary) << '\n';
}

}  // namespace

void add_copula_table(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand(
      "table",
      "answer the rows of a CSV file: family,theta,quantity,d,u[,expected], several numbers with blanks between");
  const auto options = std::make_shared<Options>();
  command->add_option("FILE", options->path, "the rows")->required();
  const std::map<std::string, Level> levels = {
      {"fast", Level::fast}, {"standard", Level::standard}, {"symbolic", Level::symbolic}, {"exact", Level::exact}};
  command
      ->add_option("--accuracy", options->level,
                   "fast: single precision; standard: double; symbolic: double, from the formula of psi alone; exact: "
                   "as many digits as asked for")
      ->transform(CLI::CheckedTransformer(levels))
      ->default_str("standard");
  command->add_option("--digits", options->digits, "significant digits of --accuracy exact")
      ->check(CLI::Range(1, Copula::kMostDigits))
      ->capture_default_str();
  command->add_option("-o", options->output, "write here, not to standard output");
  finish_command(*command, common, [options, &common] { run(*options, common.json); });
}

}  // namespace sklar::cli
