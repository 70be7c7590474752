#pragma once
/// The copula model of Ozturk, Kurt and Bilgili, "Modeling BRDF by a Probability Distribution": in each of S equal
/// theta_d slices and each channel, f_r = K c(F1(theta_h), F2(theta_d), F3(phi_d)) f1 f2 f3 (its Eq. 13), with
/// histogram margins f (their cdf F linear within a bin) on the grid of the measured tables and one copula of a
/// registered family.

#include <array>
#include <string_view>
#include <vector>

#include "brdf/brdf.hpp"
#include "brdf/geometry/coordinates.hpp"
#include "copula/family.hpp"
#include "copula/inference/marginal.hpp"

namespace sklar::brdf {

inline constexpr int kPaperDimension = 3;  ///< of the copula: theta_h, theta_d, phi_d

/// What the mass of a cell is, and so what is normalised and fitted.
enum class CellMeasure {
  per_cell,        ///< the value of f_r in the cell, as in the paper
  per_solid_angle  ///< f_r times the measure of the cell, 4 cos(theta_d) d(omega_h) d(omega_d)
};
[[nodiscard]] std::string_view to_text(CellMeasure measure);  ///< "cell", "solid-angle"

/// One theta_d slice of one channel. scale = 0 and no masses where the slice is black.
struct PaperSlice {
  std::array<std::vector<float>, 3> masses;  ///< f1, f2, f3: 90, 90/S and 180 bins
  Theta theta;                               ///< of the copula
  float scale = 0;                           ///< K
};

/// Reciprocal to the last bit, since it sees the pair only through its half/difference coordinates. Beyond the centres
/// of the outermost bins that hold mass the value at those centres holds, so that it is finite everywhere.
class PaperBrdf final : public Brdf {
 public:
  /// @param channels red, green, blue; S slices each, S dividing 90.
  /// @throws std::invalid_argument (S, bin counts, unequal channels), std::domain_error (masses, scale, theta).
  PaperBrdf(const FamilyInfo& family, CellMeasure measure, std::array<std::vector<PaperSlice>, 3> channels);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return {}; }

  /// Four bytes for each mass, parameter and scale.
  [[nodiscard]] std::size_t bytes() const override;

  /// The value at half/difference coordinates, whether or not the directions there are above the horizon.
  [[nodiscard]] Rgb at(const HalfDifference& coordinates) const;

  [[nodiscard]] const std::string& family() const { return family_; }          ///< FamilyInfo::name
  [[nodiscard]] const std::string& definition() const { return definition_; }  ///< FamilyInfo::definition
  [[nodiscard]] CellMeasure measure() const { return measure_; }
  [[nodiscard]] int slices() const { return static_cast<int>(channels_[0].size()); }
  [[nodiscard]] const std::array<std::vector<PaperSlice>, 3>& channels() const { return channels_; }

 private:
  /// A point of the grid.
  struct Place {
    int slice;
    std::array<double, 3> bins;  ///< theta_h, theta_d within the slice, phi_d, in bins
    double measure;              ///< of the cell
  };

  /// What evaluation needs of a slice.
  struct Density {
    std::vector<HistogramMarginal> margins;  ///< over bins; none in a black slice
    CopulaPtr copula;
    double log_scale = 0;
    std::array<std::array<double, 2>, 3> inside;  ///< centres of the first and last bin that hold mass

    /// log(K f1 f2 f3), -inf where a margin has no mass; sets u to F.
    double place(const Place& place, std::array<double, 3>& u) const;
  };

  using PlacedRows = std::vector<std::pair<Eigen::Index, Place>>;

  void eval_batch(const DirectionsRef& wo, const DirectionsRef& wi, Eigen::Ref<RgbRows> out) const override;
  static void eval_rows(const Density& density, const PlacedRows& rows, Eigen::Ref<Eigen::ArrayXd> out);
  [[nodiscard]] Place locate(const HalfDifference& coordinates) const;
  [[nodiscard]] static Density make_density(const FamilyInfo& family, const PaperSlice& slice);

  std::string family_, definition_;
  CellMeasure measure_;
  std::array<std::vector<PaperSlice>, 3> channels_;
  std::array<std::vector<Density>, 3> densities_;
};

/// Measure 4 cos(theta_d) d(omega_h) d(omega_d) [sr^2] of a cell (theta_h bin, theta_d bin, any phi_d) of the grid.
[[nodiscard]] double cell_measure(int theta_h_bin, int theta_d_bin);

}  // namespace sklar::brdf
