#pragma once
/// The built-in materials: what the software works on when no file is given.

#include <cstdint>

#include "brdf/data/anisotropic_table.hpp"

namespace sklar::brdf {

/// A blue coated surface: Lambert, albedo (0.06, 0.14, 0.30), plus Ggx, f0 0.05, alpha 0.25, at the bin centres of the
/// grid, cells below the horizon masked, and each value times exp(0.02 z), z standard normal, seeded: the scatter of a
/// measurement of 2 %. The same on every call. name and provenance are synthetic.
[[nodiscard]] MeasuredTable builtin_material();

/// Name of the anisotropic one, here and on the command line.
inline constexpr const char* kAnisotropicSynthetic = "synthetic-anisotropic";

/// What the built-in anisotropic material is made with.
struct AnisotropicSynthetic {
  double scatter = 0.02;    ///< standard deviation of the logarithm of each value, in [0,1]
  double masked_share = 0;  ///< share of the cells above the horizon that are masked, at random, in [0,1)
  std::uint64_t seed = 1;
  AnisotropicGrid grid{.turns = 2, .mirrored = true};
};

/// The reflectance behind the anisotropic one: brushed brass, scratches along x. Ggx, f0 (0.80, 0.65, 0.42), alpha_x
/// 0.12, alpha_y 0.40, plus Lambert, albedo (0.05, 0.04, 0.03).
[[nodiscard]] BrdfPtr brushed_metal();

/// brushed_metal at the centres of a grid, by default with its symmetries, cells below the horizon masked. The same for
/// the same options. name is kAnisotropicSynthetic, provenance synthetic. @throws std::domain_error for a scatter
/// outside [0,1] or a masked_share outside [0,1); std::invalid_argument for a grid that is not sound.
[[nodiscard]] AnisotropicTable builtin_anisotropic_material(const AnisotropicSynthetic& options = {});

}  // namespace sklar::brdf
