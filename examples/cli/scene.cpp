#include "examples/cli/scene.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <filesystem>
#include <memory>
#include <string_view>

#include "brdf/render/built_in_scenes.hpp"
#include "brdf/render/scene_io.hpp"
#include "brdf/sampling/sampled_brdf.hpp"

namespace sklar::cli {
namespace {

int parse_pixels(std::string_view text, const std::string& size) {
  int pixels = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), pixels);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw CLI::ValidationError("--size " + size, "must be WxH, or H for the shape of the scene, in pixels");
  }
  return pixels;
}

}  // namespace

void set_size(const std::string& size, int& width, int& height) {
  if (size.empty()) return;
  const std::size_t cross = size.find('x');
  if (cross != std::string::npos) {
    width = parse_pixels(std::string_view(size).substr(0, cross), size);
    height = parse_pixels(std::string_view(size).substr(cross + 1), size);
    return;
  }
  const int pixels = parse_pixels(size, size);
  width = static_cast<int>(static_cast<double>(width) * pixels / height);
  height = pixels;
}

brdf::Scene load_scene(const std::string& name, std::span<const brdf::BrdfPtr> materials) {
  if (name == "spheres" || name == "sphere") return brdf::spheres_scene(materials);
  if (name == "room") return brdf::room_scene(materials);
  return brdf::read_scene(name, materials);
}

void make_samplers(brdf::Scene& scene, std::span<brdf::BrdfPtr> materials) {
  for (brdf::BrdfPtr& material : materials) {
    brdf::BrdfPtr sampled;
    for (brdf::Object& object : scene.objects) {
      if (object.material != material) continue;
      if (!sampled) sampled = std::make_shared<const brdf::SampledBrdf>(material);
      object.material = sampled;
    }
    if (sampled) material = sampled;
  }
}

std::string check_scene(const std::string& name) {
  const bool known = name == "sphere" || name == "spheres" || name == "room";
  return known || std::filesystem::path(name).extension() == ".json"
             ? ""
             : "unknown scene '" + name + "'; there are sphere, spheres, room and files that end in .json";
}

}  // namespace sklar::cli
