#pragma once
/// Argument checks shared by the estimators. Each failure names function, argument, row, value and what is allowed.

#include <string_view>

#include "copula/types.hpp"

namespace sklar {

/// @throws std::invalid_argument for fewer than `fewest` rows.
void require_enough_rows(std::string_view function, std::string_view argument, Index rows, Index fewest);

/// @throws std::domain_error naming the first entry that is not finite.
void require_finite(std::string_view function, std::string_view argument, const PointsRef& x);

/// @throws std::domain_error naming the first entry that is not strictly inside (0,1); NaN is not.
void require_open_unit_cube(std::string_view function, std::string_view argument, const PointsRef& u);

/// No weights (size 0) means one each.
/// @throws std::invalid_argument for a wrong number of weights or when all are zero, std::domain_error naming the first
/// that is negative or not finite.
void require_weights(std::string_view function, const ColumnRef& weights, Index rows);

/// Points of a copula to be fitted: n >= 2 rows, d >= 2 columns, inside the open cube, with weights as above.
void require_sample(std::string_view function, const PointsRef& u, const ColumnRef& weights);

}  // namespace sklar
