#include "brdf/study/table_text.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "copula/error.hpp"

namespace sklar::brdf {

std::string printed(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return std::isfinite(value) ? buffer : sklar::to_text(value);
}

double to_digits(int digits, double value) {
  const std::string text = printed(("%." + std::to_string(digits) + "g").c_str(), value);
  return std::strtod(text.c_str(), nullptr);  // std::stod throws below the smallest normal number
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

}  // namespace sklar::brdf
