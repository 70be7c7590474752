#pragma once
/// Material files, whatever their format.

#include <filesystem>
#include <variant>

#include "brdf/data/anisotropic_table.hpp"
#include "copula/error.hpp"

namespace sklar::brdf {

/// A material on three coordinates where it is isotropic, on four where not.
using Material = std::variant<MeasuredTable, AnisotropicTable>;

/// The name of a material file: its stem without `_rgb` or `_spec`. @throws FileError unless it is UTF-8.
[[nodiscard]] std::string material_name(const std::filesystem::path& path);

/// For before long work. @throws FileError for a file that is missing or whose extension read_material does not know.
void require_material_file(const std::filesystem::path& path);

/// Reads a material file by its extension: `.binary` (MERL), `.bsdf` (RGL), `.brdf` (pbrt-v2) or `.csv`, the last two
/// by tabulate_scattered. name is material_name. An anisotropic file of an isotropic material
/// (isotropy_deviation at most kSymmetricDeviation) gives its isotropic_mean.
/// @param provenance what the caller knows of a file whose format does not say; `.bsdf` is measured.
/// @throws FileError for another extension, and as read_merl, RglMaterial and the readers of scattered.hpp do.
[[nodiscard]] Material read_material(const std::filesystem::path& path, Provenance provenance = Provenance::unknown);

/// The same, of isotropic materials. @throws FileError also for an anisotropic one, with its isotropy_deviation.
[[nodiscard]] MeasuredTable load_material(const std::filesystem::path& path,
                                          Provenance provenance = Provenance::unknown);

/// The material as a reflectance: an isotropic one by TableBrdf from its table, an anisotropic `.bsdf` read directly.
/// @throws as read_material.
[[nodiscard]] BrdfPtr read_material_brdf(const std::filesystem::path& path);

/// "PATH: is anisotropic (isotropy deviation 0.34); this needs an isotropic material".
[[nodiscard]] FileError anisotropic_error(std::string_view path, double isotropy_deviation);

}  // namespace sklar::brdf
