#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "brdf/render/turned_sphere.hpp"
#include "copula/error.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

struct Options {
  std::string material;
  std::string scene = "sphere";
  int size = 256;
  bool swap = false;
  std::string output;
};

void run(const Options& options, bool json) {
  const std::filesystem::path extension = std::filesystem::path(options.output).extension();
  if (extension != ".exr" && extension != ".png") throw FileError(options.output, "a picture ends in .exr or .png");
  brdf::SphereOptions sphere;
  sphere.size = options.size;
  sphere.swap_directions = options.swap;
  sphere.progress = progress_bar("rendering");
  const brdf::BrdfPtr material = load_brdf(options.material);
  const brdf::Image image = material->traits().isotropic ? brdf::render_sphere(*material, sphere)
                                                         : brdf::render_turned_sphere(*material, sphere);
  if (extension == ".exr") {
    brdf::write_exr(options.output, image);
  } else {
    brdf::write_png(options.output, image);
  }
  if (json) print_json({{"output", options.output}});
}

}  // namespace

void add_brdf_render(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand(
      "render", "a picture of the material; of an anisotropic one as if turned on a lathe about the vertical");
  const auto options = std::make_shared<Options>();
  add_material(*command, options->material);
  command->add_option("--scene", options->scene, "what is lit")
      ->check(CLI::IsMember({"sphere"}))
      ->capture_default_str();
  command->add_option("--size", options->size, "pixels a side")->capture_default_str();
  command->add_flag("--swap", options->swap, "evaluate f(wi, wo): the same picture where the material is reciprocal");
  command->add_option("-o", options->output, "OUT.exr (linear) or OUT.png (sRGB)")->required();
  finish_command(*command, common, [options, &common] { run(*options, common.json); });
}

}  // namespace sklar::cli
