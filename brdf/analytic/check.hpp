#pragma once
/// Argument checks of the analytic models.

#include <string_view>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// @throws std::domain_error naming model, argument and value unless each channel is in [0,1].
void require_unit_rgb(std::string_view model, std::string_view argument, const Rgb& value);

}  // namespace sklar::brdf
