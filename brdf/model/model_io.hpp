#pragma once
/// A fitted BRDF model as a file: versioned JSON or, smaller, binary. Values survive the round trip bit for bit.

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>

#include "brdf/data/measured_table.hpp"
#include "brdf/model/anisotropic_model.hpp"
#include "brdf/model/paper_brdf.hpp"
#include "brdf/model/refined_brdf.hpp"
#include "copula/inference/fit.hpp"

namespace sklar::brdf {

/// A model of any kind that can be stored.
using ModelPtr = std::variant<std::shared_ptr<const PaperBrdf>, std::shared_ptr<const RefinedBrdf>,
                              std::shared_ptr<const AnisotropicModel>>;

/// A model and what it was fitted to.
struct StoredBrdf {
  std::string material;
  Provenance provenance = Provenance::unknown;
  ModelPtr model;
  FitMethod method = FitMethod::least_squares;  ///< of the paper's model

  [[nodiscard]] BrdfPtr brdf() const {
    return std::visit([](const auto& pointer) -> BrdfPtr { return pointer; }, model);
  }
};

/// The newest version written and read.
inline constexpr int kBrdfModelVersion = 4;

/// {"format": "sklar brdf", "version", "mode", "material", "provenance", ..}. Version 1, mode "paper": "family",
/// "method", "measure", "red": [slices], "green", "blue" with slices {"theta": [..], "scale", "theta_h": [masses],
/// "theta_d", "phi_d"}. Version 2, mode "refined": "structure" with the fields of RefinedStructure, "families" one a
/// component, "bits", and "lowest", "step" and "levels" of PackedCoefficients. Version 3, mode "anisotropic":
/// "structure" with the fields of AnisotropicStructure, "bits", "lowest", "step" and "levels"
/// likewise. Version 4 is version 2 with "half_range" and "difference_range" in the structure, two whole numbers of
/// 64ths each. A family is a name, or the whole definition of a family given as a formula, so that the
/// model stands alone.
[[nodiscard]] std::string to_json(const StoredBrdf& model);

/// @param source names the text in errors. @throws FileError naming the source and the field: not JSON, not this
/// format, a newer version, a field missing or of the wrong type, an unknown family, values that the model refuses.
[[nodiscard]] StoredBrdf parse_brdf(std::string_view json, std::string_view source);

/// parse_brdf, or parse_binary by its first bytes, of a file. @throws FileError also for a missing file or a directory.
[[nodiscard]] StoredBrdf read_brdf(const std::filesystem::path& path);

/// to_binary where is_binary_path, else to_json. @throws as to_binary and write_file.
void write_brdf(const std::filesystem::path& path, const StoredBrdf& model);

/// Whether a path ends in .sklar; in that or in .json.
[[nodiscard]] bool is_binary_path(const std::filesystem::path& path);
[[nodiscard]] bool is_model_path(const std::filesystem::path& path);

}  // namespace sklar::brdf
