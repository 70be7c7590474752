#pragma once
/// Families by name: those of a list, and rotations of them.

#include <optional>
#include <span>
#include <string_view>

#include "copula/family.hpp"

namespace sklar {

/// The family of the copulas of another one, rotated: "clayton@180", with psi that of the base. 180 exchanges the
/// tails; 90 and 270 turn tau over, and have tail dependence in the countermonotone limit alone, where they are
/// comonotone: in the corners (0,1) and (1,0) an Archimedean copula with a density has none, as C(1-t, t) / t -> 1 for
/// t -> 0. Of a list of coordinates tau and tails are NaN, since pairs differ, and tau has no inverse.
/// @throws std::invalid_argument for a base that is rotated already, and where base and rotation have no dimension in
/// common.
[[nodiscard]] FamilyInfo rotated_family(const FamilyInfo& base, const Rotation& rotation);

/// The one with this name, without rotation. @throws std::invalid_argument listing the known ones.
[[nodiscard]] const FamilyInfo& find_family(std::string_view name, std::span<const FamilyInfo> families);

/// A name and, after its last @, that of a rotation.
struct RotatedName {
  std::string_view base;
  std::optional<std::string_view> rotation;
};

/// A name such as `clayton@180` in its parts. @throws std::invalid_argument for an unknown rotation.
[[nodiscard]] RotatedName split_rotation(std::string_view name);

}  // namespace sklar
