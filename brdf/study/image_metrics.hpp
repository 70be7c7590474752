#pragma once
/// How different two rendered pictures look.

#include "brdf/brdf.hpp"
#include "brdf/render/image.hpp"

namespace sklar::brdf {

/// All over the whole picture, background included, after multiplying by `exposure` and clipping to [0,1].
struct ImageErrors {
  double psnr_gamma_db;  ///< of values^(1/2.2), mean over pixels and channels; inf where they agree
  double ssim;           ///< of the luma of values^(1/2.2): 1 where they agree
  double delta_e_2000;   ///< mean colour difference, sRGB primaries, D65
};

/// SSIM: Wang, Bovik, Sheikh, Simoncelli 2004, "Image quality assessment: from error visibility to structural
/// similarity": 11 x 11 Gaussian window, sigma 1.5, K1 = .01, K2 = .03, mean over the windows inside the picture. Luma:
/// Rec. 601.
/// @throws std::invalid_argument unless the pictures have one size, at least 11 x 11, and exposure is positive.
[[nodiscard]] ImageErrors image_errors(const Image& reference, const Image& model, double exposure = 1.0);

/// CIE 1976 L*a*b* of a linear sRGB colour under D65.
[[nodiscard]] Eigen::Array3d to_lab(const Rgb& linear);

/// CIEDE2000 colour difference of two L*a*b* colours, kL = kC = kH = 1. Source: Sharma, Wu, Dalal 2005, "The CIEDE2000
/// Color-Difference Formula", equations 2 to 22; agrees with its table 1 to the four decimals given.
[[nodiscard]] double delta_e_2000(const Eigen::Array3d& first, const Eigen::Array3d& second);

}  // namespace sklar::brdf
