#pragma once
/// A copula, of one family or a mixture, with its margins as versioned JSON; every double survives the round trip bit
/// for bit.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "copula/family.hpp"
#include "copula/inference/joint.hpp"
#include "copula/inference/margin_fit.hpp"

namespace sklar {

/// A copula of one family, with its weight.
struct ModelComponent {
  std::string family;  ///< FamilyInfo::name
  Theta theta;
  std::string definition{};  ///< FamilyInfo::definition
  double weight = 1;         ///< in a mixture
};

/// What a file holds.
struct CopulaModel {
  int dim = 0;
  std::vector<ModelComponent> components;  ///< one, or those of a mixture
  std::vector<StoredMarginal> margins{};   ///< one a dimension, or none for the copula alone
  std::string name{};                      ///< of the model, or empty
  std::vector<std::string> columns{};      ///< names, one a dimension and no two the same, or none
};

/// The newest version written and read.
inline constexpr int kModelVersion = 4;

/// One family: {"format": "sklar copula", "version": 1, "family": .., "dim": .., "theta": [..], "margins": [..]} with
/// margins {"kind": "histogram", "edges": [..], "masses": [..]} and {"kind": "empirical", "values": [..]}, ended by a
/// newline. "family" is a name, or the whole definition of a family that is not registered, so that the model stands
/// alone. Version 2, written for what version 1 lacks: rotated families, by name or {"rotation": "180", "family":
/// definition}; a "name" of the model; and for a mixture, in place of family and theta,
/// "components": [{"weight": .., "family": .., "theta": [..]}, ..]. Version 3: margins {"kind": "normal", "mean": ..,
/// "sd": ..}, {"kind": "gamma", "shape": .., "scale": ..}, {"kind": "beta", "a": .., "b": .., "lowest": .., "highest":
/// ..} and {"kind": "kernel", "values": [..], "bandwidth": ..}, and "weights": [..] of empirical and kernel margins.
/// Version 4: "columns": ["loss", ..], the names of the columns.
/// @throws std::invalid_argument for columns that are not as above or not UTF-8.
[[nodiscard]] std::string to_json(const CopulaModel& model);

/// @param source   names the text in errors. @param families those the model may use, also rotated.
/// @throws FileError naming the source and the field: not JSON, not this format, a newer version, a field missing or of
/// the wrong type, an unknown family (with the known ones), parameters, weights, columns or margins that are not
/// admissible.
[[nodiscard]] CopulaModel parse_model(std::string_view json, std::string_view source,
                                      std::span<const FamilyInfo> families);

/// parse_model of a file. @throws FileError also for a missing file or a directory.
[[nodiscard]] CopulaModel read_model(const std::filesystem::path& path, std::span<const FamilyInfo> families);

/// @throws std::invalid_argument for an unknown family or a wrong number of margins, else as FamilyInfo::make and
/// Mixture.
[[nodiscard]] CopulaPtr make_copula(const CopulaModel& model, std::span<const FamilyInfo> families);
[[nodiscard]] JointDistribution make_joint(const CopulaModel& model, std::span<const FamilyInfo> families);

/// What FamilyInfo::definition holds: a formula (symbolic/family_definition.hpp); a model, whose copula is a family
/// without parameters in one dimension, called as the model or, without a name, as the source (tau of a mixture is
/// NaN); or {"rotation": .., "family": one of these}. @throws as parse_model.
[[nodiscard]] FamilyInfo family_from_json(std::string_view json, std::string_view source,
                                          std::span<const FamilyInfo> families);

}  // namespace sklar
