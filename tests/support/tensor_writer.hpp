#pragma once
/// Tensor files made by tests, right or deliberately wrong.

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace sklar::test {

struct TensorField {
  std::string name;
  std::uint8_t type;
  std::vector<std::uint64_t> shape;
  std::string data;
};

template <class T>
void append(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

inline TensorField floats(std::string name, std::vector<std::uint64_t> shape, const std::vector<float>& values) {
  TensorField field{std::move(name), 10, std::move(shape), {}};
  for (const float value : values) append(field.data, value);
  return field;
}

inline std::string tensor_file(const std::vector<TensorField>& fields) {
  std::size_t offset = 18;
  for (const TensorField& field : fields) offset += 2 + field.name.size() + 2 + 1 + 8 + 8 * field.shape.size();
  std::string bytes("tensor_file\0\1\0", 14);
  append(bytes, static_cast<std::uint32_t>(fields.size()));
  for (const TensorField& field : fields) {
    append(bytes, static_cast<std::uint16_t>(field.name.size()));
    bytes += field.name;
    append(bytes, static_cast<std::uint16_t>(field.shape.size()));
    append(bytes, field.type);
    append(bytes, static_cast<std::uint64_t>(offset));
    for (const std::uint64_t extent : field.shape) append(bytes, extent);
    offset += field.data.size();
  }
  for (const TensorField& field : fields) bytes += field.data;
  return bytes;
}

}  // namespace sklar::test
