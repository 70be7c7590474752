#include "brdf/render/image.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "copula/error.hpp"
#include "copula/file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar::brdf {
namespace {
namespace fs = std::filesystem;

using ImageFile = test::TemporaryFolder;

Image ramp(int width, int height) {
  Image image(width, height);
  float value = 1e-7F;
  for (float& entry : image.rgb) entry = value *= 1.1F;
  return image;
}

TEST_F(ImageFile, ExrGivesTheSameBitsBack) {
  const Image image = ramp(7, 5);
  write_exr(folder_ / "a.exr", image);
  const Image back = read_exr(folder_ / "a.exr");
  EXPECT_EQ(back.width, 7);
  EXPECT_EQ(back.height, 5);
  EXPECT_EQ(back.rgb, image.rgb);
}

TEST_F(ImageFile, PngGivesTheSameBytesBack) {
  const Bytes bytes = to_srgb(ramp(7, 5), 10.0);
  write_png(folder_ / "a.png", bytes);
  const Bytes back = read_png(folder_ / "a.png");
  EXPECT_EQ(back.width, 7);
  EXPECT_EQ(back.height, 5);
  EXPECT_EQ(back.rgb, bytes.rgb);
}

TEST_F(ImageFile, FirstRowIsTheTopInBothFormats) {
  Image image(2, 3);
  image.at(0, 1, 0) = 1;
  write_exr(folder_ / "a.exr", image);
  write_png(folder_ / "a.png", image);
  EXPECT_EQ(read_exr(folder_ / "a.exr").at(0, 1, 0), 1.0F);
  EXPECT_EQ(read_png(folder_ / "a.png").rgb[3], 255);
}

// IEC 61966-2-1: 18 % grey is encoded as 0.4613561, the curve's branches meet at 0.0031308.
TEST(Srgb, CurveHasItsPublishedValues) {
  EXPECT_NEAR(srgb_encode(0.18), 0.4613561, 1e-7);
  EXPECT_DOUBLE_EQ(srgb_encode(0.002), 12.92 * 0.002);
  EXPECT_NEAR(srgb_encode(0.0031308), srgb_encode(0.00313081), 1e-6);
}

TEST(Srgb, OutsideIsClipped) {
  EXPECT_EQ(srgb_encode(-1), 0);
  EXPECT_EQ(srgb_encode(2), 1);
  EXPECT_EQ(srgb_encode(std::numeric_limits<double>::infinity()), 1);
  EXPECT_EQ(srgb_encode(std::nan("")), 0);
}

TEST(Srgb, ExposureMultipliesBeforeTheCurve) {
  Image image(1, 1);
  image.rgb = {0.09F, 0.18F, 0.5F};
  const Bytes bytes = to_srgb(image, 2.0);
  EXPECT_EQ(bytes.rgb[0], std::lround(255 * 0.4613561));
  EXPECT_EQ(bytes.rgb[2], 255);
}

template <typename Call>
void expect_file_error(const fs::path& path, Call call) {
  try {
    call();
    FAIL() << path << ": no error";
  } catch (const FileError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.rfind(path.string() + ": ", 0), 0u) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

TEST_F(ImageFile, BadFilesGiveOneLineWithThePath) {
  write_exr(folder_ / "whole.exr", ramp(64, 64));
  write_png(folder_ / "whole.png", ramp(64, 64));
  for (const char* kind : {".exr", ".png"}) {
    std::ifstream in(folder_ / (std::string("whole") + kind), std::ios::binary);
    std::string bytes(200, '\0');
    in.read(bytes.data(), 200);
    write_file(folder_ / (std::string("cut") + kind), bytes);
    write_file(folder_ / (std::string("empty") + kind), "");
    write_file(folder_ / (std::string("text") + kind), "not a picture\n");
  }
  for (const char* stem : {"cut", "empty", "text", "missing"}) {
    const fs::path exr = folder_ / (std::string(stem) + ".exr");
    const fs::path png = folder_ / (std::string(stem) + ".png");
    expect_file_error(exr, [&] { (void)read_exr(exr); });
    expect_file_error(png, [&] { (void)read_png(png); });
  }
  const fs::path nowhere = folder_ / "nowhere" / "a";
  expect_file_error(nowhere, [&] { write_exr(nowhere, ramp(2, 2)); });
  expect_file_error(nowhere, [&] { write_png(nowhere, ramp(2, 2)); });
}

TEST(Image, RefusesEmptySizes) {
  EXPECT_THROW(Image(0, 3), std::invalid_argument);
}

}  // namespace
}  // namespace sklar::brdf
