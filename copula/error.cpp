#include "copula/error.hpp"

#include <charconv>
#include <cmath>

#include "copula/unit_interval.hpp"

namespace sklar {

FileError::FileError(std::string_view path, std::string_view what)
    : std::runtime_error(std::string(path) + ": " + std::string(what)) {}

std::string to_text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

void require_columns(std::string_view function, std::string_view argument, Index columns, Index lowest, Index highest) {
  if (columns >= lowest && columns <= highest) return;
  std::string allowed = std::to_string(lowest);
  if (highest != lowest) allowed += " to " + std::to_string(highest);
  throw std::invalid_argument(std::string(function) + ": " + std::string(argument) + " must have " + allowed +
                              " columns, got " + std::to_string(columns));
}

void require_rows(std::string_view function, std::string_view argument, Index rows, Index expected) {
  if (rows == expected) return;
  throw std::invalid_argument(std::string(function) + ": " + std::string(argument) + " must have " +
                              std::to_string(expected) + " rows, got " + std::to_string(rows));
}

void require_unit_cube(std::string_view function, std::string_view argument, const PointsRef& u) {
  for (Index column = 0; column < u.cols(); ++column) {
    if (none_outside_unit_interval(u.col(column).data(), u.rows())) continue;
    for (Index row = 0; row < u.rows(); ++row) {
      const double value = u(row, column);
      if (value < 0 || value > 1) {
        throw std::domain_error(std::string(function) + ": " + std::string(argument) + " must be in [0,1], got " +
                                std::string(argument) + "(" + std::to_string(row) + "," + std::to_string(column) +
                                ") = " + to_text(value));
      }
    }
  }
}

}  // namespace sklar
