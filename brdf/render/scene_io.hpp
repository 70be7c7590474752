#pragma once
/// Scenes as JSON; docs/scenes.md describes the form.

#include <filesystem>
#include <span>
#include <string_view>

#include "brdf/render/scene.hpp"

namespace sklar::brdf {

/// The newest version read.
inline constexpr int kSceneVersion = 1;

/// The scene of a file. Paths in it are relative to its folder. Materials from files become SampledBrdf.
/// @param given what materials of the form {"given": 1} are, in this order.
/// @throws FileError in one line: not JSON, an unknown key (with the nearest known one), a missing or bad field, an
/// unknown material, what require_scene refuses; and as read_mesh, read_exr, read_material_brdf and read_brdf do.
[[nodiscard]] Scene read_scene(const std::filesystem::path& path, std::span<const BrdfPtr> given);

/// The same of a text. @param source names it in errors. @param folder of the paths in it.
[[nodiscard]] Scene parse_scene(std::string_view text, std::string_view source, const std::filesystem::path& folder,
                                std::span<const BrdfPtr> given);

}  // namespace sklar::brdf
