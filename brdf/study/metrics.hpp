#pragma once
/// How far a model is from a measured table, cell by cell and on a sphere (docs/conventions.md defines the measures).

#include <span>

#include "brdf/data/anisotropic_table.hpp"
#include "brdf/data/measured_table.hpp"

namespace sklar::brdf {

/// f_r per channel at the cell centres, in the order of Grid; 0 in masked cells.
using CellValues = std::array<std::vector<double>, 3>;

/// The model at the centres of the table's valid cells; wi is the direction at phi_d.
[[nodiscard]] CellValues predict(const Brdf& model, const MeasuredTable& reference);

/// Errors per channel over the valid cells with both angles at most 80 degrees, each cell counting once; `.mean()` of
/// each is the figure to report. f is measured, g the model, c = cos_i, w = max(cos_i cos_o, 1e-3). In the logarithms a
/// negative g (Traits::non_negative) counts as 0.
struct CellErrors {
  Rgb log1p_mae;      ///< mean |ln(1 + f c) - ln(1 + g c)|
  Rgb logrel_mae;     ///< mean |ln((f w + 1e-3) / (g w + 1e-3))|
  Rgb cuberoot_rms;   ///< sqrt mean (cbrt(f c) - cbrt(g c))^2
  Rgb rel_l2;         ///< sqrt(sum ((f - g) c)^2 / sum (f c)^2); 0 where both are black
  std::size_t cells;  ///< how many cells took part
};

/// @throws std::invalid_argument unless both tables are whole and some cell takes part.
[[nodiscard]] CellErrors cell_errors(const MeasuredTable& reference, const CellValues& predicted);

/// The same for a model against a table over four coordinates, over the cells that it stores. @throws
/// std::invalid_argument as above.
[[nodiscard]] CellErrors cell_errors(const AnisotropicTable& reference, const Brdf& model);

/// Radiance toward the viewer at the pixels of the pinned sphere: 96 x 96, orthographic, 6000 distant lights.
/// n x 3, n = 7208 disk pixels, row by row from the top.
using SpherePixels = RgbRows;

/// The sphere of every table, read by trilinear interpolation as TableBrdf does, masked cells as 0. The geometry, half
/// of the cost, is shared by all tables. @throws std::invalid_argument unless every table is whole.
[[nodiscard]] std::vector<SpherePixels> sphere_pixels(std::span<const CellValues* const> tables);

/// Peak signal-to-noise ratio per channel, dB; `.mean()` is the figure to report. The peak is the 99.5th percentile of
/// the reference, and both are clipped to it; inf where they agree. @throws std::invalid_argument if the sizes differ.
[[nodiscard]] Rgb sphere_psnr_linear_db(const SpherePixels& reference, const SpherePixels& model);

/// The same for one model, tabulated by predict. Costs about a second; for several models use sphere_pixels.
[[nodiscard]] Rgb sphere_psnr_linear_db(const MeasuredTable& reference, const Brdf& model);

}  // namespace sklar::brdf
