#pragma once
/// Argument checks of the analytic models.

#include <string_view>

#include "brdf/brdf.hpp"
#include "copula/family.hpp"

namespace sklar::brdf {

/// @throws std::domain_error naming model, argument, interval and value unless the value is inside.
void require_inside(std::string_view model, std::string_view argument, const Interval& interval, double value);

/// The same for each channel.
void require_inside(std::string_view model, std::string_view argument, const Interval& interval, const Rgb& value);

}  // namespace sklar::brdf
