#include "examples/cli/brdf_fit_scene.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "brdf/data/table_brdf.hpp"
#include "brdf/model/model_io.hpp"
#include "brdf/sampling/sampled_brdf.hpp"
#include "copula/error.hpp"
#include "copula/file.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/material.hpp"
#include "examples/cli/scene.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

constexpr int kLongestSide = 128;  // pixels, unless --size says otherwise

void shrink(brdf::Scene& scene) {
  const int longest = std::max(scene.width, scene.height);
  if (longest <= kLongestSide) return;
  scene.width = std::max(16, scene.width * kLongestSide / longest);
  scene.height = std::max(16, scene.height * kLongestSide / longest);
}

std::filesystem::path picture_path(const std::filesystem::path& output) {
  return output.parent_path() / (output.stem().string() + "_scene.png");
}

nlohmann::ordered_json json_model(const brdf::SceneModel& model) {
  return {{"bytes", model.fit.brdf->bytes()},
          {"components", model.fit.brdf->structure().components},
          {"bits", model.bits},
          {"psnr_gamma_db", model.errors.psnr_gamma_db},
          {"delta_e_2000", model.errors.delta_e_2000}};
}

}  // namespace

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command
      .add_option("--scene", options.scene,
                  "refined: the smallest model whose picture of this scene keeps --max-error, 40dB unless given")
      ->check(check_scene)
      ->type_name(kSceneNames);
  command.add_option("--size", options.size, "of the pictures of --scene, or the height alone; omitted: 128 at most")
      ->type_name("WxH");
  command.add_option("--spp", options.samples, "paths a pixel of the pictures of --scene")
      ->check(CLI::Range(1, 1 << 16))
      ->capture_default_str();
}

brdf::ImageTolerance parse_tolerance(const std::string& text) {
  constexpr std::size_t kUnit = 2;
  const std::string unit = text.size() > kUnit ? text.substr(text.size() - kUnit) : "";
  double value = 0;
  const bool known = unit == "dB" || unit == "dE";
  if (!known || !CLI::detail::lexical_cast(text.substr(0, text.size() - kUnit), value) || !(value > 0)) {
    throw std::invalid_argument("--max-error " + text +
                                ": with --scene it is a PSNR at least, as 40dB, or a CIEDE2000 at most, as 0.5dE");
  }
  using Measure = brdf::ImageTolerance::Measure;
  return {.measure = unit == "dB" ? Measure::psnr : Measure::delta_e, .value = value};
}

void run_scene_fit(const brdf::MeasuredTable& table, const SceneOptions& options, const FitOptions& fit,
                   const brdf::ImageTolerance& tolerance, std::uint64_t seed, const std::string& output, bool json) {
  const std::filesystem::path picture = picture_path(output);
  require_writable(picture);
  const auto shared = std::make_shared<const brdf::MeasuredTable>(table);
  std::array<brdf::BrdfPtr, 1> materials = {
      std::make_shared<const brdf::SampledBrdf>(std::make_shared<const brdf::TableBrdf>(shared))};
  brdf::Scene scene = load_scene(options.scene, materials);
  shrink(scene);
  set_size(options.size, scene.width, scene.height);
  brdf::SceneFitOptions choices{.fit = fit.refined, .tolerance = tolerance, .samples = options.samples, .seed = seed};
  if (fit.bits) choices.bits = {*fit.bits};
  const StepLine steps;
  const brdf::SceneChoice choice = brdf::fit_for_scene(
      table, scene, materials[0], choices, [&](const std::string& what) { steps.show(table.name + ": " + what); });
  brdf::write_brdf(output, {.material = table.name, .provenance = table.provenance, .model = choice.scene.fit.brdf});
  brdf::write_scene_figure(
      picture, table.name + " in the scene " + std::filesystem::path(options.scene).stem().string(), choice);
  if (!json) {
    std::cout << to_markdown(choice) << picture.string() << '\n';
    return;
  }
  print_json({{"material", table.name},
              {"mode", "refined"},
              {"reflections", choice.use.reflections},
              {"scene", json_model(choice.scene)},
              {"general", json_model(choice.general)},
              {"picture", picture.string()}});
}

}  // namespace sklar::cli
