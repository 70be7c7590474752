#include <png.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "brdf/render/image.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"

namespace sklar::brdf {
namespace {

/// libpng's simplified interface: an 8-bit RGB buffer there is sRGB by definition.
png_image header(int width, int height) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  return image;
}

}  // namespace

std::string to_png(const Bytes& bytes) {
  png_image image = header(bytes.width, bytes.height);
  png_alloc_size_t size = 0;
  std::string file;
  bool written = png_image_write_get_memory_size(image, size, 0, bytes.rgb.data(), 0, nullptr) != 0;
  if (written) {
    file.resize(size);
    written = png_image_write_to_memory(&image, file.data(), &size, 0, bytes.rgb.data(), 0, nullptr) != 0;
  }
  if (!written) throw std::runtime_error(std::string("a picture cannot be encoded as PNG: ") + image.message);
  file.resize(size);
  return file;
}

void write_png(const std::filesystem::path& path, const Bytes& bytes) {
  write_file(path, to_png(bytes));
}

Bytes read_png(const std::filesystem::path& path) {
  const std::string file = read_file(path);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> freed(&image, &png_image_free);
  bool read = png_image_begin_read_from_memory(&image, file.data(), file.size()) != 0;
  image.format = PNG_FORMAT_RGB;
  Bytes bytes{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  if (read) {
    constexpr double kPixelsPerByte = 8 * 1032;  // of one bit, by deflate
    if (double{1} * image.width * image.height > kPixelsPerByte * static_cast<double>(file.size())) {
      throw FileError(path.string(), "cannot be read as PNG: promises " + std::to_string(image.width) + " x " +
                                         std::to_string(image.height) + " pixels, more than its " +
                                         std::to_string(file.size()) + " bytes can hold");
    }
    bytes.rgb.resize(PNG_IMAGE_SIZE(image));
    const png_color white{255, 255, 255};
    read = png_image_finish_read(&image, &white, bytes.rgb.data(), 0, nullptr) != 0;
  }
  if (!read) throw FileError(path.string(), std::string("cannot be read as PNG: ") + image.message);
  return bytes;
}

}  // namespace sklar::brdf
