#pragma once
/// Data-driven and linear reflectance models by name. The list of them is brdf/basis/CMakeLists.txt.

#include <span>
#include <string_view>

#include "brdf/basis/info.hpp"

namespace sklar::brdf::basis {

/// Every registered model, in the order of the list.
[[nodiscard]] std::span<const BasisInfo> all();

/// @throws std::invalid_argument naming the unknown model and listing the known ones.
[[nodiscard]] const BasisInfo& find(std::string_view name);

}  // namespace sklar::brdf::basis
