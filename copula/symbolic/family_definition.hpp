#pragma once
/// A copula family as its author writes it down: psi, its parameters and their bounds, as text.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "copula/types.hpp"

namespace sklar::symbolic {

/// Bounds are a number, "inf", "-inf" or a formula in the dimension d, such as "-1/(d-1)".
struct ParameterDefinition {
  std::string name;
  std::string lowest;
  std::string highest;
  bool lowest_included = true;
  bool highest_included = true;
};

struct FamilyDefinition {
  std::string name;         ///< lower-case letters, digits, - and _
  std::string title;        ///< as printed
  std::string psi;          ///< in t and the parameters, see parser.hpp
  std::string psi_inverse;  ///< in u and the parameters, or empty
  std::string source;       ///< reference
  std::vector<ParameterDefinition> parameters;
  std::vector<Theta> examples;  ///< weak, medium, strong dependence
};

/// The newest version written and read.
inline constexpr int kFamilyVersion = 1;

/// {"format": "sklar family", "version": 1, "name": .., "title": .., "psi": .., "psi_inverse": .., "source": ..,
/// "parameters": [{"name": .., "lowest": .., "highest": .., "lowest_included": .., "highest_included": ..}],
/// "examples": [[..], ..]} on one line. psi_inverse may be missing, and each .._included, which is then true.
[[nodiscard]] std::string to_json(const FamilyDefinition& definition);

/// @param source names the text in errors. @throws FileError naming the source and the field: not JSON, not this
/// format, a newer version, a field missing, unknown or of the wrong type, a parameter without bounds. Whether the
/// formulas mean anything is for make_family to say.
[[nodiscard]] FamilyDefinition parse_definition(std::string_view json, std::string_view source);

}  // namespace sklar::symbolic
