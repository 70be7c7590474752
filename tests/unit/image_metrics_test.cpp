#include "brdf/study/image_metrics.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sklar::brdf {
namespace {

struct Pair {
  std::array<double, 3> first, second;
  double difference;
};

/// Sharma, Wu, Dalal 2005, table 1.
constexpr std::array<Pair, 34> kSharma{{
    {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
    {{50, 3.1571, -77.2803}, {50, 0, -82.7485}, 2.8615},
    {{50, 2.8361, -74.0200}, {50, 0, -82.7485}, 3.4412},
    {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
    {{50, -1.1848, -84.8006}, {50, 0, -82.7485}, 1.0000},
    {{50, -0.9009, -85.5211}, {50, 0, -82.7485}, 1.0000},
    {{50, 0, 0}, {50, -1, 2}, 2.3669},
    {{50, -1, 2}, {50, 0, 0}, 2.3669},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0009}, 7.1792},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0010}, 7.1792},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0011}, 7.2195},
    {{50, 2.4900, -0.0010}, {50, -2.4900, 0.0012}, 7.2195},
    {{50, -0.0010, 2.4900}, {50, 0.0009, -2.4900}, 4.8045},
    {{50, -0.0010, 2.4900}, {50, 0.0010, -2.4900}, 4.8045},
    {{50, -0.0010, 2.4900}, {50, 0.0011, -2.4900}, 4.7461},
    {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
    {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
    {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
    {{50, 2.5, 0}, {56, -27, -3}, 31.9030},
    {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
    {{50, 2.5, 0}, {50, 3.1736, 0.5854}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2972, 0}, 1.0000},
    {{50, 2.5, 0}, {50, 1.8634, 0.5757}, 1.0000},
    {{50, 2.5, 0}, {50, 3.2592, 0.3350}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
}};

TEST(DeltaE2000, PublishedPairs) {
  constexpr double kFourDecimals = 5.1e-5;
  for (const Pair& pair : kSharma) {
    const Eigen::Array3d first(pair.first.data());
    const Eigen::Array3d second(pair.second.data());
    EXPECT_NEAR(delta_e_2000(first, second), pair.difference, kFourDecimals) << first.transpose();
    EXPECT_NEAR(delta_e_2000(second, first), pair.difference, kFourDecimals) << second.transpose();
  }
}

// White, black, and sRGB red: L* = 53.24, a* = 80.09, b* = 67.20 (IEC 61966-2-1 primaries, D65).
TEST(Lab, KnownColours) {
  EXPECT_NEAR((to_lab(Rgb::Ones()) - Eigen::Array3d(100, 0, 0)).abs().maxCoeff(), 0, 1e-12);
  EXPECT_NEAR(to_lab(Rgb::Zero()).abs().maxCoeff(), 0, 1e-12);
  EXPECT_NEAR((to_lab({1, 0, 0}) - Eigen::Array3d(53.24, 80.09, 67.20)).abs().maxCoeff(), 0, 0.01);
}

Image filled(double value) {
  Image image(16, 13);
  std::fill(image.rgb.begin(), image.rgb.end(), static_cast<float>(value));
  return image;
}

TEST(ImageErrors, EqualPictures) {
  const ImageErrors errors = image_errors(filled(0.3), filled(0.3));
  EXPECT_EQ(errors.psnr_gamma_db, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(errors.ssim, 1, 1e-12);
  EXPECT_EQ(errors.delta_e_2000, 0);
}

TEST(ImageErrors, FlatPicturesByHand) {
  constexpr double kFloat = 1e-6;  ///< relative: pictures hold floats
  const double a = std::pow(0.4, 1 / 2.2);
  const double b = std::pow(0.2, 1 / 2.2);
  for (const double exposure : {1.0, 0.5}) {  // brighter pictures through a darker exposure are the same
    const ImageErrors errors = image_errors(filled(0.4 / exposure), filled(0.2 / exposure), exposure);
    EXPECT_NEAR(errors.psnr_gamma_db, -20 * std::log10(a - b), 20 * kFloat);
    EXPECT_NEAR(errors.ssim, (2 * a * b + 1e-4) / (a * a + b * b + 1e-4), kFloat);
    EXPECT_NEAR(errors.delta_e_2000, delta_e_2000(to_lab(Rgb::Constant(0.4)), to_lab(Rgb::Constant(0.2))), 1e-4);
  }
}

TEST(ImageErrors, ClippedHighlightsAreEqual) {
  EXPECT_EQ(image_errors(filled(3), filled(5)).psnr_gamma_db, std::numeric_limits<double>::infinity());
}

// The value of a separate implementation of Wang et al. 2004 on the same two pictures.
TEST(ImageErrors, StructuralSimilarityOfTexture) {
  Image reference(24, 20);
  Image model(24, 20);
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 24; ++column) {
      const double x = 0.5 + 0.3 * std::sin(0.7 * column) * std::cos(0.4 * row);
      const double y = x + 0.1 * std::cos(1.3 * column + 0.9 * row);
      for (int c = 0; c < 3; ++c) {
        reference.at(row, column, c) = static_cast<float>(std::pow(x, 2.2));
        model.at(row, column, c) = static_cast<float>(std::pow(y, 2.2));
      }
    }
  }
  const ImageErrors errors = image_errors(reference, model);
  EXPECT_NEAR(errors.ssim, 0.86676065, 1e-6);
  EXPECT_NEAR(errors.psnr_gamma_db, 23.012214, 1e-4);
}

TEST(ImageErrors, RefusesWhatCannotBeCompared) {
  EXPECT_THROW((void)image_errors(filled(1), Image(13, 16)), std::invalid_argument);
  EXPECT_THROW((void)image_errors(Image(10, 40), Image(10, 40)), std::invalid_argument);
  EXPECT_THROW((void)image_errors(filled(1), filled(1), 0), std::invalid_argument);
}

}  // namespace
}  // namespace sklar::brdf
