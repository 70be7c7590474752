#pragma once
/// Analytic reflectance models by name. The list of them is brdf/analytic/CMakeLists.txt.

#include <span>
#include <string_view>

#include "brdf/analytic/info.hpp"

namespace sklar::brdf::analytic {

/// Every registered model, in the order of the list.
[[nodiscard]] std::span<const AnalyticInfo> all();

/// @throws std::invalid_argument naming the unknown model and listing the known ones.
[[nodiscard]] const AnalyticInfo& find(std::string_view name);

}  // namespace sklar::brdf::analytic
