#pragma once
/// Cells of the tables that studies write.

#include <string>

namespace sklar::brdf {

/// By a format of printf for one double; inf, -inf and nan as to_text.
[[nodiscard]] std::string printed(const char* format, double value);

/// To so many significant digits, for JSON that is kept short.
[[nodiscard]] double to_digits(int digits, double value);

/// A field of CSV: in quotes where it holds a comma, a quote or an end of line.
[[nodiscard]] std::string csv_field(const std::string& text);

}  // namespace sklar::brdf
