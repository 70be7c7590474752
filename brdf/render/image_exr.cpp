#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include <array>
#include <exception>
#include <string>

#include "brdf/render/image.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"

namespace sklar::brdf {
namespace {

constexpr std::array<const char*, 3> kChannels{"R", "G", "B"};

class MemoryStream final : public Imf::OStream {
 public:
  MemoryStream() : OStream("memory") {}
  void write(const char bytes[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (position_ + size > bytes_.size()) bytes_.resize(position_ + size);
    bytes_.replace(position_, size, bytes, size);
    position_ += size;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t position_ = 0;
};

/// Slices of an interleaved float picture whose first pixel is at (left, top).
Imf::FrameBuffer slices(float* rgb, int width, int left, int top) {
  constexpr std::size_t kPixel = 3 * sizeof(float);
  const std::size_t row = kPixel * static_cast<std::size_t>(width);
  Imf::FrameBuffer buffer;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    char* origin = reinterpret_cast<char*>(rgb + channel);
    origin -= static_cast<std::ptrdiff_t>(kPixel) * left + static_cast<std::ptrdiff_t>(row) * top;
    buffer.insert(kChannels[channel], Imf::Slice(Imf::FLOAT, origin, kPixel, row));
  }
  return buffer;
}

}  // namespace

void write_exr(const std::filesystem::path& path, const Image& image) {
  MemoryStream stream;
  try {
    Imf::Header header(image.width, image.height);
    for (const char* channel : kChannels) header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    // One thread: the bytes are then in order however many threads the caller runs.
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(slices(const_cast<float*>(image.rgb.data()), image.width, 0, 0));
    file.writePixels(image.height);
  } catch (const std::exception& error) {
    throw FileError(path.string(), std::string("cannot be encoded as OpenEXR: ") + error.what());
  }
  write_file(path, stream.bytes());
}

Image read_exr(const std::filesystem::path& path) try {
  Imf::InputFile file(path.c_str(), 0);
  for (const char* channel : kChannels) {
    if (file.header().channels().findChannel(channel) == nullptr) {
      throw FileError(path.string(), std::string("has no channel ") + channel + "; R, G and B are needed");
    }
  }
  const Imath::Box2i window = file.header().dataWindow();
  Image image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
  file.setFrameBuffer(slices(image.rgb.data(), image.width, window.min.x, window.min.y));
  file.readPixels(window.min.y, window.max.y);
  return image;
} catch (const FileError&) {
  throw;
} catch (const std::exception& error) {
  throw FileError(path.string(), std::string("cannot be read as OpenEXR: ") + error.what());
}

}  // namespace sklar::brdf
