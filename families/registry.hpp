#pragma once
/// Families by name. The list of those registered is families/CMakeLists.txt; any of them may be rotated: `clayton@180`
/// is the survival copula, `clayton@90` and `clayton@270` are for dimension 2, `clayton@u1+u3` reflects chosen
/// coordinates in more (see copula/rotation.hpp).

#include <span>
#include <string_view>

#include "copula/family.hpp"

namespace sklar::families {

/// Every registered family, in the order of the list.
[[nodiscard]] std::span<const FamilyInfo> all();

/// A registered family or a rotation of one; what is returned lives as long as the program.
/// @throws std::invalid_argument naming the unknown family and listing the known ones, or naming the unknown rotation.
[[nodiscard]] const FamilyInfo& find(std::string_view name);

/// As find; what ends in .json, before `@ROTATION`, is a file that defines a family (symbolic/family_definition.hpp) or
/// holds a copula with its parameters (inference/model_io.hpp). A file is read once.
/// @throws as find and from_definition; FileError also for a file that cannot be read.
[[nodiscard]] const FamilyInfo& resolve(std::string_view name_or_path);

/// The family that a JSON text defines, see family_from_json. @param source names the text in errors.
/// @throws FileError naming source, field, what was found and what is allowed; also for the name of a registered
/// family.
[[nodiscard]] FamilyInfo from_definition(std::string_view json, std::string_view source);

}  // namespace sklar::families
