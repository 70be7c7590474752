#pragma once
/// A family given as formulas, as every other family is known.

#include "copula/family.hpp"
#include "copula/symbolic/family_definition.hpp"

namespace sklar::symbolic {

/// Copulas in dimensions 2 to kMaxDimension, each checked by require_generator when it is made. tau by quadrature to
/// 1e-10; theta_from_tau by a search where there is one parameter and tau is monotone in it, else empty; tails as
/// limits far out. tau at an end of a domain that does not belong to it is the limit there to 9 decimals.
/// FamilyInfo::definition is to_json(definition).
/// @throws std::invalid_argument naming the field: a formula that cannot be read (with a caret under the place), a name
/// that cannot be one, examples outside the bounds.
[[nodiscard]] FamilyInfo make_family(const FamilyDefinition& definition);

/// The same family, its copulas made from the text of psi alone, as those of make_family are: no closed form of a
/// density, a conditional or its inverse. For comparisons. Dimensions up to kMaxDimension.
/// @throws std::invalid_argument for a family without psi.
[[nodiscard]] FamilyInfo formula_of(const FamilyInfo& family);

}  // namespace sklar::symbolic
