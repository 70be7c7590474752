#pragma once
/// Between spectra of reflectance and linear sRGB. The colour of a reflectance is that of its light under D65, seen by
/// the CIE 1931 2-degree observer, divided by that of a white one: reflectance 1 is (1, 1, 1).

#include <span>
#include <vector>

#include "brdf/brdf.hpp"

namespace sklar::brdf {

/// What the values at these wavelengths add to linear sRGB; they sum to 1 in each channel. Between wavelengths a
/// spectrum is linear, beyond the ends constant; the sum goes over 380, 381, .., 780 nm.
/// @param wavelengths nm, ascending, at least 2. @return as many as there are wavelengths.
[[nodiscard]] std::vector<Rgb> rgb_weights(std::span<const double> wavelengths);

/// 360, 380, .., 840 nm, where spectra are written.
[[nodiscard]] std::vector<double> written_wavelengths();

/// Spectra of a reflectance of red, green and blue 1 at written_wavelengths(): within [0,1], sum 1 at each wavelength,
/// and rgb_weights gives red, green and blue back with an error below 1e-9. So a colour within [0,1] has a spectrum
/// within [0,1], and gray a constant one. They are the shares exp(q_c) / sum exp(q) of three quadratics of the
/// wavelength, whose six free coefficients fulfil the six equations that the colours of two of them are.
[[nodiscard]] std::vector<Rgb> primary_spectra();

}  // namespace sklar::brdf
