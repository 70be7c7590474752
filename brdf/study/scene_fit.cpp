#include "brdf/study/scene_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "brdf/model/spline.hpp"
#include "brdf/sampling/drawn_by.hpp"
#include "brdf/study/figures.hpp"

namespace sklar::brdf {
namespace {

/// Structures of the whole domain, each larger and more exact than the one before.
const std::vector<RefinedStructure>& scene_ladder() {
  const auto rung = [](int components, int half, int difference, int azimuth, int azimuth_difference) {
    return RefinedStructure{.components = components,
                            .half = half,
                            .difference = difference,
                            .colour_half = 4,
                            .colour_difference = 4,
                            .azimuth = azimuth,
                            .azimuth_difference = azimuth_difference};
  };
  static const std::vector<RefinedStructure> kLadder = {
      rung(1, 6, 5, 2, 4),    rung(1, 10, 6, 2, 4),  rung(2, 10, 6, 2, 4),  rung(2, 14, 8, 3, 5),
      rung(3, 14, 9, 3, 5),   rung(4, 16, 10, 4, 6), rung(5, 18, 12, 4, 6), rung(6, 24, 14, 4, 8),
      rung(7, 32, 18, 4, 10), rung(8, 48, 24, 4, 12)};
  return kLadder;
}

/// As many spline coefficients as `count` over the whole axis are on the range.
int on_range(int count, const AxisRange& range) {
  const double intervals = static_cast<double>(count - kSplineOrder + 1) * (range.high - range.low) / AxisRange::kWhole;
  return kSplineOrder - 1 + std::max(1, static_cast<int>(std::ceil(intervals)));
}

RefinedStructure on_part(RefinedStructure structure, const SceneUse& use) {
  structure.half_range = use.half_range;
  structure.difference_range = use.difference_range;
  structure.half = on_range(structure.half, use.half_range);
  structure.difference = on_range(structure.difference, use.difference_range);
  structure.azimuth_difference = on_range(structure.azimuth_difference, use.difference_range);
  return structure;
}

/// Fits of a material judged by the picture of a scene.
class Judge {
 public:
  Judge(const MeasuredTable& table, const Scene& scene, const BrdfPtr& shown, const SceneFitOptions& options,
        const std::function<void(const std::string&)>& progress)
      : table_(table),
        scene_(scene),
        shown_(shown),
        options_(options),
        progress_(progress),
        reference_(picture(shown)) {
    scene_.exposure = display_exposure(reference_);
  }

  [[nodiscard]] const Image& reference() const { return reference_; }

  [[nodiscard]] SceneUse use() const {
    return scene_use(scene_, *shown_, RefinedStructure().width, {.samples = options_.samples, .seed = options_.seed});
  }

  [[nodiscard]] SceneModel fit(const RefinedStructure& structure,
                               std::shared_ptr<const CellImportance> importance) const {
    RefinedFitOptions fit = options_.fit;
    fit.structure = structure;
    fit.importance = std::move(importance);
    fit.bits = *std::max_element(options_.bits.begin(), options_.bits.end());
    if (progress_) {
      progress_(std::to_string(structure.components) + " components of " + std::to_string(structure.half) + " x " +
                std::to_string(structure.difference));
    }
    return judged(fit_refined(table_, fit), fit.bits);
  }

  /// With fewer bits, as few as the tolerance allows.
  [[nodiscard]] SceneModel with_fewest_bits(SceneModel model) const {
    std::vector<int> bits = options_.bits;
    std::sort(bits.begin(), bits.end());
    for (const int fewer : bits) {
      if (fewer >= model.bits) break;
      SceneModel smaller = judged(with_bits(model.fit, fewer), fewer);
      if (meets(smaller)) return smaller;
    }
    return model;
  }

  [[nodiscard]] bool meets(const SceneModel& model) const { return options_.tolerance.meets(model.errors); }

 private:
  [[nodiscard]] Image picture(const BrdfPtr& material) const {
    Scene scene = scene_;
    for (Object& object : scene.objects) {
      if (object.material == shown_) object.material = material;
    }
    return render_paths(scene, {.samples = options_.samples, .seed = options_.seed});
  }

  [[nodiscard]] SceneModel judged(const RefinedFit& fit, int bits) const {
    SceneModel model{.fit = fit, .bits = bits, .image = picture(std::make_shared<DrawnBy>(fit.brdf, shown_))};
    model.errors = image_errors(reference_, model.image, scene_.exposure);
    return model;
  }

