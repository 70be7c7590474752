#pragma once
/// A fitted copula with its margins as versioned JSON; every double survives the round trip bit for bit.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "copula/family.hpp"
#include "copula/inference/joint.hpp"

namespace sklar {

using StoredMarginal = std::variant<HistogramMarginal, EmpiricalMarginal>;

struct CopulaModel {
  std::string family;  ///< FamilyInfo::name
  int dim = 0;
  Theta theta;
  std::vector<StoredMarginal> margins;  ///< one a dimension, or none for the copula alone
  std::string definition{};             ///< FamilyInfo::definition
};

/// The newest version written and read.
inline constexpr int kModelVersion = 1;

/// {"format": "sklar copula", "version": 1, "family": .., "dim": .., "theta": [..], "margins": [..]} with margins
/// {"kind": "histogram", "edges": [..], "masses": [..]} and {"kind": "empirical", "values": [..]}, ended by a newline.
/// "family" is a name, or the whole definition of a family given as a formula, so that the model stands alone.
[[nodiscard]] std::string to_json(const CopulaModel& model);

/// @param source   names the text in errors. @param families those the model may use.
/// @throws FileError naming the source and the field: not JSON, not this format, a newer version, a field missing or of
/// the wrong type, an unknown family (with the known ones), parameters or margins that are not admissible.
[[nodiscard]] CopulaModel parse_model(std::string_view json, std::string_view source,
                                      std::span<const FamilyInfo> families);

/// parse_model of a file. @throws FileError also for a missing file or a directory.
[[nodiscard]] CopulaModel read_model(const std::filesystem::path& path, std::span<const FamilyInfo> families);

/// @throws std::invalid_argument for an unknown family or a wrong number of margins, else as FamilyInfo::make.
[[nodiscard]] CopulaPtr make_copula(const CopulaModel& model, std::span<const FamilyInfo> families);
[[nodiscard]] JointDistribution make_joint(const CopulaModel& model, std::span<const FamilyInfo> families);

}  // namespace sklar
