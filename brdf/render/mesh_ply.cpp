#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>

#include "brdf/render/mesh_io.hpp"

namespace sklar::brdf {
namespace {
static_assert(std::endian::native == std::endian::little, "binary files are read in memory order");

[[noreturn]] void refuse(const std::string& reason) {
  throw std::invalid_argument(reason);
}

struct Scalar {
  std::string_view name, other_name;
  std::size_t size;
  double (*load)(const char*);
};

template <class T>
double load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

constexpr std::array<Scalar, 8> kScalars{{{"char", "int8", 1, load<std::int8_t>},
                                          {"uchar", "uint8", 1, load<std::uint8_t>},
                                          {"short", "int16", 2, load<std::int16_t>},
                                          {"ushort", "uint16", 2, load<std::uint16_t>},
                                          {"int", "int32", 4, load<std::int32_t>},
                                          {"uint", "uint32", 4, load<std::uint32_t>},
                                          {"float", "float32", 4, load<float>},
                                          {"double", "float64", 8, load<double>}}};

const Scalar& scalar_named(std::string_view name) {
  for (const Scalar& scalar : kScalars) {
    if (name == scalar.name || name == scalar.other_name) return scalar;
  }
  refuse("unknown type '" + std::string(name) + "' of a property");
}

struct Property {
  std::string name;
  const Scalar* type;
  const Scalar* count = nullptr;  ///< type of the length, of a list
};

struct Element {
  std::string name;
  std::size_t count;
  std::vector<Property> properties;
};

/// Takes words, lines and numbers off the front of a file.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}

  [[nodiscard]] std::size_t left() const { return rest_.size(); }
  void set_binary() { binary_ = true; }
  [[nodiscard]] bool binary() const { return binary_; }

  /// The words of the next line.
  std::vector<std::string_view> line() {
    std::string_view text = rest_.substr(0, rest_.find('\n'));
    if (text.size() == rest_.size()) refuse("the header has no end");
    rest_.remove_prefix(text.size() + 1);
    std::vector<std::string_view> words;
    for (Cursor words_left(text);;) {
      const std::string_view next = words_left.word();
      if (next.empty()) return words;
      words.push_back(next);
    }
  }

  double number(const Scalar& type) {
    if (binary_) {
      if (rest_.size() < type.size) refuse("the file ends too soon");
      const double value = type.load(rest_.data());
      rest_.remove_prefix(type.size);
      return value;
    }
    const std::string_view text = word();
    if (text.empty()) refuse("the file ends too soon");
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      refuse("expected a number, found '" + std::string(text) + "'");
    }
    return value;
  }

 private:
  std::string_view word() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
    const std::string_view head = rest_.substr(0, rest_.find_first_of(" \t\r\n"));
    rest_.remove_prefix(head.size());
    return head;
  }

  std::string_view rest_;
  bool binary_ = false;
};

std::size_t parse_count(std::string_view text) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size()) {
    refuse("the count of an element must be a number, found '" + std::string(text) + "'");
  }
  return count;
}

std::vector<Element> read_header(Cursor& cursor) {
  if (cursor.line() != std::vector<std::string_view>{"ply"}) refuse("does not begin with 'ply'");
  std::vector<Element> elements;
  for (;;) {
    const std::vector<std::string_view> words = cursor.line();
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") return elements;
    if (words[0] == "format" && words.size() == 3 && words[1] == "ascii") continue;
    if (words[0] == "format" && words.size() == 3 && words[1] == "binary_little_endian") {
      cursor.set_binary();
    } else if (words[0] == "element" && words.size() == 3) {
      elements.push_back({std::string(words[1]), parse_count(words[2]), {}});
    } else if (words[0] == "property" && words.size() == 3 && !elements.empty()) {
      elements.back().properties.push_back({std::string(words[2]), &scalar_named(words[1])});
    } else if (words[0] == "property" && words.size() == 5 && words[1] == "list" && !elements.empty()) {
      elements.back().properties.push_back({std::string(words[4]), &scalar_named(words[3]), &scalar_named(words[2])});
    } else {
      refuse("the header has a line '" + std::string(words[0]) + (words.size() > 1 ? " " : "") +
             std::string(words.size() > 1 ? words[1] : "") + "' that is not understood (big endian is not read)");
    }
  }
}

