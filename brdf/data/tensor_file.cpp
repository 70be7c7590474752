#include "brdf/data/tensor_file.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "copula/error.hpp"
#include "copula/file.hpp"

namespace sklar::brdf {
namespace {

static_assert(std::endian::native == std::endian::little, "the reader copies little-endian numbers");

constexpr std::string_view kMagic("tensor_file\0", 12);
constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 30;  // the largest published materials have 0.1 GB
constexpr std::uint8_t kByte = 1;
constexpr std::uint8_t kFloat32 = 10;

struct Type {
  const char* name;
  std::size_t bytes;
};
constexpr std::array<Type, 12> kTypes = {{{"void", 0},
                                          {"uint8", 1},
                                          {"int8", 1},
                                          {"uint16", 2},
                                          {"int16", 2},
                                          {"uint32", 4},
                                          {"int32", 4},
                                          {"uint64", 8},
                                          {"int64", 8},
                                          {"float16", 2},
                                          {"float32", 4},
                                          {"float64", 8}}};

std::string read_bounded(const std::filesystem::path& path) {
  if (std::error_code error; std::filesystem::is_regular_file(path, error)) {
    const std::uintmax_t size = std::filesystem::file_size(path);
    if (size > kLargestFile) {
      throw FileError(path.string(),
                      "has " + std::to_string(size) + " bytes, expected at most " + std::to_string(kLargestFile));
    }
  }
  return read_file(path);
}

std::string label(std::string_view name) {
  return "field '" + std::string(name) + "'";
}

}  // namespace

/// Reads numbers in order and stops at the end of the file.
class TensorFile::Cursor {
 public:
  explicit Cursor(const TensorFile& file) : file_(file) {}

  std::string_view take(std::size_t count) {
    if (count > file_.bytes_.size() - position_) {
      file_.fail("ends inside its table of fields (has " + std::to_string(file_.bytes_.size()) + " bytes)");
    }
    position_ += count;
    return std::string_view(file_.bytes_).substr(position_ - count, count);
  }

  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }

 private:
  const TensorFile& file_;
  std::size_t position_ = 0;
};

TensorFile::TensorFile(const std::filesystem::path& path) : path_(path.string()), bytes_(read_bounded(path)) {
  Cursor cursor(*this);
  if (bytes_.size() < kMagic.size() || cursor.take(kMagic.size()) != kMagic) {
    fail("is not a tensor file (does not begin with 'tensor_file')");
  }
  const int major = cursor.number<std::uint8_t>();
  const int minor = cursor.number<std::uint8_t>();
  if (major != 1 || minor != 0) {
    fail("has version " + std::to_string(major) + "." + std::to_string(minor) + ", expected 1.0");
  }
  const auto count = cursor.number<std::uint32_t>();
  for (std::uint32_t n = 0; n < count; ++n) {
    std::string name(cursor.take(cursor.number<std::uint16_t>()));
    Field entry = read_field(cursor, name);
    if (!fields_.emplace(name, std::move(entry)).second) fail(label(name) + " occurs twice");
  }
}

TensorFile::Field TensorFile::read_field(Cursor& cursor, const std::string& name) const {
  const auto dimensions = cursor.number<std::uint16_t>();
  Field entry{.type = cursor.number<std::uint8_t>(), .shape = {}, .count = 1, .offset = 0};
  if (entry.type == 0 || entry.type >= kTypes.size()) {
    fail(label(name) + " has type " + std::to_string(entry.type) + ", expected 1 to " +
         std::to_string(kTypes.size() - 1));
  }
  const auto offset = cursor.number<std::uint64_t>();
  if (offset > bytes_.size()) {
    fail(label(name) + " begins at byte " + std::to_string(offset) + " of " + std::to_string(bytes_.size()));
  }
  entry.offset = offset;
  const std::size_t room = (bytes_.size() - entry.offset) / kTypes[entry.type].bytes;
  for (int n = 0; n < dimensions; ++n) {
    const auto extent = cursor.number<std::uint64_t>();
    if (extent != 0 && entry.count > room / extent) {
      fail(label(name) + " ends past the file (has " + std::to_string(bytes_.size()) + " bytes)");
    }
    entry.count *= extent;
    entry.shape.push_back(extent);
  }
  if (entry.count > room) fail(label(name) + " ends past the file (has " + std::to_string(bytes_.size()) + " bytes)");
  return entry;
}

