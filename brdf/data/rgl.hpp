#pragma once
/// RGL `.bsdf` materials (Dupuy and Jakob 2018), isotropic, RGB.
///
/// Directions are points of the unit square: u_x = sqrt(2 theta / pi), u_y = (phi + pi) / (2 pi). For known wi and half
/// vector m, phi counted from wi: s is the inverse warp of u(m) by the visible-normal density `vndf` at wi, and
///     f_r cos(theta_o) = S(s) D(m) / (4 sigma(wi))
/// with S = `rgb`, D = `ndf` and sigma = `sigma` read bilinearly, S and vndf also linearly in theta_i. Without
/// `jacobian` set, f_r cos(theta_o) = S(s).

#include <filesystem>

#include "brdf/data/bilinear.hpp"
#include "brdf/data/measured_table.hpp"
#include "brdf/data/tensor_file.hpp"

namespace sklar::brdf {

/// The material as stored: exchanging the directions changes the value, and it can be negative.
class RglMaterial {
 public:
  /// @throws FileError naming the file and the field that is missing, misshapen or out of range; for spectral and
  /// anisotropic files.
  explicit RglMaterial(const std::filesystem::path& path);

  /// f_r cos(theta_o), 1/sr. @param wi the direction that is known to the file. @param wo, wi unit, above the horizon.
  [[nodiscard]] Rgb f_cos(const Vec3& wo, const Vec3& wi) const;

  /// Share of the stored rgb values below 0.
  [[nodiscard]] double negative_share() const { return negative_share_; }

 private:
  explicit RglMaterial(const TensorFile& file);

  std::vector<double> theta_i_;
  bool jacobian_;
  double negative_share_ = 0;
  BilinearStack ndf_, sigma_, rgb_;  ///< rgb: image 3 t + channel
  BilinearWarp vndf_;
};

/// The reference table of a file: at each bin centre the mean of max(f(wi,wo), 0) and max(f(wo,wi), 0), the stored
/// cosine divided out with a floor of cos(87.5 deg); valid where both cosines are positive. The report is filled;
/// provenance is measured. Runs on all threads of oneTBB.
[[nodiscard]] MeasuredTable resample(const RglMaterial& material, std::string name);

}  // namespace sklar::brdf
