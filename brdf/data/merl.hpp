#pragma once
/// MERL `.binary` files (Matusik et al. 2003): 3 int32 (90, 90, 180), then red, green and blue planes of 90 * 90 * 180
/// doubles in the order of Grid, little-endian, 34,992,012 bytes. f_r = raw * (1, 1.15, 1.66) / 1500; a negative raw
/// value means no measurement.

#include <filesystem>

#include "brdf/data/measured_table.hpp"

namespace sklar::brdf {

/// Reads a table; a cell with a negative raw value in any channel is masked. name is the file stem.
/// @param provenance what the caller knows of the file: the format does not say.
/// @throws FileError naming the file and what was found and expected: no regular file, wrong size or dimensions, a
/// value that is not finite, every cell masked.
[[nodiscard]] MeasuredTable read_merl(const std::filesystem::path& path, Provenance provenance = Provenance::unknown);

/// Cells along theta_h, theta_d and phi_d.
using MerlDimensions = std::array<std::int32_t, 3>;

/// What a file of any dimensions holds, in the order of Grid.
struct MerlCells {
  std::array<std::vector<double>, 3> values;  ///< red, green, blue: f_r, 1/sr, 0 where masked
  std::vector<std::uint8_t> valid;            ///< 1 where no channel is negative
};

/// The cells of a file; for read_merl those of Grid. @param dimensions positive. @throws FileError as read_merl.
[[nodiscard]] MerlCells read_merl_cells(const std::filesystem::path& path, const MerlDimensions& dimensions);

/// Writes a table, whole or not at all; masked cells become -1. Values that came from a MERL file read back to the bit,
/// any others to a relative 3e-16.
/// @throws std::invalid_argument if the table fails require_table; FileError if the file cannot be written or a value
/// exceeds 1e300.
void write_merl(const std::filesystem::path& path, const MeasuredTable& table);

}  // namespace sklar::brdf
