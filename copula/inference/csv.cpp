#include "copula/inference/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "copula/json_fields.hpp"
#include "copula/listed.hpp"

namespace sklar {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

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

bool is_missing(std::string_view field) {
  return field.empty() || field == "." || field == "NA" || field == "NaN" || field == "nan";
}

class CsvParser {
 public:
  CsvParser(std::string_view source, const CsvOptions& options) : source_(source), options_(options) {}

  Table parse(std::string_view text) {
    if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
    rest_ = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
    if (rest_.empty()) throw FileError(source_, "is empty; expected a header line and rows of numbers");
    read_record();
    read_header();
    while (!rest_.empty()) {
      read_record();
      read_row();
    }
    if (missing_ > 0 && options_.missing == Missing::refuse) refuse_missing();
    const auto columns = static_cast<Index>(table_.names.size());
    using RowMajor = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto rows = static_cast<Index>(numbers_.size()) / columns;
    table_.values = Eigen::Map<const RowMajor>(numbers_.data(), rows, columns);
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw FileError(source_, "line " + std::to_string(line_) + ": " + what);
  }

  [[noreturn]] void refuse_missing() const {
    const Index rows = static_cast<Index>(table_.lines.size()) + incomplete_;
    throw FileError(source_, std::to_string(missing_) + (missing_ == 1 ? " value is" : " values are") + " missing in " +
                                 std::to_string(incomplete_) + " of " + std::to_string(rows) + " rows, the first in " +
                                 first_missing_ + "; drop such rows (missing: drop) or choose other columns");
  }

  /// Takes the record that starts in line_ off the front.
  void read_record() {
    line_ = next_line_;
    fields_.clear();
    for (bool more = true; more;) {
      fields_.push_back(take_field());
      more = rest_.starts_with(',');
      if (!rest_.empty()) rest_.remove_prefix(1);
    }
    ++next_line_;
  }

  /// Takes the text up to the next comma or line end, which stays.
  std::string take_field() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t"), rest_.size()));
    if (rest_.starts_with('"')) return take_quoted();
    const std::string_view field = rest_.substr(0, rest_.find_first_of(",\n"));
    rest_.remove_prefix(field.size());
    return std::string(trimmed(field));
  }

  std::string take_quoted() {
    std::string field;
    for (bool first = true; rest_.starts_with('"'); first = false) {
      const std::size_t end = rest_.find('"', 1);
      if (end == std::string_view::npos) fail("a quote is not closed");
      // A quote that opens again at once is one inside the field.
      field += rest_.substr(first ? 1 : 0, first ? end - 1 : end);
      next_line_ += std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(end), '\n');
      rest_.remove_prefix(end + 1);
    }
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r"), rest_.size()));
    if (!rest_.empty() && !rest_.starts_with(',') && !rest_.starts_with('\n')) fail("text behind a closing quote");
    return field;
  }

  void read_header() {
    if (options_.columns.empty()) {
      for (std::size_t i = 0; i < fields_.size(); ++i) chosen_.push_back(i);
    }
    for (const std::string& name : options_.columns) chosen_.push_back(position_of(name));
    bool numeric = true;
    for (const std::size_t i : chosen_) {
      if (fields_[i].empty()) fail("column " + std::to_string(i + 1) + " has no name");
      require_utf8(i);
      numeric = numeric && number(fields_[i]);
      table_.names.push_back(fields_[i]);
    }
    if (numeric) fail("expected a header with the names of the columns, found numbers");
    width_ = fields_.size();
  }

  void require_utf8(std::size_t column) const {
    try {
      json::require_utf8("its name", fields_[column]);
    } catch (const std::invalid_argument& error) {
      fail("column " + std::to_string(column + 1) + ": " + error.what());
    }
  }

  [[nodiscard]] std::size_t position_of(const std::string& name) const {
    const auto found = std::find(fields_.begin(), fields_.end(), name);
    if (found == fields_.end()) fail("no column '" + name + "'; columns: " + listed(fields_));
    if (std::find(found + 1, fields_.end(), name) != fields_.end()) fail("two columns are named '" + name + "'");
    return static_cast<std::size_t>(found - fields_.begin());
  }

  void read_row() {
    if (fields_.size() == 1 && fields_[0].empty()) fail("is blank");
    if (fields_.size() != width_) {
      fail("expected " + std::to_string(width_) + " fields, found " + std::to_string(fields_.size()));
    }
    const std::size_t before = numbers_.size();
    Index missing = 0;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      const std::string_view field = trimmed(fields_[chosen_[i]]);
      if (options_.missing != Missing::number && is_missing(field)) {
        if (missing_ + missing++ == 0) first_missing_ = "line " + std::to_string(line_) + ", column " + table_.names[i];
        continue;
      }
      const std::optional<double> value = number(field);
      if (!value) fail("column " + table_.names[i] + ": '" + std::string(field) + "' is not a number");
      numbers_.push_back(*value);
    }
    if (missing == 0) return table_.lines.push_back(line_);
    numbers_.resize(before);
    missing_ += missing;
    ++incomplete_;
    if (options_.missing == Missing::drop) ++table_.dropped;
  }

  std::string_view source_;
  const CsvOptions& options_;
  std::string_view rest_;
  Index line_ = 0;
  Index next_line_ = 1;
  std::size_t width_ = 0;  ///< fields of the header
  std::vector<std::string> fields_;
  std::vector<std::size_t> chosen_;  ///< positions of the columns read
  std::vector<double> numbers_;      ///< row by row
  Index missing_ = 0;
  Index incomplete_ = 0;  ///< rows with a missing value
  std::string first_missing_;
  Table table_;
};

/// A name as a header says it.
std::string quoted_if_needed(const std::string& name) {
  const bool plain = name.find_first_of(",\"\r\n") == std::string::npos && name == trimmed(name);
  if (plain && !name.starts_with(kByteOrderMark)) return name;
  std::string text = "\"";
  for (const char c : name) text.append(c == '"' ? 2 : 1, c);
  return text + '"';
}

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

Table parse_csv(std::string_view text, std::string_view source, const CsvOptions& options) {
  return CsvParser(source, options).parse(text);
}

Table read_csv(const std::filesystem::path& path, const CsvOptions& options) {
  const std::string text = read_file(path);
  return parse_csv(text, path.string(), options);
}

std::string to_csv(std::span<const std::string> names, const PointsRef& values) {
  require_columns("to_csv", "values", values.cols(), static_cast<Index>(names.size()),
                  static_cast<Index>(names.size()));
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : ",") + quoted_if_needed(names[i]);
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
