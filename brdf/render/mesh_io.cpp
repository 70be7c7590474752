#include "brdf/render/mesh_io.hpp"

#include <stdexcept>

#include "copula/error.hpp"
#include "copula/file.hpp"

namespace sklar::brdf {

TriangleMesh read_mesh(const std::filesystem::path& path) {
  const std::filesystem::path extension = path.extension();
  if (extension != ".obj" && extension != ".ply") throw FileError(path.string(), "a mesh ends in .obj or .ply");
  const std::string bytes = read_file(path);
  try {
    TriangleMesh mesh = extension == ".obj" ? parse_obj(bytes) : parse_ply(bytes);
    require_mesh(mesh);
    return mesh;
  } catch (const std::invalid_argument& error) {
    throw FileError(path.string(), error.what());
  }
}

}  // namespace sklar::brdf
