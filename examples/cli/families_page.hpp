#pragma once
/// docs/families.md.

#include <span>
#include <string>

#include "copula/family.hpp"

namespace sklar::cli {

/// Formulas, domains and dependence of the families as Markdown with LaTeX.
[[nodiscard]] std::string families_page(std::span<const FamilyInfo* const> families);

}  // namespace sklar::cli
