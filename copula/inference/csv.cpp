#include "copula/inference/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "copula/error.hpp"
#include "copula/file.hpp"

namespace sklar {
namespace {

std::string_view trimmed(std::string_view field) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = field.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return field.substr(first, field.find_last_not_of(kBlank) - first + 1);
}

std::optional<double> number(std::string_view field) {
  double value = 0;
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (error != std::errc() || stop != end || field.empty()) return std::nullopt;
  return value;
}

/// Takes the text up to the separator off the front.
std::string_view take(std::string_view& text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view front = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return front;
}

/// Calls body(field, position) for every field of a line; a line has at least one.
template <class Body>
void for_each_field(std::string_view line, Body body) {
  const auto fields = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
  for (std::size_t i = 0; i < fields; ++i) body(trimmed(take(line, ',')), i);
}

class CsvParser {
 public:
  explicit CsvParser(std::string_view source) : source_(source) {}

  Table parse(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
    text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
    if (text.empty()) throw FileError(source_, "is empty; expected a header line and rows of numbers");
    read_header(next_line(text));
    while (!text.empty()) read_row(next_line(text));
    const auto columns = static_cast<Index>(names_.size());
    using RowMajor = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto rows = static_cast<Index>(numbers_.size()) / columns;
    return {std::move(names_), Eigen::Map<const RowMajor>(numbers_.data(), rows, columns)};
  }

 private:
  std::string_view next_line(std::string_view& text) {
    ++line_;
    return take(text, '\n');
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw FileError(source_, "line " + std::to_string(line_) + ": " + what);
  }

  void read_header(std::string_view line) {
    bool numeric = true;
    for_each_field(line, [&](std::string_view field, std::size_t i) {
      if (field.empty()) fail("column " + std::to_string(i + 1) + " has no name");
      numeric = numeric && number(field);
      names_.emplace_back(field);
    });
    if (numeric) fail("expected a header with the names of the columns, found numbers");
  }

  void read_row(std::string_view line) {
    const auto fields = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
    if (trimmed(line).empty()) fail("is blank");
    if (fields != names_.size()) {
      fail("expected " + std::to_string(names_.size()) + " fields, found " + std::to_string(fields));
    }
    for_each_field(line, [&](std::string_view field, std::size_t i) {
      const std::optional<double> value = number(field);
      if (!value) fail("column " + names_[i] + ": '" + std::string(field) + "' is not a number");
      numbers_.push_back(*value);
    });
  }

  std::string_view source_;
  std::size_t line_ = 0;
  std::vector<std::string> names_;
  std::vector<double> numbers_;  ///< row by row
};

void append_number(std::string& text, double value) {
  if (!std::isfinite(value)) {
    text += to_text(value);
    return;
  }
  char buffer[32];
  constexpr int kDigits = 17;
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, kDigits).ptr);
}

}  // namespace

Table parse_csv(std::string_view text, std::string_view source) {
  return CsvParser(source).parse(text);
}

Table read_csv(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  return parse_csv(text, path.string());
}

std::string to_csv(std::span<const std::string> names, const PointsRef& values) {
  require_columns("to_csv", "values", values.cols(), static_cast<Index>(names.size()),
                  static_cast<Index>(names.size()));
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : ",") + names[i];
  text += '\n';
  for (Index row = 0; row < values.rows(); ++row) {
    for (Index column = 0; column < values.cols(); ++column) {
      if (column > 0) text += ',';
      append_number(text, values(row, column));
    }
    text += '\n';
  }
  return text;
}

}  // namespace sklar
