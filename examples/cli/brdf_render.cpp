#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>

#include "brdf/render/path_tracer.hpp"
#include "brdf/render/swapped.hpp"
#include "brdf/render/turned_sphere.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/fitted_part.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/scene.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

struct Options {
  std::vector<std::string> materials;
  std::string scene = "sphere";
  std::string size;
  int samples = 64;
  bool has_samples = false;
  bool swap = false;
  std::uint64_t seed = 1;
  std::filesystem::path output;
};

struct Picture {
  brdf::Image image;
  double exposure = 1;
};

/// Without noise: the sphere has no need of paths.
Picture render_alone(const Options& options) {
  if (options.materials.size() > 1) throw std::invalid_argument("--scene sphere takes one material; try spheres");
  if (options.has_samples)
    throw std::invalid_argument("--spp: --scene sphere is computed without samples; try spheres");
  std::vector<brdf::BrdfPtr> materials = {load_brdf(options.materials.empty() ? "" : options.materials[0])};
  const brdf::BrdfPtr material = materials[0];
  warn_of_scene(load_scene("sphere", materials), options.materials, materials);
  brdf::SphereOptions sphere;
  int width = sphere.size;
  set_size(options.size, width, sphere.size);
  if (width != sphere.size) throw std::invalid_argument("--size " + options.size + ": --scene sphere is square");
  sphere.swap_directions = options.swap;
  sphere.progress = progress_bar("rendering");
  return {material->traits().isotropic ? brdf::render_sphere(*material, sphere)
                                       : brdf::render_turned_sphere(*material, sphere)};
}

Picture render_scene(const Options& options) {
  std::vector<brdf::BrdfPtr> materials;
  for (const std::string& path : options.materials) materials.push_back(load_brdf(path));
  if (materials.empty()) materials.push_back(load_brdf(""));
  brdf::Scene scene = load_scene(options.scene, materials);
  set_size(options.size, scene.width, scene.height);
  brdf::require_scene(scene);
  make_samplers(scene, materials);
  warn_of_scene(scene, options.materials, materials);
  if (options.swap) {
    for (brdf::Object& object : scene.objects) {
      if (object.material) object.material = std::make_shared<const brdf::Swapped>(object.material);
    }
  }
  return {brdf::render_paths(scene,
                             {.samples = options.samples, .seed = options.seed, .progress = progress_bar("rendering")}),
          scene.exposure};
}

void run(const Options& options, bool json) {
  const std::filesystem::path extension = options.output.extension();
  if (extension != ".exr" && extension != ".png") {
    throw FileError(options.output.string(), "a picture ends in .exr or .png");
  }
  const std::filesystem::path png = std::filesystem::path(options.output).replace_extension(".png");
  require_writable(options.output);
  require_writable(png);
  const auto [image, exposure] = options.scene == "sphere" ? render_alone(options) : render_scene(options);
  if (extension == ".exr") brdf::write_exr(options.output, image);
  brdf::write_png(png, image, exposure);
  if (json) {
    print_json(
        {{"output", options.output.string()}, {"png", png.string()}, {"width", image.width}, {"height", image.height}});
  }
}

}  // namespace

void add_brdf_render(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand(
      "render", "a picture of materials: a sphere (of an anisotropic one as if turned on a lathe) or a scene");
  const auto options = std::make_shared<Options>();
  command->add_option("MATERIAL", options->materials, std::string(kMaterialHelp) + "; or a model .json or .sklar");
  command
      ->add_option("--scene", options->scene,
                   "sphere; by path tracing spheres (one a material), room, or a file as in docs/scenes.md")
      ->check(check_scene)
      ->type_name(kSceneNames)
      ->capture_default_str();
  command->add_option("--size", options->size, "pixels, or the height alone")->type_name("WxH");
  CLI::Option* samples = command->add_option("--spp", options->samples, "paths a pixel; powers of two are spread best")
                             ->check(CLI::Range(1, 1 << 24))
                             ->capture_default_str();
  command->add_flag("--swap", options->swap, "evaluate f(wi, wo): the same picture where the materials are reciprocal");
  command
      ->add_option("-o", options->output, "OUT.exr (linear; OUT.png beside it) or OUT.png (sRGB, values above 1 cut)")
      ->required();
  finish_command(*command, common, [options, samples, &common] {
    options->has_samples = samples->count() > 0;
    options->seed = common.seed;
    run(*options, common.json);
  });
}

}  // namespace sklar::cli