/// Refuses a count that the rest of the file cannot hold, before anything is allocated for it.
void require_room(const Element& element, const Cursor& cursor) {
  std::size_t least = 0;
  for (const Property& property : element.properties) {
    least += cursor.binary() ? (property.count != nullptr ? property.count : property.type)->size : 1;
  }
  if (least == 0) refuse("element '" + element.name + "' has no properties");
  if (element.count > cursor.left() / least) {
    refuse("promises " + std::to_string(element.count) + " of element '" + element.name + "', has bytes for at most " +
           std::to_string(cursor.left() / least));
  }
}

std::size_t whole(double value, const char* what) {
  if (!(value >= 0) || value != std::floor(value) || value > 4294967295.0) {
    refuse(std::string(what) + " must be a whole number from 0 on, found " + std::to_string(value));
  }
  return static_cast<std::size_t>(value);
}

/// One entry after another of the properties of an element, to take(property, value).
template <class Take>
void read_entry(Cursor& cursor, const Element& element, const Take& take) {
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    const Property& property = element.properties[p];
    const std::size_t length = property.count == nullptr ? 1 : whole(cursor.number(*property.count), "a length");
    for (std::size_t i = 0; i < length; ++i) take(p, cursor.number(*property.type));
  }
}

std::optional<std::size_t> find_property(const Element& element, std::string_view name) {
  for (std::size_t p = 0; p < element.properties.size(); ++p) {
    if (element.properties[p].name == name) return p;
  }
  return std::nullopt;
}

void read_vertices(Cursor& cursor, const Element& element, TriangleMesh& mesh) {
  constexpr std::array<const char*, 6> kNames{"x", "y", "z", "nx", "ny", "nz"};
  std::vector<std::optional<std::size_t>> slot(element.properties.size());
  std::size_t found = 0;
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    const auto property = find_property(element, kNames[k]);
    if (!property && k < 3) refuse(std::string("element 'vertex' has no property ") + kNames[k]);
    if (property) slot[*property] = k;
    found += property ? 1 : 0;
  }
  for (std::size_t i = 0; i < element.count; ++i) {
    std::array<double, 6> values{};
    read_entry(cursor, element, [&](std::size_t property, double value) {
      if (slot[property]) values[*slot[property]] = value;
    });
    mesh.vertices.emplace_back(values[0], values[1], values[2]);
    if (found < kNames.size()) continue;
    const Vec3 normal(values[3], values[4], values[5]);
    if (!(normal.norm() > 0) || !normal.allFinite()) refuse("normal " + std::to_string(i + 1) + " has no direction");
    mesh.normals.push_back(normal.normalized());
  }
}

void read_faces(Cursor& cursor, const Element& element, TriangleMesh& mesh) {
  auto indices = find_property(element, "vertex_indices");
  if (!indices) indices = find_property(element, "vertex_index");
  if (!indices) refuse("element 'face' has no property vertex_indices");
  for (std::size_t i = 0; i < element.count; ++i) {
    std::array<int, 3> triangle{};
    std::size_t count = 0;
    read_entry(cursor, element, [&](std::size_t property, double value) {
      if (property != *indices) return;
      const std::size_t vertex = whole(value, "an index");
      if (vertex >= mesh.vertices.size()) {
        refuse("face " + std::to_string(i + 1) + " names vertex " + std::to_string(vertex) + " of " +
               std::to_string(mesh.vertices.size()) + ", counted from 0");
      }
      triangle[std::min<std::size_t>(count, 2)] = static_cast<int>(vertex);
      if (++count < 3) return;
      mesh.triangles.push_back(triangle);
      triangle[1] = triangle[2];
    });
    if (count < 3) refuse("face " + std::to_string(i + 1) + " has " + std::to_string(count) + " corners, needs three");
  }
}

}  // namespace

TriangleMesh parse_ply(std::string_view bytes) {
  Cursor cursor(bytes);
  TriangleMesh mesh;
  for (const Element& element : read_header(cursor)) {
    require_room(element, cursor);
    if (element.name == "vertex") {
      read_vertices(cursor, element, mesh);
    } else if (element.name == "face") {
      read_faces(cursor, element, mesh);
    } else {
      for (std::size_t i = 0; i < element.count; ++i) read_entry(cursor, element, [](std::size_t, double) {});
    }
  }
  return mesh;
}

}  // namespace sklar::brdf
