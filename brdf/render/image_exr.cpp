#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <openexr.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

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

/// The file in memory.
class MemoryInput final : public Imf::IStream {
 public:
  explicit MemoryInput(std::string_view bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char to[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (position_ > bytes_.size() || size > bytes_.size() - position_)
      throw std::invalid_argument("the file ends too soon");
    std::memcpy(to, bytes_.data() + position_, size);
    position_ += size;
    return position_ < bytes_.size();
  }
  uint64_t tellg() override { return position_; }
  void seekg(uint64_t position) override { position_ = position; }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0;
};

/// Refuses what the reader above would take memory for before it has seen as much: headers whose sizes do not agree
/// with the file, as the stricter core library finds them, and a picture larger than the file can hold.
void require_room(std::string_view bytes) {
  exr_context_initializer_t access = EXR_DEFAULT_CONTEXT_INITIALIZER;
  access.user_data = &bytes;
  access.flags = EXR_CONTEXT_FLAG_STRICT_HEADER | EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE;
  access.size_fn = [](exr_const_context_t, void* file) {
    return static_cast<std::int64_t>(static_cast<const std::string_view*>(file)->size());
  };
  access.read_fn = [](exr_const_context_t, void* file, void* to, std::uint64_t count, std::uint64_t from,
                      exr_stream_error_func_ptr_t) -> std::int64_t {
    const auto& all = *static_cast<const std::string_view*>(file);
    const std::string_view part = all.substr(std::min<std::uint64_t>(from, all.size()), count);
    std::memcpy(to, part.data(), part.size());
    return static_cast<std::int64_t>(part.size());
  };
  exr_context_t context = nullptr;
  exr_attr_box2i_t window{};
  exr_result_t result = exr_start_read(&context, "memory", &access);
  if (result == EXR_ERR_SUCCESS) result = exr_get_data_window(context, 0, &window);
  exr_finish(&context);
  if (result != EXR_ERR_SUCCESS) throw std::invalid_argument(exr_get_default_error_message(result));
  const auto extent = [](std::int64_t first, std::int64_t last) { return static_cast<double>(last - first + 1); };
  const double pixels = extent(window.min.x, window.max.x) * extent(window.min.y, window.max.y);
  constexpr double kPixelsPerByte = 1024;  // deflate, at most 1032 to 1, has 172 pixels of three half floats in a byte
  if (pixels <= kPixelsPerByte * static_cast<double>(bytes.size())) return;
  throw std::invalid_argument("more pixels than its " + std::to_string(bytes.size()) + " bytes can hold");
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

Image read_exr(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  try {
    require_room(bytes);
    MemoryInput stream(bytes);
    Imf::InputFile file(stream, 0);
    for (const char* channel : kChannels) {
      if (file.header().channels().findChannel(channel) == nullptr) {
        throw std::invalid_argument(std::string("no channel ") + channel + "; R, G and B are needed");
      }
    }
    const Imath::Box2i window = file.header().dataWindow();
    Image image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
    file.setFrameBuffer(slices(image.rgb.data(), image.width, window.min.x, window.min.y));
    file.readPixels(window.min.y, window.max.y);
    return image;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw FileError(path.string(), std::string("cannot be read as OpenEXR: ") + error.what());
  }
}

}  // namespace sklar::brdf
