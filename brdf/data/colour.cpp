#include "brdf/data/colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "brdf/data/interpolation.hpp"

namespace sklar::brdf {
namespace {

constexpr int kFirst = 380, kLast = 780, kStep = 5;  // nm
constexpr std::size_t kCount = (kLast - kFirst) / kStep + 1;

// The CIE 1931 2-degree observer at 380, 385, .., 780 nm (CIE 15:2004, table T.4).
constexpr std::array<double, kCount> kX = {
    0.001368, 0.002236, 0.004243, 0.00765,  0.01431, 0.02319, 0.04351, 0.07763,  0.13438,  0.21477,  0.2839,
    0.3285,   0.34828,  0.34806,  0.3362,   0.3187,  0.2908,  0.2511,  0.19536,  0.1421,   0.09564,  0.05795,
    0.03201,  0.0147,   0.0049,   0.0024,   0.0093,  0.0291,  0.06327, 0.1096,   0.1655,   0.22575,  0.2904,
    0.3597,   0.43345,  0.51205,  0.5945,   0.6784,  0.7621,  0.8425,  0.9163,   0.9786,   1.0263,   1.0567,
    1.0622,   1.0456,   1.0026,   0.9384,   0.85445, 0.7514,  0.6424,  0.5419,   0.4479,   0.3608,   0.2835,
    0.2187,   0.1649,   0.1212,   0.0874,   0.0636,  0.04677, 0.0329,  0.0227,   0.01584,  0.011359, 0.008111,
    0.00579,  0.004109, 0.002899, 0.002049, 0.00144, 0.001,   0.00069, 0.000476, 0.000332, 0.000235, 0.000166,
    0.000117, 0.000083, 0.000059, 0.000042};
constexpr std::array<double, kCount> kY = {
    0.000039, 0.000064, 0.00012, 0.000217, 0.000396, 0.00064,  0.00121,  0.00218,  0.004,    0.0073,  0.0116,  0.01684,
    0.023,    0.0298,   0.038,   0.048,    0.06,     0.0739,   0.09098,  0.1126,   0.13902,  0.1693,  0.20802, 0.2586,
    0.323,    0.4073,   0.503,   0.6082,   0.71,     0.7932,   0.862,    0.91485,  0.954,    0.9803,  0.99495, 1.0,
    0.995,    0.9786,   0.952,   0.9154,   0.87,     0.8163,   0.757,    0.6949,   0.631,    0.5668,  0.503,   0.4412,
    0.381,    0.321,    0.265,   0.217,    0.175,    0.1382,   0.107,    0.0816,   0.061,    0.04458, 0.032,   0.0232,
    0.017,    0.01192,  0.00821, 0.005723, 0.004102, 0.002929, 0.002091, 0.001484, 0.001047, 0.00074, 0.00052, 0.000361,
    0.000249, 0.000172, 0.00012, 0.000085, 0.00006,  0.000042, 0.00003,  0.000021, 0.000015};
constexpr std::array<double, kCount> kZ = {
    0.00645, 0.01055, 0.02005, 0.03621, 0.06785, 0.1102,  0.2074,  0.3713,  0.6456,  1.03905, 1.3856,  1.62296,
    1.74706, 1.7826,  1.77211, 1.7441,  1.6692,  1.5281,  1.28764, 1.0419,  0.81295, 0.6162,  0.46518, 0.3533,
    0.272,   0.2123,  0.1582,  0.1117,  0.07825, 0.05725, 0.04216, 0.02984, 0.0203,  0.0134,  0.00875, 0.00575,
    0.0039,  0.00275, 0.0021,  0.0018,  0.00165, 0.0014,  0.0011,  0.001,   0.0008,  0.0006,  0.00034, 0.00024,
    0.00019, 0.0001,  0.00005, 0.00003, 0.00002, 0.00001, 0,       0,       0,       0,       0,       0,
    0,       0,       0,       0,       0,       0,       0,       0,       0,       0,       0,       0,
    0,       0,       0,       0,       0,       0,       0,       0,       0};

// CIE standard illuminant D65 at 380, 390, .., 780 nm (CIE 15:2004, table T.1); between them it is linear.
constexpr std::array<double, kCount / 2 + 1> kD65 = {
    49.9755, 54.6482, 82.7549, 91.486,  93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923,
    108.811, 109.354, 107.802, 104.79,  107.689, 104.405, 104.046, 100.0,   96.3342, 95.788,  88.6856,
    90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091,
    74.349,  61.604,  69.8856, 75.087,  63.5927, 46.4182, 66.8054, 63.3828};

// XYZ to linear sRGB, white (0.95047, 1, 1.08883): the inverse of the matrix of IEC 61966-2-1.
constexpr std::array<std::array<double, 3>, 3> kToSrgb = {
    {{3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}}};

/// A table of equidistant wavelengths from kFirst on, between them.
template <std::size_t n>
double at(const std::array<double, n>& table, int step, int nm) {
  const Between between = between_clamped(static_cast<double>(nm - kFirst) / step, static_cast<int>(n));
  return mix(table[static_cast<std::size_t>(between.low)], table[static_cast<std::size_t>(between.high)],
             between.share);
}

/// What reflectance 1 at a wavelength adds to linear sRGB, but for the division by white.
Rgb light(int nm) {
  const double x = at(kX, kStep, nm), y = at(kY, kStep, nm), z = at(kZ, kStep, nm);
  Rgb result;
  for (int c = 0; c < 3; ++c) {
    const auto& row = kToSrgb[static_cast<std::size_t>(c)];
    result[c] = at(kD65, 2 * kStep, nm) * (row[0] * x + row[1] * y + row[2] * z);
  }
  return result;
}

}  // namespace

std::vector<Rgb> rgb_weights(std::span<const double> wavelengths) {
  std::vector<Rgb> weights(wavelengths.size(), Rgb::Zero());
  Rgb white = Rgb::Zero();
  for (int nm = kFirst; nm <= kLast; ++nm) {
    const double wavelength = std::clamp(static_cast<double>(nm), wavelengths.front(), wavelengths.back());
    const auto above = std::lower_bound(wavelengths.begin() + 1, wavelengths.end(), wavelength);
    const auto high = static_cast<std::size_t>(above - wavelengths.begin());
    const double share = (wavelength - wavelengths[high - 1]) / (wavelengths[high] - wavelengths[high - 1]);
    weights[high - 1] += (1 - share) * light(nm);
    weights[high] += share * light(nm);
    white += light(nm);
  }
  for (Rgb& weight : weights) weight /= white;
  return weights;
}

std::vector<double> written_wavelengths() {
  std::vector<double> wavelengths;
  for (int nm = 360; nm <= 840; nm += 20) wavelengths.push_back(nm);
  return wavelengths;
}

std::vector<Rgb> primary_spectra() {
  // log(red / green) and log(blue / green) as a + b x + c x^2, x = (wavelength - 550 nm) / 100 nm. Found by the
  // Levenberg-Marquardt method from the six equations.
  constexpr std::array<double, 3> kRed = {-5.791759690235292, 7.17576091830952, 15.842083498443934};
  constexpr std::array<double, 3> kBlue = {-4.471403240462767, -0.21322426110721604, 11.32555273732418};
  std::vector<Rgb> spectra;
  for (const double wavelength : written_wavelengths()) {
    const double x = (wavelength - 550) / 100;
    const Rgb log_share(kRed[0] + x * (kRed[1] + x * kRed[2]), 0, kBlue[0] + x * (kBlue[1] + x * kBlue[2]));
    const Rgb share = (log_share - log_share.maxCoeff()).exp();
    spectra.push_back(share / share.sum());
  }
  return spectra;
}

}  // namespace sklar::brdf
