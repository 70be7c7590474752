#pragma once
/// Named arrays in one file, the container of `.bsdf` materials (Dupuy and Jakob 2018, "An Adaptive Parameterization
/// for Efficient Material Acquisition and Rendering", supplement). Little-endian: `tensor_file\0`, u8 1, u8 0, u32
/// fields; per field u16 name length, name, u16 dimensions, u8 type, u64 offset, dimensions x u64 shape; row-major
/// data.

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sklar::brdf {

/// A field of a file.
struct FloatTensor {
  std::vector<std::size_t> shape;
  std::vector<float> values;  ///< row-major, finite
};

/// A parsed file; every name, type, shape and offset has been checked against the file's size.
class TensorFile {
 public:
  /// @throws FileError naming the file and the field: no regular file, no tensor file, unknown version or type, an
  /// entry or an array that ends past the file, a name that occurs twice.
  explicit TensorFile(const std::filesystem::path& path);

  [[nodiscard]] bool has(std::string_view name) const { return fields_.find(name) != fields_.end(); }

  /// A copy of a float32 array. @throws FileError if the field is missing, of another type or number of dimensions,
  /// empty, or holds a value that is not finite.
  [[nodiscard]] FloatTensor floats(std::string_view name, std::size_t dimensions) const;

  /// The first byte of a uint8 array. @throws FileError if the field is missing, of another type or empty.
  [[nodiscard]] std::uint8_t byte(std::string_view name) const;

  /// @throws FileError about this file, always.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  struct Field {
    std::uint8_t type;
    std::vector<std::size_t> shape;
    std::size_t count;  ///< product of shape
    std::size_t offset;
  };
  class Cursor;

  [[nodiscard]] Field read_field(Cursor& cursor, const std::string& name) const;
  [[nodiscard]] const Field& field(std::string_view name, std::uint8_t type) const;

  std::string path_;
  std::string bytes_;
  std::map<std::string, Field, std::less<>> fields_;
};

/// One array to write.
struct TensorField {
  std::string name;
  std::vector<std::size_t> shape;
  std::variant<std::vector<float>, std::vector<std::uint8_t>> values;  ///< row-major, as many as the shape says
};

/// Writes a file, whole or not at all: the fields in this order, each array at a multiple of 8 bytes. The same fields
/// give the same bytes.
/// @throws std::invalid_argument naming the field whose values are not as many as its shape says; FileError if the file
/// cannot be written.
void write_tensor_file(const std::filesystem::path& path, std::span<const TensorField> fields);

}  // namespace sklar::brdf
