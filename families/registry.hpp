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

/// A registered family, or, where the argument ends in .json, the family that this file defines (see
/// symbolic/family_definition.hpp). A file is read once; what is returned lives as long as the program.
/// @throws as find and from_definition; FileError also for a file that cannot be read.
[[nodiscard]] const FamilyInfo& resolve(std::string_view name_or_path);

/// The family that a JSON text defines. @param source names the text in errors.
/// @throws FileError naming source, field, what was found and what is allowed; also for the name of a registered
/// family.
[[nodiscard]] FamilyInfo from_definition(std::string_view json, std::string_view source);

}  // namespace sklar::families
