#pragma once
/// A BRDF table on the 90 x 90 x 180 half/difference grid of the MERL format, with mask and provenance.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// The grid (Rusinkiewicz 1998; Matusik 2003). Bin centres: theta_h = ((i+.5)/90)^2 90 deg, theta_d = j+.5 deg,
/// phi_d = k+.5 deg; index = phi_d + 180 (theta_d + 90 theta_h).
struct Grid {
  static constexpr int theta_h = 90;
  static constexpr int theta_d = 90;
  static constexpr int phi_d = 180;
  static constexpr int cells = theta_h * theta_d * phi_d;

  static constexpr int index(int i, int j, int k) { return k + phi_d * (j + theta_d * i); }
  [[nodiscard]] static double theta_h_centre(int i);  ///< radians
  [[nodiscard]] static double theta_d_centre(int j);  ///< radians
  [[nodiscard]] static double phi_d_centre(int k);    ///< radians
};

/// Where data come from: measured, reconstructed from a published fit, computed, or nobody said.
enum class Provenance { measured, reconstruction, synthetic, unknown };
[[nodiscard]] std::string to_text(Provenance provenance);

/// What happened to the data on the way in; every figure is a share or a ratio, 0 where it does not apply.
struct ImportReport {
  double negative_share = 0;  ///< share of stored values below 0, taken as 0
  double median_asymmetry =
      0;  ///< median over cells of |f(wi,wo) - f(wo,wi)| / mean, channels summed, before symmetrising
  double mirror_asymmetry = 0;    ///< median over cells of |f(phi_d) - f(pi - phi_d)| / mean
  double isotropy_deviation = 0;  ///< of the data over four coordinates that the table is the mean of
};

/// f_r [1/sr] in three planes and one mask. Masked (invalid) cells hold 0 and take no part in fits and error measures.
struct MeasuredTable {
  std::string name;  ///< material name: file stem without "_rgb" or "_spec"
  Provenance provenance = Provenance::unknown;
  ImportReport report;
  std::array<std::vector<double>, 3> values;  ///< red, green, blue; Grid::cells each, finite and >= 0
  std::vector<std::uint8_t> valid;            ///< Grid::cells, 1 where measured

  [[nodiscard]] std::size_t valid_cells() const;
};

/// Middle of the values in order (the upper one of two), 0 for none.
[[nodiscard]] double median(std::vector<double> values);

/// ImportReport::mirror_asymmetry of a table: channels summed, over pairs of valid cells that are not both black.
[[nodiscard]] double mirror_asymmetry(const MeasuredTable& table);

/// @throws std::invalid_argument unless planes and mask have Grid::cells entries, every value is finite and >= 0, and
/// some cell is valid.
void require_table(std::string_view function, const MeasuredTable& table);

}  // namespace sklar::brdf