  const MeasuredTable& table_;
  Scene scene_;
  const BrdfPtr& shown_;
  const SceneFitOptions& options_;
  const std::function<void(const std::string&)>& progress_;
  Image reference_;
};

std::string describe(const SceneModel& model, const char* what) {
  const RefinedStructure& s = model.fit.brdf->structure();
  char row[240];
  std::snprintf(row, sizeof row,
                "| %d | %d x %d | %d to %d | %d to %d | %d | %d x %d | %d | %zu | %.1f | %.3f | %s |\n", s.components,
                s.half, s.difference, s.half_range.low, s.half_range.high, s.difference_range.low,
                s.difference_range.high, s.azimuth, s.colour_half, s.colour_difference, model.bits,
                model.fit.brdf->bytes(), model.errors.psnr_gamma_db, model.errors.delta_e_2000, what);
  return row;
}

/// The first structure whose model meets the tolerance, without azimuth, with the colour constant along either axis and
/// with fewer bits where that still does.
SceneModel smallest(const Judge& judge, const std::function<RefinedStructure(const RefinedStructure&)>& structure_of,
                    const std::shared_ptr<const CellImportance>& importance, std::vector<SceneModel>* tried) {
  SceneModel last;
  for (const RefinedStructure& rung : scene_ladder()) {
    const RefinedStructure structure = structure_of(rung);
    last = judge.fit(structure, importance);
    if (tried != nullptr) tried->push_back(last);
    if (!judge.meets(last)) continue;
    const auto simplify = [&](const auto& drop) {
      RefinedStructure without = last.fit.brdf->structure();
      drop(without);
      const SceneModel simpler = judge.fit(without, importance);
      if (tried != nullptr) tried->push_back(simpler);
      if (judge.meets(simpler)) last = simpler;
    };
    simplify([](RefinedStructure& s) { s.azimuth = 0; });
    simplify([](RefinedStructure& s) { s.colour_difference = 1; });
    simplify([](RefinedStructure& s) { s.colour_half = 1; });
    return judge.with_fewest_bits(last);
  }
  char text[160];
  std::snprintf(text, sizeof text,
                "no model meets the tolerance; the most exact one has %.1f dB, Delta-E %.3f in %zu bytes",
                last.errors.psnr_gamma_db, last.errors.delta_e_2000, last.fit.brdf->bytes());
  throw std::runtime_error(text);
}

}  // namespace

bool ImageTolerance::meets(const ImageErrors& errors) const {
  return measure == Measure::psnr ? errors.psnr_gamma_db >= value : errors.delta_e_2000 <= value;
}

SceneChoice fit_for_scene(const MeasuredTable& table, const Scene& scene, const BrdfPtr& shown,
                          const SceneFitOptions& options, const std::function<void(const std::string&)>& progress) {
  if (options.bits.empty()) throw std::invalid_argument("fit_for_scene: no bits to try");
  if (progress) progress("what the scene uses");
  const Judge judge(table, scene, shown, options, progress);
  SceneChoice choice;
  choice.use = judge.use();
  choice.reference = judge.reference();
  choice.scene = smallest(
      judge, [&](const RefinedStructure& rung) { return on_part(rung, choice.use); }, choice.use.importance,
      &choice.tried);
  if (progress) progress("without the scene");
  choice.general = smallest(
      judge, [](const RefinedStructure& rung) { return rung; }, nullptr, nullptr);
  return choice;
}

std::string to_markdown(const SceneChoice& choice) {
  std::string text =
      "| components | theta_h x theta_d | theta_h, 64ths | theta_d, 64ths | azimuth | colour | bits | bytes | PSNR, dB "
      "| "
      "Delta-E | |\n| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n";
  for (const SceneModel& model : choice.tried) text += describe(model, "");
  text += describe(choice.scene, "chosen") + describe(choice.general, "without the scene");
  const std::size_t bytes = choice.scene.fit.brdf->bytes(), general = choice.general.fit.brdf->bytes();
  char saved[160];
  std::snprintf(saved, sizeof saved, "\n%zu bytes instead of %zu: %.1f times smaller\n", bytes, general,
                static_cast<double>(general) / static_cast<double>(bytes));
  return text + saved;
}

void write_scene_figure(const std::filesystem::path& path, const std::string& title, const SceneChoice& choice) {
  const auto label = [](const char* what, const SceneModel& model) {
    return what + std::to_string(model.fit.brdf->bytes()) + " bytes";
  };
  const std::array<SpherePair, 2> pairs = {
      {{label("for the scene, ", choice.scene), &choice.reference, &choice.scene.image},
       {label("for all scenes, ", choice.general), &choice.reference, &choice.general.image}}};
  write_sphere_figure(path, title, pairs);
}

}  // namespace sklar::brdf