const TensorFile::Field& TensorFile::field(std::string_view name, std::uint8_t type) const {
  const auto found = fields_.find(name);
  if (found == fields_.end()) fail("has no " + label(name));
  const Field& entry = found->second;
  if (entry.type != type) {
    fail(label(name) + " has type " + kTypes[entry.type].name + ", expected " + kTypes[type].name);
  }
  if (entry.count == 0) fail(label(name) + " is empty");
  return entry;
}

FloatTensor TensorFile::floats(std::string_view name, std::size_t dimensions) const {
  const Field& entry = field(name, kFloat32);
  if (entry.shape.size() != dimensions) {
    fail(label(name) + " has " + std::to_string(entry.shape.size()) + " dimensions, expected " +
         std::to_string(dimensions));
  }
  FloatTensor tensor{entry.shape, std::vector<float>(entry.count)};
  std::memcpy(tensor.values.data(), bytes_.data() + entry.offset, entry.count * sizeof(float));
  for (std::size_t n = 0; n < entry.count; ++n) {
    const double value = static_cast<double>(tensor.values[n]);
    if (!std::isfinite(value)) fail(label(name) + " holds " + to_text(value) + " at index " + std::to_string(n));
  }
  return tensor;
}

std::uint8_t TensorFile::byte(std::string_view name) const {
  return static_cast<std::uint8_t>(bytes_[field(name, kByte).offset]);
}

void TensorFile::fail(const std::string& what) const {
  throw FileError(path_, what);
}

namespace {

constexpr std::size_t kAlignment = 8;

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::size_t aligned(std::size_t offset) {
  return (offset + kAlignment - 1) / kAlignment * kAlignment;
}

std::string_view data_of(const TensorField& field) {
  const auto view = [&](const auto& values) {
    std::size_t expected = 1;
    for (const std::size_t extent : field.shape) expected *= extent;
    if (values.size() != expected) {
      throw std::invalid_argument("write_tensor_file: " + label(field.name) + " has " + std::to_string(values.size()) +
                                  " values, its shape says " + std::to_string(expected));
    }
    return std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]);
  };
  return std::visit(view, field.values);
}

}  // namespace

void write_tensor_file(const std::filesystem::path& path, std::span<const TensorField> fields) {
  std::string bytes(kMagic);
  append(bytes, std::uint8_t{1});
  append(bytes, std::uint8_t{0});
  append(bytes, static_cast<std::uint32_t>(fields.size()));
  std::size_t offset = bytes.size();
  for (const TensorField& field : fields) offset += 2 + field.name.size() + 2 + 1 + 8 + 8 * field.shape.size();
  for (const TensorField& field : fields) {
    offset = aligned(offset);
    append(bytes, static_cast<std::uint16_t>(field.name.size()));
    bytes += field.name;
    append(bytes, static_cast<std::uint16_t>(field.shape.size()));
    append(bytes, std::holds_alternative<std::vector<float>>(field.values) ? kFloat32 : kByte);
    append(bytes, static_cast<std::uint64_t>(offset));
    for (const std::size_t extent : field.shape) append(bytes, static_cast<std::uint64_t>(extent));
    offset += data_of(field).size();
  }
  for (const TensorField& field : fields) {
    bytes.resize(aligned(bytes.size()));
    bytes += data_of(field);
  }
  write_file(path, bytes);
}

}  // namespace sklar::brdf
