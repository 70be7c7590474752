#pragma once
/// Material files, whatever their format.

#include <filesystem>

#include "brdf/data/measured_table.hpp"

namespace sklar::brdf {

/// Reads a material file by its extension: `.binary` (MERL) or `.bsdf` (RGL). name is the file stem without `_rgb`.
/// @param binary_provenance what the caller knows of a `.binary`, whose format does not say; `.bsdf` is measured.
/// @throws FileError for another extension, and as read_merl and RglMaterial do.
[[nodiscard]] MeasuredTable load_material(const std::filesystem::path& path,
                                          Provenance binary_provenance = Provenance::unknown);

}  // namespace sklar::brdf
