#pragma once
/// A table of an anisotropic BRDF over all four half/difference coordinates, with mask and provenance, and how far it
/// is from being symmetric.

#include "brdf/data/measured_table.hpp"
#include "brdf/geometry/coordinates.hpp"

namespace sklar::brdf {

/// Cells over (theta_h, phi_h, theta_d, phi_d). Centres: theta_h = ((i+.5)/theta_h)^2 90 deg, phi_h = (m+.5)/phi_h
/// 360 deg, theta_d = (j+.5)/theta_d 90 deg, phi_d = (k+.5)/phi_d 180 deg. What a symmetry repeats is stored once.
/// The defaults are 1.5 deg (at theta_h = 22 deg), 2.5, 2 and 7.5 deg: 9,331,200 cells, 121 MB, a quarter of it with
/// both symmetries.
struct AnisotropicGrid {
  static constexpr std::size_t kMostCells = std::size_t{1} << 26;  ///< stored: 872 MB

  int theta_h = 60;
  int phi_h = 144;  ///< of the whole turn
  int theta_d = 45;
  int phi_d = 24;  ///< of the half turn that a reciprocal BRDF needs
  int turns = 1;   ///< f_r repeats after 2 pi / turns in phi_h; divides phi_h; phi_h itself where f_r is isotropic
  bool mirrored = false;  ///< f_r(phi_h, phi_d) = f_r(-phi_h, -phi_d); then phi_h / turns is even

  /// Cells of phi_h that are stored.
  [[nodiscard]] int stored_phi_h() const { return phi_h / turns / (mirrored ? 2 : 1); }
  [[nodiscard]] std::size_t stored_cells() const;

  /// Where the cell is stored, for any m in [0, phi_h).
  [[nodiscard]] std::size_t index(int i, int m, int j, int k) const {
    const int period = phi_h / turns;
    m %= period;
    if (mirrored && 2 * m >= period) {
      m = period - 1 - m;
      k = phi_d - 1 - k;
    }
    return static_cast<std::size_t>(k) +
           static_cast<std::size_t>(phi_d) *
               (j + static_cast<std::size_t>(theta_d) * (m + std::size_t(stored_phi_h()) * i));
  }

  [[nodiscard]] HalfDifference4 centre(int i, int m, int j, int k) const;  ///< radians

  /// cos_i cos_o 4 cos(theta_d) dwh dwd of the cell, 0 below the horizon: its share of the reflected light, where f_r
  /// is constant. The same for every m.
  [[nodiscard]] double light(int i, int j, int k) const;

  /// @throws std::invalid_argument naming function and count unless every count is at least 1, turns divides phi_h, and
  /// stored_cells() is at most kMostCells.
  void require(std::string_view function) const;
};

/// What happened to the data on the way in. Deviations are those of `deviation`, before folding.
struct AnisotropicReport {
  double negative_share = 0;       ///< share of stored values below 0, taken as 0
  double median_asymmetry = 0;     ///< as ImportReport::median_asymmetry
  double half_turn_deviation = 0;  ///< from f_r(phi_h + pi) = f_r(phi_h)
  double mirror_deviation = 0;     ///< from f_r(-phi_h, -phi_d) = f_r(phi_h, phi_d)
  double isotropy_deviation = 0;   ///< from isotropy
};

/// f_r [1/sr] in three planes of single precision and one mask, in the order of AnisotropicGrid::index. Masked
/// (invalid) cells hold 0 and take no part in fits and error measures.
struct AnisotropicTable {
  std::string name;
  Provenance provenance = Provenance::unknown;
  AnisotropicGrid grid;
  AnisotropicReport report;
  std::array<std::vector<float>, 3> values;  ///< red, green, blue; finite and >= 0
  std::vector<std::uint8_t> valid;           ///< 1 where measured

  [[nodiscard]] std::size_t valid_cells() const;
};

/// @throws std::invalid_argument unless the grid is sound, planes and mask have its cells, every value is finite and >=
/// 0, and some cell is valid.
void require_table(std::string_view function, const AnisotropicTable& table);

/// The share of the reflected light at which something counts as symmetric.
inline constexpr double kSymmetricDeviation = 0.05;

/// The mean over the cells that the symmetries make equal, valid ones alone. @param turns, mirrored as in the grid;
/// turns == phi_h averages over phi_h. @throws std::invalid_argument unless they include the symmetries of the table.
[[nodiscard]] AnisotropicTable folded(const AnisotropicTable& table, int turns, bool mirrored);

/// How much of the reflected light the symmetries move: sum w |f - g| / sum w g over valid cells and channels, where g
/// is `folded` and w is AnisotropicGrid::light. 0 for a symmetric table and for a black one; less than 2 whatever the
/// table. Independent noise of relative size s adds about 0.8 s.
[[nodiscard]] double deviation(const AnisotropicTable& table, int turns, bool mirrored);

/// `deviation` from isotropy: what changes over phi_h at fixed theta_h, theta_d and phi_d.
[[nodiscard]] inline double isotropy_deviation(const AnisotropicTable& table) {
  return deviation(table, table.grid.phi_h, false);
}

/// Measures the deviations of the report, and folds where they are at most `tolerance`: all of phi_h, or the half turn
/// and the mirror.
[[nodiscard]] AnisotropicTable fold_symmetric(AnisotropicTable table, double tolerance = kSymmetricDeviation);

}  // namespace sklar::brdf
