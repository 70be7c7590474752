#pragma once
/// Reflectance measured at directions of no order: files of it, and the table made of it.

#include <filesystem>
#include <span>
#include <vector>

#include "brdf/data/measured_table.hpp"

namespace sklar::brdf {

/// A measurement at a pair of directions.
struct ScatteredSample {
  Vec3 wo, wi;  ///< unit, above the horizon
  Rgb value;    ///< f_r, 1/sr
};

/// A CSV file with the header wi_x,wi_y,wi_z,wo_x,wo_y,wo_z,r,g,b; directions have length 1 up to 1e-6.
/// @throws FileError naming the line: another header, a bad number, a direction of another length or below the horizon.
[[nodiscard]] std::vector<ScatteredSample> read_scattered_csv(const std::filesystem::path& path);

/// The text format of pbrt-v2's material `measured` (`.brdf`): numbers separated by blanks and lines, `#` begins a
/// comment. First the number of wavelengths, then these, ascending, in nm; then for each sample theta_i, phi_i,
/// theta_o, phi_o in radians and f_r at each wavelength, of which the colour by rgb_weights is taken.
/// @throws FileError naming the line: a bad number, an angle below the horizon, a sample that is cut short.
[[nodiscard]] std::vector<ScatteredSample> read_pbrt_brdf(const std::filesystem::path& path);

/// The isotropic table of samples, by modified Shepard interpolation (Franke and Nielson 1980, "Smooth interpolation of
/// large sets of scattered data"): the mean of the 8 nearest ones weighted by ((R - d) / (R d))^2, where d is the
/// distance and R that of the ninth. Distances are taken between the points (r cos(2 phi_d), r |sin(2 phi_d)|,
/// theta_d / 90 deg) with r = sqrt(theta_h / 90 deg), which reciprocal and mirrored pairs share. A cell is valid where
/// both cosines are positive and the nearest sample is within 0.1. Negative values count as 0; the report says their
/// share. Runs on all threads of oneTBB.
/// @param samples at least 9. @throws std::invalid_argument for fewer, or where no cell is near one.
[[nodiscard]] MeasuredTable tabulate_scattered(std::span<const ScatteredSample> samples, std::string name,
                                               Provenance provenance);

}  // namespace sklar::brdf
