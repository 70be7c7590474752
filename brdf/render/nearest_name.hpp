#pragma once
/// What was probably meant.

#include <span>
#include <string>
#include <string_view>

namespace sklar::brdf {

/// The one with the fewest letters to insert, delete or replace, the first of equals. Precondition: known is not empty.
[[nodiscard]] std::string nearest_name(std::string_view name, std::span<const std::string> known);

}  // namespace sklar::brdf
