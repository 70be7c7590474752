#include "examples/cli/table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "examples/cli/text.hpp"
#include "families/registry.hpp"

namespace sklar::cli {
namespace {

const std::vector<std::string> kHeader{"family", "theta", "quantity", "d", "u", "expected"};

int parse_dim(const std::string& text) {
  const std::optional<double> d = parse_number(text);
  if (!d || *d < 2 || *d > 1e6 || *d != std::floor(*d)) {
    throw std::invalid_argument("d must be a whole number from 2, got '" + text + "'");
  }
  return static_cast<int>(*d);
}

/// The group that a row belongs to, without its rows. @throws std::invalid_argument for a row that has no meaning.
Group parse_group(const std::vector<std::string>& fields) {
  Group group{&families::resolve(fields[kFamily]),
              parse_numbers(fields[kTheta], ' ', "theta"),
              parse_dim(fields[kDim]),
              find_quantity(fields[kQuantity]),
              {}};
  if (group.theta.size() != group.family->parameters.size()) {
    throw std::invalid_argument(fields[kFamily] + " takes " + std::to_string(group.family->parameters.size()) +
                                " parameters, got " + std::to_string(group.theta.size()));
  }
  return group;
}

Row parse_row(std::size_t line, std::vector<std::string> fields, const Group& group) {
  Row row{.line = line, .fields = std::move(fields)};
  row.arguments = parse_numbers(row.fields[kU], ' ', "u");
  const std::size_t wanted = group.quantity.order ? 1 : static_cast<std::size_t>(group.dim);
  if (row.arguments.size() != wanted) {
    throw std::invalid_argument("u must hold " + std::to_string(wanted) + " numbers, got " +
                                std::to_string(row.arguments.size()));
  }
  if (row.fields.size() > kExpected && !row.fields[kExpected].empty()) {
    row.expected = parse_expected(row.fields[kExpected]);
    if (!row.expected) throw std::invalid_argument("expected: '" + row.fields[kExpected] + "' is not a number");
  }
  return row;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.remove_suffix(1);
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

void add_row(Table& table, std::size_t line, std::string_view text) {
  std::vector<std::string> fields = split_csv(text);
  if (fields.size() != table.header.size()) {
    throw std::invalid_argument("must have " + std::to_string(table.header.size()) + " fields, got " +
                                std::to_string(fields.size()));
  }
  const std::vector<std::string> key(fields.begin(), fields.begin() + kU);
  auto group = table.groups.find(key);
  if (group == table.groups.end()) group = table.groups.emplace(key, parse_group(fields)).first;
  table.rows.push_back(parse_row(line, std::move(fields), group->second));
  group->second.rows.push_back(&table.rows.back());
}

}  // namespace

Table read_table(const std::string& path) {
  const std::string text = read_file(path);
  const std::vector<std::string_view> lines = lines_of(text);
  Table table;
  if (!lines.empty()) table.header = split_csv(lines.front());
  if (table.header != kHeader && table.header != std::vector(kHeader.begin(), kHeader.end() - 1)) {
    throw FileError(path, "line 1: the header must be family,theta,quantity,d,u or family,theta,quantity,d,u,expected");
  }
  for (std::size_t i = 1; i < lines.size(); ++i) {
    try {
      add_row(table, i + 1, lines[i]);
    } catch (const std::invalid_argument& error) {
      throw FileError(path, "line " + std::to_string(i + 1) + ": " + error.what());
    }
  }
  return table;
}

}  // namespace sklar::cli
