#pragma once
/// Scenes that need no file.

#include <span>
#include <string_view>

#include "brdf/render/scene.hpp"

namespace sklar::brdf {

/// A sphere of each material in a row, seen from afar, under studio_environment and a directional light. 256 x 256
/// pixels a sphere. @throws std::invalid_argument for no material.
[[nodiscard]] Scene spheres_scene(std::span<const BrdfPtr> materials);

/// A room under a ceiling light and a lit window: a vase on a pedestal, a large sphere and a torus of the materials, in
/// turn where there are several, among analytic ones. @throws std::invalid_argument for no material.
[[nodiscard]] Scene room_scene(std::span<const BrdfPtr> materials);

}  // namespace sklar::brdf
