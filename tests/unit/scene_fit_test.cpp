#include "brdf/study/scene_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/data/table_brdf.hpp"
#include "brdf/sampling/sampled_brdf.hpp"

namespace sklar::brdf {
namespace {

BrdfPtr grey(double albedo) {
  return std::make_shared<const Lambert>(Rgb::Constant(albedo));
}

/// A sphere lit from where it is seen: wi is nearly wo everywhere.
Scene frontal(BrdfPtr material) {
  Scene scene;
  scene.camera = {.position = {0, 0, 50}, .field_of_view = 2.6};
  scene.objects.push_back({.name = "ball", .shape = Sphere{}, .material = std::move(material)});
  scene.lights.push_back({.direction = {0, 0, 1}, .irradiance = Rgb::Constant(2)});
  scene.background = Rgb::Zero();
  scene.width = scene.height = 24;
  scene.depth = 1;
  return scene;
}

TEST(LightUses, AddUpToThePicture) {
  const Scene scene = frontal(grey(0.6));
  const PathOptions options{.samples = 2};
  const Image image = render_paths(scene, options);
  double expected = 0;  // y d y^(1/2.2) / dy
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const auto y = static_cast<double>(image.at(row, column, 1));
      if (y > 1e-3) expected += std::pow(y, 1 / 2.2) / 2.2;
    }
  }
  double total = 0;
  for (const LightUse& use : light_uses(scene, *scene.objects[0].material, options)) total += use.light;
  constexpr double kSingle = 1e-5;  // relative, of pixels, and pixels almost black
  EXPECT_NEAR(total, expected, kSingle * expected);
}

TEST(LightUses, CountEveryReflectionOfAPath) {
  Scene scene = frontal(grey(0.5));
  scene.environment = std::make_shared<const EnvironmentMap>(EnvironmentMap::constant(Rgb::Constant(0.1)));
  Object below{.name = "below", .shape = Sphere{.centre = {0, -1.5, 0}, .radius = 0.5}, .material = grey(0.9)};
  scene.objects.push_back(below);
  const auto light = [&](int depth) {
    scene.depth = depth;
    double sum = 0;
    for (const LightUse& use : light_uses(scene, *below.material, {.samples = 16})) sum += use.light;
    return sum;
  };
  EXPECT_GT(light(4), 1.01 * light(1)) << "by way of the other sphere";
  EXPECT_TRUE(light_uses(scene, *grey(0.5), {.samples = 1}).empty()) << "not a material of the scene";
}

TEST(SceneUse, IsWhereTheLightIs) {
  const Scene scene = frontal(grey(0.6));
  const SceneUse use = scene_use(scene, *scene.objects[0].material, 0.05, {.samples = 16});
  EXPECT_EQ(use.difference_range.low, 0);
  EXPECT_LE(use.difference_range.high, 3) << "theta_d = 0";
  EXPECT_EQ(use.half_range.high, 64) << "up to grazing";
  double sum = 0;
  for (int i = 0; i < Grid::theta_h; ++i) {
    for (int j = 0; j < Grid::theta_d; ++j) {
      for (int k = 0; k < CellImportance::kAzimuths; ++k) {
        const double value = use.importance->bin(i, j, k);
        sum += value;
        if (j > 6) {
          EXPECT_LT(value, 2e-3);
        }
      }
    }
  }
  constexpr double kFloor = 2e-3;  // relative: what was added where no light came
  EXPECT_NEAR(sum / (Grid::theta_h * Grid::theta_d * CellImportance::kAzimuths), 1, kFloor);
  RefinedStructure structure;
  structure.difference_range = {0, 32};
  EXPECT_EQ(share_outside(scene, *scene.objects[0].material, structure, {.samples = 1}), 0);
  structure.difference_range = {32, 64};
  EXPECT_EQ(share_outside(scene, *scene.objects[0].material, structure, {.samples = 1}), 1);
  EXPECT_THROW((void)scene_use(scene, *grey(0.1), 0.05, {.samples = 1}), std::runtime_error);
}

TEST(SceneFit, TakesASmallerModelWhereTheSceneAllowsIt) {
  const auto table = std::make_shared<const MeasuredTable>(builtin_material());
  const BrdfPtr shown = std::make_shared<const SampledBrdf>(std::make_shared<const TableBrdf>(table));
  const Scene scene = frontal(shown);
  const SceneFitOptions options{.fit = {.evaluations = 60}, .tolerance = {.value = 34}, .samples = 1};
  const SceneChoice choice = fit_for_scene(*table, scene, shown, options);
  EXPECT_GE(choice.scene.errors.psnr_gamma_db, options.tolerance.value);
  EXPECT_GE(choice.general.errors.psnr_gamma_db, options.tolerance.value);
  EXPECT_LT(choice.scene.fit.brdf->bytes(), choice.general.fit.brdf->bytes());
  EXPECT_FALSE(is_whole(choice.scene.fit.brdf->structure()));
  EXPECT_TRUE(is_whole(choice.general.fit.brdf->structure()));
  EXPECT_NE(to_markdown(choice).find("times smaller"), std::string::npos);
  SceneFitOptions impossible = options;
  impossible.fit.evaluations = 1;
  impossible.tolerance.value = 200;
  try {
    (void)fit_for_scene(*table, scene, shown, impossible);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no model meets the tolerance; the most exact one has"),
              std::string::npos);
  }
}

TEST(ImageTolerance, IsOfEitherMeasure) {
  const ImageErrors errors{.psnr_gamma_db = 41, .ssim = 0.99, .delta_e_2000 = 0.7};
  using Measure = ImageTolerance::Measure;
  EXPECT_TRUE((ImageTolerance{Measure::psnr, 40}.meets(errors)));
  EXPECT_FALSE((ImageTolerance{Measure::psnr, 42}.meets(errors)));
  EXPECT_TRUE((ImageTolerance{Measure::delta_e, 1}.meets(errors)));
  EXPECT_FALSE((ImageTolerance{Measure::delta_e, 0.5}.meets(errors)));
}

}  // namespace
}  // namespace sklar::brdf
