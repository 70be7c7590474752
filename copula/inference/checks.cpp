#include "copula/inference/checks.hpp"

#include <cmath>
#include <string>

#include "copula/error.hpp"

namespace sklar {
namespace {

std::string refusal(std::string_view function, std::string_view argument, std::string_view allowed,
                    const std::string& entry) {
  return std::string(function) + ": " + std::string(argument) + " must be " + std::string(allowed) + ", got " + entry;
}

template <class Admissible>
void require_entries(std::string_view function, std::string_view argument, const PointsRef& x, std::string_view allowed,
                     Admissible admissible) {
  for (Index column = 0; column < x.cols(); ++column) {
    for (Index row = 0; row < x.rows(); ++row) {
      if (admissible(x(row, column))) continue;
      throw std::domain_error(refusal(function, argument, allowed,
                                      std::string(argument) + "(" + std::to_string(row) + "," + std::to_string(column) +
                                          ") = " + to_text(x(row, column))));
    }
  }
}

}  // namespace

void require_enough_rows(std::string_view function, std::string_view argument, Index rows, Index fewest) {
  if (rows >= fewest) return;
  throw std::invalid_argument(std::string(function) + ": " + std::string(argument) + " must have " +
                              std::to_string(fewest) + " or more rows, got " + std::to_string(rows));
}

void require_finite(std::string_view function, std::string_view argument, const PointsRef& x) {
  require_entries(function, argument, x, "finite", [](double value) { return std::isfinite(value); });
}

void require_open_unit_cube(std::string_view function, std::string_view argument, const PointsRef& u) {
  require_entries(function, argument, u, "in (0,1)", [](double value) { return value > 0 && value < 1; });
}

void require_weights(std::string_view function, const ColumnRef& weights, Index rows) {
  if (weights.size() == 0) return;
  require_rows(function, "weights", weights.rows(), rows);
  require_entries(function, "weights", weights, "finite and 0 or more",
                  [](double value) { return std::isfinite(value) && value >= 0; });
  if (!(weights > 0).any()) throw std::invalid_argument(std::string(function) + ": all weights are zero");
}

void require_sample(std::string_view function, const PointsRef& u, const ColumnRef& weights) {
  require_enough_rows(function, "u", u.rows(), 2);
  if (u.cols() < 2) {
    throw std::invalid_argument(std::string(function) + ": u must have 2 or more columns, got " +
                                std::to_string(u.cols()));
  }
  require_open_unit_cube(function, "u", u);
  require_weights(function, weights, u.rows());
}

}  // namespace sklar
