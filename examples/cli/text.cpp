#include "examples/cli/text.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/inference/csv.hpp"
#include "families/registry.hpp"

namespace sklar::cli {

std::string digits(double value) {
  if (!std::isfinite(value)) return to_text(value);
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return buffer;
}

std::string digits(const std::vector<double>& values) {
  std::string out;
  for (const double value : values) out += (out.empty() ? "" : " ") + digits(value);
  return out;
}

nlohmann::ordered_json json_number(double value) {
  if (std::isfinite(value)) return value;
  return to_text(value);
}

nlohmann::ordered_json json_numbers(const std::vector<double>& values) {
  auto array = nlohmann::ordered_json::array();
  for (const double value : values) array.push_back(json_number(value));
  return array;
}

std::optional<double> parse_number(std::string_view text) {
  const std::string copy(text);
  if (copy.empty() || std::isspace(static_cast<unsigned char>(copy.front()))) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(copy.c_str(), &end);
  if (end != copy.c_str() + copy.size()) return std::nullopt;
  return value;
}

std::vector<double> parse_numbers(std::string_view text, char separator, std::string_view what) {
  std::vector<double> numbers;
  const char separators[] = {separator, ' ', '\t', '\0'};
  for (std::size_t begin = 0; (begin = text.find_first_not_of(separators, begin)) != std::string_view::npos;) {
    const std::string_view item = text.substr(begin, text.find_first_of(separators, begin) - begin);
    const std::optional<double> number = parse_number(item);
    if (!number) throw std::invalid_argument(std::string(what) + ": '" + std::string(item) + "' is not a number");
    numbers.push_back(*number);
    begin += item.size();
  }
  return numbers;
}

std::vector<std::string> split_csv(std::string_view line) {
  std::vector<std::string> fields(1);
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && inside && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"') {
      inside = !inside;
    } else if (c == ',' && !inside) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) out.append(c == '"' ? 2 : 1, c);
  return out + '"';
}

std::string csv_field(std::string_view field) {
  return field.find_first_of(",\"") == std::string_view::npos ? std::string(field) : in_quotes(field);
}

std::vector<const FamilyInfo*> parse_families(std::string_view names) {
  std::vector<const FamilyInfo*> chosen;
  if (names == "all") {
    for (const FamilyInfo& family : families::all()) chosen.push_back(&family);
  } else {
    for (const std::string& name : split_csv(names)) chosen.push_back(&families::resolve(name));
  }
  return chosen;
}

std::string aligned(const std::vector<Cells>& rows) {
  std::vector<std::size_t> width(rows.front().size(), 0);
  for (const Cells& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
  }
  std::string out;
  for (const Cells& row : rows) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i) out += row[i] + std::string(width[i] + 2 - row[i].size(), ' ');
    out += row.back() + '\n';
  }
  return out;
}

void write_output(const std::string& path, std::string_view text) {
  if (!path.empty()) return write_file(path, text);
  std::cout << text << std::flush;
  if (!std::cout) throw FileError("standard output", "cannot be written");
}

void print_json(const nlohmann::ordered_json& document) {
  write_output("", document.dump(2) + '\n');
}

nlohmann::ordered_json json_rows(const PointsRef& rows) {
  auto array = nlohmann::ordered_json::array();
  for (Index row = 0; row < rows.rows(); ++row) {
    array.push_back(json_numbers(std::vector<double>(rows.row(row).begin(), rows.row(row).end())));
  }
  return array;
}

void write_table(const std::string& path, const std::vector<std::string>& columns, const PointsRef& rows, bool json) {
  if (!json) return write_output(path, to_csv(columns, rows));
  const nlohmann::ordered_json document{{"columns", columns}, {"rows", json_rows(rows)}};
  write_output(path, document.dump() + '\n');
}

}  // namespace sklar::cli
