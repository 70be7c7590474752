#pragma once
/// Models only what a scene requires: the smallest refined model whose picture of the scene is good enough.

#include <functional>
#include <string>
#include <vector>

#include "brdf/model/refined_fit.hpp"
#include "brdf/study/image_metrics.hpp"
#include "brdf/study/scene_use.hpp"

namespace sklar::brdf {

/// How far a picture may be from the reference: psnr_gamma_db at least, or delta_e_2000 at most, of image_errors at the
/// display_exposure of the reference.
struct ImageTolerance {
  enum class Measure { psnr, delta_e };
  Measure measure = Measure::psnr;
  double value = 40;

  [[nodiscard]] bool meets(const ImageErrors& errors) const;
};

/// How models for a scene are fitted and judged.
struct SceneFitOptions {
  RefinedFitOptions fit = {};           ///< structure, bits and importance are not used
  std::vector<int> bits = {8, 10, 12};  ///< of a stored coefficient
  ImageTolerance tolerance = {};
  int samples = 16;  ///< paths a pixel
  std::uint64_t seed = 1;
};

/// One model and its picture.
struct SceneModel {
  RefinedFit fit = {};
  int bits = 0;
  ImageErrors errors = {};
  Image image;
};

/// The models tried, and the smallest that are good enough with and without the scene.
struct SceneChoice {
  SceneUse use;
  Image reference;
  std::vector<SceneModel> tried;  ///< of the scene, in the order in which they were fitted
  SceneModel scene;               ///< the smallest that meets the tolerance, fitted to the scene
  SceneModel general;             ///< the smallest that does of those fitted to all cells alike
};

/// From the smallest structure on, each with as many coefficients as it would have on the part of the axes that the
/// scene uses, fitted to the cells by what they count in the picture, until one meets the tolerance; then without
/// azimuth, with the colour constant along either axis and with less precise coefficients where the picture allows it.
/// The same for a model of all cells. All pictures are of the same paths, so that their differences are those of the
/// models.
/// @param scene with objects of the material `shown`, which reflects as the table; its sampler draws the directions.
/// @param progress called with what is being done.
/// @throws std::invalid_argument as render_paths and fit_refined; std::runtime_error where the picture does not show
/// the material, or naming the best model where none meets the tolerance.
[[nodiscard]] SceneChoice fit_for_scene(const MeasuredTable& table, const Scene& scene, const BrdfPtr& shown,
                                        const SceneFitOptions& options = {},
                                        const std::function<void(const std::string&)>& progress = {});

/// The models tried and those chosen as a Markdown table, and what was saved.
[[nodiscard]] std::string to_markdown(const SceneChoice& choice);

/// The reference, both chosen models and their differences.
void write_scene_figure(const std::filesystem::path& path, const std::string& title, const SceneChoice& choice);

}  // namespace sklar::brdf
