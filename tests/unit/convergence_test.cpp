// The errors of path traced pictures, against what is known of them: their rate, and that samplers agree.

#include "brdf/study/convergence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/sum.hpp"
#include "brdf/render/built_in_scenes.hpp"
#include "brdf/render/hemisphere.hpp"
#include "brdf/sampling/drawn_by.hpp"
#include "brdf/study/efficiency.hpp"
#include "copula/random.hpp"

namespace sklar::brdf {
namespace {

BrdfPtr coated() {
  const Rgb f0 = Rgb::Constant(0.3);
  return with_diffuse(Rgb(0.1, 0.2, 0.4), std::make_shared<const Ggx>(f0, 0.3), f0);
}

Scene sphere_of(const BrdfPtr& material) {
  Scene scene = spheres_scene(std::vector<BrdfPtr>{material});
  scene.width = scene.height = 12;
  return scene;
}

Image constant_image(float value) {
  Image image(4, 2);
  for (float& x : image.rgb) x = value;
  return image;
}

TEST(Convergence, ErrorsAreThoseOfTheirDefinition) {
  // P - A = -1, P - B = 2 in half of the pixels and 2, 2 in the others, where the picture is half as bright.
  ReferencePair reference{.first = constant_image(4), .second = constant_image(1)};
  Image picture = constant_image(3);
  std::vector<bool> dark(8);
  for (std::size_t i = 12; i < 24; ++i) reference.first.rgb[i] = 1, dark[i / 3] = true;
  reference.of_materials = dark;
  const double mean = (2.5 + 1) / 2;
  const PictureErrors errors = picture_errors(picture, reference);
  EXPECT_DOUBLE_EQ(errors.rms, std::sqrt((-2.0 + 4.0) / 2) / mean);
  EXPECT_DOUBLE_EQ(errors.of_materials, 2.0);
  const double bright = 2.5 + 0.01 * mean, darker = 1 + 0.01 * mean;
  EXPECT_DOUBLE_EQ(errors.relative, std::sqrt((-2 / (bright * bright) + 4 / (darker * darker)) / 2));
  reference.of_materials.clear();
  EXPECT_TRUE(std::isnan(picture_errors(picture, reference).of_materials));
  EXPECT_THROW((void)picture_errors(Image(2, 4), reference), std::invalid_argument);
}

TEST(Convergence, AWrapperHasTheAlbedoOfWhatItEvaluates) {
  const BrdfPtr material = coated();
  const DrawnBy drawn(material, ggx_sampler(*material));
  const Vec3 wo(std::sin(0.9), 0, std::cos(0.9));
  const HemisphereNodes nodes = hemisphere_nodes(0.9, {.polar = 64, .azimuth = 128});
  double albedo = 0;
  for (Eigen::Index i = 0; i < nodes.wi.rows(); ++i) {
    albedo += material->eval(wo, Vec3(nodes.wi.row(i).transpose().matrix())).y() * nodes.weight(i);
  }
  constexpr int kDraws = 40000;
  constexpr double kSigmas = 4.5;
  Rng rng(20260917);
  double sum = 0, squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = uniform(rng), v = uniform(rng);
    const Sample sample = drawn.sample(wo, {u, v});
    if (sample.wi.z() > 0) {
      EXPECT_DOUBLE_EQ(sample.pdf, drawn.pdf(wo, sample.wi));
    }
    sum += sample.weight.y();
    squares += sample.weight.y() * sample.weight.y();
  }
  const double mean = sum / kDraws, sigma = std::sqrt((squares / kDraws - mean * mean) / kDraws);
  EXPECT_NEAR(mean, albedo, kSigmas * sigma);
  EXPECT_GT(sigma, 0);
  EXPECT_THROW(DrawnBy(material, nullptr), std::invalid_argument);
}

// Of independent samples the error falls as n^-0.5; the points of a pixel are spread evenly, so somewhat faster.
TEST(Convergence, ErrorsFallAndSamplersAgree) {
  constexpr double kSlowest = -0.4, kFastest = -1.1;
  const std::vector<BrdfPtr> materials = {coated()};
  const Scene scene = sphere_of(materials[0]);
  const std::vector<Drawing> ways = drawings(scene, materials);
  ASSERT_EQ(ways.size(), 3U);
  ReferencePair reference = render_references(ways[0].scene, 2048, 2);
  reference.of_materials = pixels_of(scene, materials);
  std::vector<ConvergenceRow> rows;
  for (const Drawing& way : ways) {
    for (const int samples : {4, 64}) rows.push_back(measure_picture(way, reference, samples, 1).row);
    const double first = rows[rows.size() - 2].errors.of_materials, last = rows.back().errors.of_materials;
    const double slope = std::log(last / first) / std::log(16);
    EXPECT_LT(slope, kSlowest) << way.name << ": " << first << " to " << last;
    EXPECT_GT(slope, kFastest) << way.name << ": " << first << " to " << last;
  }
  EXPECT_LT(rows[1].errors.of_materials, rows[3].errors.of_materials) << "better than the cosine";
}

TEST(Convergence, PixelsOfMaterialsAreThoseOfTheirObjects) {
  const std::vector<BrdfPtr> materials = {coated()};
  const Scene scene = sphere_of(materials[0]);
  const std::vector<bool> pixels = pixels_of(scene, materials);
  EXPECT_TRUE(pixels[6 * 12 + 6]) << "the middle";
  EXPECT_FALSE(pixels[0]) << "a corner";
  const auto none = pixels_of(scene, std::vector<BrdfPtr>{coated()});
  EXPECT_EQ(std::count(none.begin(), none.end(), true), 0) << "another object of the same parameters";
  ReferencePair reference{.first = Image(12, 12), .second = Image(12, 12), .of_materials = pixels};
  const Image part = around_materials(reference.first, reference);
  EXPECT_EQ(part.width, part.height);
  EXPECT_GE(part.width, 9);
  EXPECT_LE(part.width, 11);
}

TEST(Convergence, EqualTimeIsReadBetweenRows) {
  const std::vector<ConvergenceRow> rows = {{"a", 1, 1.0, {0.4, 1, 1}},
                                            {"a", 16, 16.0, {0.1, 1, 1}},
                                            {"b", 1, 2.0, {0.8, 1, 1}},
                                            {"b", 16, 8.0, {0.4, 1, 1}}};
  EXPECT_DOUBLE_EQ(common_seconds(rows), 8.0);
  EXPECT_DOUBLE_EQ(error_at(rows, "a", &PictureErrors::rms, 4.0), 0.2);
  EXPECT_DOUBLE_EQ(error_at(rows, "b", &PictureErrors::rms, 8.0), 0.4);
  EXPECT_TRUE(std::isnan(error_at(rows, "b", &PictureErrors::rms, 1.0)));
  EXPECT_EQ(convergence_csv({rows.data(), 1}),
            "sampler,samples,seconds,rms,relative,of_materials\na,1,1,0.40000000000000002,1,1\n");
}

}  // namespace
}  // namespace sklar::brdf
