#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "brdf/render/mesh_io.hpp"

namespace sklar::brdf {
namespace {

/// The text up to the separator; it and the separator leave `rest`.
std::string_view cut(std::string_view& rest, char separator) {
  const std::size_t end = rest.find(separator);
  const std::string_view head = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return head;
}

/// The next word, empty at the end of the line.
std::string_view word(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r"), rest.size()));
  const std::string_view head = rest.substr(0, rest.find_first_of(" \t\r"));
  rest.remove_prefix(head.size());
  return head;
}

template <class Number>
Number parse_number(std::string_view text, const char* what) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw std::invalid_argument("expected " + std::string(what) + ", found '" + std::string(text) + "'");
  }
  return value;
}

Vec3 parse_vector(std::string_view rest) {
  Vec3 value;
  for (double& coordinate : value) coordinate = parse_number<double>(word(rest), "a coordinate");
  if (!value.allFinite()) throw std::invalid_argument("a coordinate is not finite");
  return value;
}

class ObjReader {
 public:
  void read_line(std::string_view line) {
    line = cut(line, '#');
    const std::string_view keyword = word(line);
    if (keyword == "v") positions_.push_back(parse_vector(line));
    if (keyword == "vn") {
      const Vec3 normal = parse_vector(line);
      if (!(normal.norm() > 0)) throw std::invalid_argument("the normal has no length");
      normals_.push_back(normal.normalized());
    }
    if (keyword == "f") read_face(line);
  }

  TriangleMesh take() {
    if (!every_corner_has_normal_) mesh_.normals.clear();
    return std::move(mesh_);
  }

 private:
  /// Counted from 1, or backward from -1. @return counted from 0.
  static int resolve(std::string_view text, std::size_t count, const char* what) {
    const int index = parse_number<int>(text, "an index");
    const auto size = static_cast<long long>(count);
    const long long resolved = index < 0 ? size + index : index - 1LL;
    if (resolved < 0 || resolved >= size) {
      throw std::invalid_argument("names " + std::string(what) + " " + std::to_string(index) + " of " +
                                  std::to_string(size));
    }
    return static_cast<int>(resolved);
  }

  /// v, v/vt, v//vn or v/vt/vn.
  int corner(std::string_view text) {
    const int position = resolve(cut(text, '/'), positions_.size(), "vertex");
    (void)cut(text, '/');
    const int normal = text.empty() ? -1 : resolve(text, normals_.size(), "normal");
    every_corner_has_normal_ = every_corner_has_normal_ && normal >= 0;
    const auto [entry, added] = corners_.try_emplace({position, normal}, static_cast<int>(mesh_.vertices.size()));
    if (added) {
      mesh_.vertices.push_back(positions_[static_cast<std::size_t>(position)]);
      mesh_.normals.push_back(normal >= 0 ? normals_[static_cast<std::size_t>(normal)] : Vec3::Zero());
    }
    return entry->second;
  }

  void read_face(std::string_view rest) {
    std::array<int, 3> triangle{};
    int count = 0;
    for (std::string_view text = word(rest); !text.empty(); text = word(rest)) {
      triangle[static_cast<std::size_t>(std::min(count, 2))] = corner(text);
      if (++count < 3) continue;
      mesh_.triangles.push_back(triangle);
      triangle[1] = triangle[2];
    }
    if (count < 3) throw std::invalid_argument("a face needs three corners, found " + std::to_string(count));
  }

  std::vector<Vec3> positions_, normals_;
  std::map<std::pair<int, int>, int> corners_;
  TriangleMesh mesh_;
  bool every_corner_has_normal_ = true;
};

}  // namespace

TriangleMesh parse_obj(std::string_view text) {
  ObjReader reader;
  for (std::size_t line = 1; !text.empty(); ++line) {
    try {
      reader.read_line(cut(text, '\n'));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("line " + std::to_string(line) + ": " + error.what());
    }
  }
  return reader.take();
}

}  // namespace sklar::brdf
