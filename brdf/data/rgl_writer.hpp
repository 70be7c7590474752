#pragma once
/// RGL `.bsdf` files of any reflectance, for the readers of Mitsuba 3 and pbrt-v4 (rgl.hpp says what the fields mean).

#include <filesystem>
#include <optional>
#include <string>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// `rgb`: read by Mitsuba 3 in its RGB variants. `spectra` at `wavelengths`, by primary_spectra: read by Mitsuba 3 in
/// its spectral variants and by pbrt-v4.
enum class RglForm { rgb, spectra };

/// Counts of nodes, each at least 2, but for azimuths.
struct RglLayout {
  int azimuths;      ///< of phi_i from -pi to pi, both included, at least 3; not used where isotropic
  int slices;        ///< of theta_i from 0 to pi/2, closer toward pi/2
  int warp_rows;     ///< of vndf along phi; where not isotropic of ndf and sigma, too
  int warp_columns;  ///< of vndf, ndf and sigma along theta
  int nodes;         ///< of the values along both axes
};

/// What is written unless another layout is asked for.
inline constexpr RglLayout kIsotropicLayout{
    .azimuths = 1, .slices = 32, .warp_rows = 64, .warp_columns = 128, .nodes = 64};
inline constexpr RglLayout kAnisotropicLayout{
    .azimuths = 49, .slices = 12, .warp_rows = 64, .warp_columns = 64, .nodes = 32};

/// How a file is written.
struct RglWriteOptions {
  RglForm form = RglForm::rgb;
  std::string description = {};          ///< what a reader shows of the file
  std::optional<RglLayout> layout = {};  ///< none: kIsotropicLayout or kAnisotropicLayout, as the traits say
};

/// Writes f_r; negative values count as 0. The same call gives the same bytes, on any number of threads of oneTBB.
///
/// `ndf` is the mean luminance of f_r at a half vector, by cos_i cos_o 4 cos(theta_d) dwd over the pairs above the
/// horizon, times cos(theta_m), and a constant hundredth, so that the importance map covers every direction; `sigma`
/// follows from it. `vndf` is of each known direction for three tenths what its facets show and else the light that it
/// reflects by facet, f_r cos(theta_o), whatever D: nodes are where the light is, and between two known directions they
/// move with it. S at a node is exact; `luminance`, by which readers draw a node, makes up for what vndf has of the
/// light. (Files of measurements have D alone in vndf and the luminance of S; readers use each field as it is.)
///
/// Read back as the format says, the mean relative error of f_r cos over theta_i up to 83 degrees is 0.0032 for a
/// constant, 0.0023 for 0.2/pi + 0.6 GGX of roughness 0.2, 0.0087 for an anisotropic lobe of 0.12 and 0.4 on a diffuse
/// base. The readers' pdf integrates to 0.998 to 1, where anisotropic to 0.99 to 1. Sizes: 3.1 MB (rgb) and 15 MB
/// (spectra), anisotropic 19 and 72 MB.
/// @throws std::invalid_argument for a layout with fewer nodes; FileError if the file cannot be written.
void write_rgl(const std::filesystem::path& path, const Brdf& brdf, const RglWriteOptions& options = {});

}  // namespace sklar::brdf
