#pragma once
/// Numbers and lines in and out.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "copula/family.hpp"

namespace sklar::cli {

/// 17 significant digits; -inf, inf and nan spelt so.
[[nodiscard]] std::string digits(double value);

/// Several, with blanks between.
[[nodiscard]] std::string digits(const std::vector<double>& values);

/// A JSON number, or one of the strings "-inf", "inf", "nan".
[[nodiscard]] nlohmann::ordered_json json_number(double value);
[[nodiscard]] nlohmann::ordered_json json_numbers(const std::vector<double>& values);

/// The nearest double of the whole text; empty for anything else. Beyond the range: 0 or an infinity.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// Numbers separated by blanks or by the given separator. @throws std::invalid_argument naming what and the bad item.
[[nodiscard]] std::vector<double> parse_numbers(std::string_view text, char separator, std::string_view what);

/// The fields of one CSV line; a field may stand in double quotes, a quote inside it doubled.
[[nodiscard]] std::vector<std::string> split_csv(std::string_view line);

/// The text in quotes, as CSV.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// The field as CSV: in quotes where it holds a comma or a quote.
[[nodiscard]] std::string csv_field(std::string_view field);

/// What an option that names a family takes, and one that names several.
inline constexpr const char* kFamilyHelp =
    "a name of `sklar families`, a file FAMILY.json or MODEL.json; with @180 (survival), @90, @270 or coordinates as "
    "@u1+u3 behind it, rotated";
inline constexpr const char* kFamiliesHelp =
    "all, or names and files separated by commas; with @180 (survival), @90, @270 or coordinates as @u1+u3 behind one, "
    "rotated";

/// The families of a list of names and files separated by commas; `all` is every registered one. @throws as
/// families::resolve.
[[nodiscard]] std::vector<const FamilyInfo*> parse_families(std::string_view names);

/// Rows of a table to read, all with as many cells: columns padded to one width, two blanks between them.
using Cells = std::vector<std::string>;
[[nodiscard]] std::string aligned(const std::vector<Cells>& rows);

/// To standard output, or, where path is not empty, to a file, whole or not at all. @throws FileError
void write_output(const std::string& path, std::string_view text);

/// To standard output. @throws FileError
void print_json(const nlohmann::ordered_json& document);

/// Rows of an array. With write_output: as CSV, or as {"columns": [..], "rows": [[..], ..]}.
[[nodiscard]] nlohmann::ordered_json json_rows(const PointsRef& rows);
void write_table(const std::string& path, const std::vector<std::string>& columns, const PointsRef& rows, bool json);

}  // namespace sklar::cli
