#pragma once
/// The registered families. The list is families/CMakeLists.txt.

#include <span>
#include <string_view>

#include "copula/family.hpp"

namespace sklar::families {

/// Every registered family, in the order of the list.
[[nodiscard]] std::span<const FamilyInfo> all();

/// @throws std::invalid_argument naming the unknown family and listing the known ones.
[[nodiscard]] const FamilyInfo& find(std::string_view name);

}  // namespace sklar::families
