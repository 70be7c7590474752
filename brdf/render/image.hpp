#pragma once
/// Linear RGB pictures and their two file formats: OpenEXR (linear, for measuring) and PNG (sRGB, for looking).

#include <filesystem>
#include <string>
#include <vector>

#include "copula/plot/bytes.hpp"

namespace sklar::brdf {

/// Linear scene-referred RGB (Rec. 709 primaries), row by row from the top, three floats a pixel.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;  ///< size 3 width height

  Image() = default;

  /// A black picture. @throws std::invalid_argument unless both sizes are at least 1.
  Image(int columns, int rows);

  [[nodiscard]] float& at(int row, int column, int channel) { return rgb[offset(row, column, channel)]; }
  [[nodiscard]] float at(int row, int column, int channel) const { return rgb[offset(row, column, channel)]; }

 private:
  [[nodiscard]] std::size_t offset(int row, int column, int channel) const {
    return (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)) * 3 +
           static_cast<std::size_t>(channel);
  }
};

using plot::Bytes;

/// The sRGB transfer curve, [0,1] -> [0,1]; values outside are clipped, NaN becomes 0.
[[nodiscard]] double srgb_encode(double linear);

/// Every channel times exposure, encoded and rounded to 8 bits.
[[nodiscard]] Bytes to_srgb(const Image& image, double exposure = 1.0);

/// OpenEXR with channels R, G, B as 32-bit floats, ZIP compressed: read_exr gives the same bits back.
/// @throws FileError
void write_exr(const std::filesystem::path& path, const Image& image);

/// The data window of an OpenEXR scan-line or tiled picture; any pixel type and compression the library knows.
/// @throws FileError if the file is missing, damaged or has no channels R, G, B.
[[nodiscard]] Image read_exr(const std::filesystem::path& path);

/// The bytes of an 8-bit PNG file with an sRGB chunk. @throws std::runtime_error for a picture without pixels.
[[nodiscard]] std::string to_png(const Bytes& bytes);

/// The same as a file. @throws FileError, std::runtime_error
void write_png(const std::filesystem::path& path, const Bytes& bytes);
void write_png(const std::filesystem::path& path, const Image& image, double exposure = 1.0);

/// Any PNG as 8-bit sRGB, transparency laid over white. @throws FileError
[[nodiscard]] Bytes read_png(const std::filesystem::path& path);

}  // namespace sklar::brdf
