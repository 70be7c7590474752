#include "brdf/render/image.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sklar::brdf {

Image::Image(int columns, int rows) : width(columns), height(rows) {
  if (columns < 1 || rows < 1) {
    throw std::invalid_argument("Image: width and height must be at least 1, got " + std::to_string(columns) + " x " +
                                std::to_string(rows));
  }
  rgb.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) * 3);
}

double srgb_encode(double linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 1;
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

Bytes to_srgb(const Image& image, double exposure) {
  Bytes bytes{image.width, image.height, std::vector<std::uint8_t>(image.rgb.size())};
  std::transform(image.rgb.begin(), image.rgb.end(), bytes.rgb.begin(), [exposure](float value) {
    return static_cast<std::uint8_t>(std::lround(255 * srgb_encode(exposure * value)));
  });
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image, double exposure) {
  write_png(path, to_srgb(image, exposure));
}

}  // namespace sklar::brdf
