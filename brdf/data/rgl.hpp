#pragma once
/// RGL `.bsdf` materials (Dupuy and Jakob 2018).
///
/// Directions are points of the unit square: u_x = sqrt(2 theta / pi), u_y = (phi + pi) / (2 pi). For known wi and half
/// vector m: s is the inverse warp of u(m) by the visible-normal density `vndf` at wi, and
///     f_r cos(theta_o) = S(s) D(m) / (4 sigma(wi))
/// with S = `rgb`, D = `ndf` and sigma = `sigma` read bilinearly, S and vndf also linearly in theta_i. Without
/// `jacobian` set, f_r cos(theta_o) = S(s).
///
/// At most two values of `phi_i`: isotropic, phi of m counts from wi. More: anisotropic, phi of m counts from x, S and
/// vndf are linear in phi_i too, and `ndf` and `sigma` are images over (phi, theta). phi_i then spans the whole turn;
/// or half of it, which a half turn of the surface repeats; or a quarter, which x -> -x and y -> -y repeat.
///
/// A file without `rgb` holds `spectra` at `wavelengths` (nm): their colours by rgb_weights take the place of S.

#include <filesystem>

#include "brdf/data/anisotropic_table.hpp"
#include "brdf/data/bilinear.hpp"
#include "brdf/data/tensor_file.hpp"

namespace sklar::brdf {

struct RglSlices;

/// The material as stored: exchanging the directions changes the value, and it can be negative.
class RglMaterial {
 public:
  /// @throws FileError naming the file and the field that is missing, misshapen or out of range.
  explicit RglMaterial(const std::filesystem::path& path);

  /// f_r cos(theta_o), 1/sr, of directions above the horizon. @param wi the direction that is known to the file.
  [[nodiscard]] Rgb f_cos(const Vec3& wo, const Vec3& wi) const;

  /// f_r, 1/sr: f_cos, negative values as 0, over cos(theta_o), which counts as cos(87.5 deg) below that.
  [[nodiscard]] Rgb f_one_way(const Vec3& wo, const Vec3& wi) const;

  [[nodiscard]] bool isotropic() const { return phi_i_.empty(); }

  /// 1, 2 or 4: how often the range of phi_i fits into the turn. 1 if isotropic.
  [[nodiscard]] int folds() const { return folds_; }

  /// Size in bytes of all images.
  [[nodiscard]] std::size_t bytes() const { return ndf_.bytes() + sigma_.bytes() + rgb_.bytes() + vndf_.bytes(); }

  /// Share of the stored values below 0; of spectra, of their colours.
  [[nodiscard]] double negative_share() const { return negative_share_; }

 private:
  explicit RglMaterial(const TensorFile& file);
  RglMaterial(const TensorFile& file, const RglSlices& rgb);

  [[nodiscard]] Rgb f_cos_isotropic(const Vec3& wo, const Vec3& wi) const;
  [[nodiscard]] Rgb f_cos_anisotropic(Vec3 wo, Vec3 wi) const;
  [[nodiscard]] Rgb value(const Vec2& u_half, const Vec2& u_wi, const ImageBlend& slice) const;
  [[nodiscard]] Between between_azimuths(double phi) const;

  std::vector<double> phi_i_;  ///< empty if isotropic
  int folds_;
  std::vector<double> theta_i_;
  bool jacobian_;
  double negative_share_ = 0;
  BilinearStack ndf_, sigma_, rgb_;  ///< rgb: image 3 (p T + t) + channel
  BilinearWarp vndf_;                ///< image p T + t
};

/// A material read directly: the mean of f_one_way of both directions.
class RglBrdf final : public Brdf {
 public:
  /// @throws std::invalid_argument for no material.
  explicit RglBrdf(std::shared_ptr<const RglMaterial> material);

  using Brdf::eval;
  [[nodiscard]] Rgb eval(const Vec3& wo, const Vec3& wi) const override;
  [[nodiscard]] Traits traits() const override { return {.isotropic = material_->isotropic()}; }
  [[nodiscard]] std::size_t bytes() const override { return material_->bytes(); }
  [[nodiscard]] const RglMaterial& material() const { return *material_; }

 private:
  std::shared_ptr<const RglMaterial> material_;
};

/// The reference table of an isotropic file: RglBrdf at each bin centre; valid where both cosines are positive. The
/// report is filled; provenance is measured. Runs on all threads of oneTBB. @throws std::invalid_argument if the
/// material is anisotropic.
[[nodiscard]] MeasuredTable resample(const RglMaterial& material, std::string name);

/// The reference table of any file on four coordinates: RglBrdf at each centre. The symmetries of the file are added to
/// those of the grid, and those that the data have (fold_symmetric) to the result's. The report is filled.
/// @throws std::invalid_argument if the grid with the symmetries of the file is not sound.
[[nodiscard]] AnisotropicTable resample_anisotropic(const std::shared_ptr<const RglMaterial>& material,
                                                    std::string name, AnisotropicGrid grid = {});

/// ImportReport::median_asymmetry of a material, over the cells of kProbeGrid.
[[nodiscard]] double median_asymmetry(const RglMaterial& material);

}  // namespace sklar::brdf
