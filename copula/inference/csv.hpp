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
  std::vector<Index> lines = {};   ///< n, the line of the text in which a row starts, from 1
  Index dropped = 0;               ///< rows left out by Missing::drop
};

/// What a missing value is: an empty field, NA, NaN, nan or a single point.
enum class Missing {
  number,  ///< nan is the number NaN, the others are errors
  refuse,  ///< an error that counts them
  drop     ///< its row is left out
};

/// Which columns and rows of a text are read.
struct CsvOptions {
  std::vector<std::string> columns = {};  ///< read these, in this order; none for all. The others may hold any text.
  Missing missing = Missing::number;
};

/// A header line, then one number a column in every line. Numbers as in C without a leading plus; inf, -inf and nan are
/// numbers. Fields may stand in double quotes, which allow commas and line ends inside, a quote inside doubled (RFC
/// 4180). Blanks around a field, a carriage return at the end of a line and blank lines at the end of the text are
/// ignored. @param source names the text in errors.
/// @throws FileError naming the source and the line: empty text, a header of numbers, a missing, extra or bad field, a
/// quote that is not closed, a name that is not UTF-8; for a column that is not there, or there twice; for missing
/// values as chosen.
[[nodiscard]] Table parse_csv(std::string_view text, std::string_view source, const CsvOptions& options = {});

/// parse_csv of a file. @throws FileError also for a missing file or a directory.
[[nodiscard]] Table read_csv(const std::filesystem::path& path, const CsvOptions& options = {});

/// Header and rows, each number with the 17 significant digits that give back the same double; a name with a comma, a
/// quote, a line end or blanks around it in quotes.
/// @throws std::invalid_argument unless there is one name a column.
[[nodiscard]] std::string to_csv(std::span<const std::string> names, const PointsRef& values);

}  // namespace sklar
