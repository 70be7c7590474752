#pragma once
/// Scenes on the command line: what `brdf render` and `brdf fit --scene` share.

#include <span>
#include <string>

#include "brdf/render/scene.hpp"

namespace sklar::cli {

/// What check_scene takes.
inline constexpr const char* kSceneNames = "sphere|spheres|room|FILE.json";

/// As CLI11 wants it: what is wrong, or nothing.
[[nodiscard]] std::string check_scene(const std::string& name);

/// The scene spheres (of one material: sphere), room or of a file, with these materials, and no samplers made for them.
[[nodiscard]] brdf::Scene load_scene(const std::string& name, std::span<const brdf::BrdfPtr> materials);

/// Gives each of the materials, where it is used, a sampler made for it, in the scene and in the list.
void make_samplers(brdf::Scene& scene, std::span<brdf::BrdfPtr> materials);

/// @param size WxH, or H alone, which keeps the ratio of width to height; empty changes nothing.
/// @throws CLI::ValidationError for another text.
void set_size(const std::string& size, int& width, int& height);

}  // namespace sklar::cli
