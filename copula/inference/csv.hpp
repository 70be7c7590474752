#pragma once
/// Numeric tables as comma-separated text with one header line.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "copula/types.hpp"

namespace sklar {

/// Named columns of numbers.
struct Table {
  std::vector<std::string> names;  ///< d column names
  Points values;                   ///< n x d
};

/// Strict: a header line, then one number a column in every line. Numbers as in C without a leading plus; inf, -inf and
/// nan are numbers. Blanks around a field, a carriage return at the end of a line and blank lines at the end of the
/// text are ignored. @param source names the text in errors.
/// @throws FileError naming the source and the line: empty text, a header of numbers, a missing, extra or bad field.
[[nodiscard]] Table parse_csv(std::string_view text, std::string_view source);

/// parse_csv of a file. @throws FileError also for a missing file or a directory.
[[nodiscard]] Table read_csv(const std::filesystem::path& path);

/// Header and rows, each number with the 17 significant digits that give back the same double.
/// @throws std::invalid_argument unless there is one name a column.
[[nodiscard]] std::string to_csv(std::span<const std::string> names, const PointsRef& values);

}  // namespace sklar
