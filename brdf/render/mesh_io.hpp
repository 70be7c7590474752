#pragma once
/// Mesh files: Wavefront OBJ and PLY, ASCII or binary little endian.

#include <filesystem>
#include <string_view>

#include "brdf/render/mesh.hpp"

namespace sklar::brdf {

/// The mesh of a `.obj` or `.ply` file, by its extension. Of OBJ `v`, `vn` and `f` are read, of PLY the elements
/// `vertex` (x y z, nx ny nz) and `face` (vertex_indices or vertex_index); everything else is passed over. Polygons are
/// cut into a fan from their first corner, which is right for convex ones. Normals are scaled to length 1 and used
/// where every corner has one.
/// @throws FileError for a missing file or another extension, anything that cannot be read (OBJ: with its line), an
/// index out of range, and what require_mesh refuses.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& path);

/// The same of the bytes of a file. Memory is at most a multiple of their number, whatever a header promises.
/// @throws std::invalid_argument
[[nodiscard]] TriangleMesh parse_obj(std::string_view text);
[[nodiscard]] TriangleMesh parse_ply(std::string_view bytes);

}  // namespace sklar::brdf
