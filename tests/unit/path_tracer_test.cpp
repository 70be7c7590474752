#include "brdf/render/path_tracer.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/synthetic.hpp"
#include "brdf/render/built_in_scenes.hpp"
#include "brdf/render/hemisphere.hpp"
#include "brdf/render/sample_points.hpp"
#include "brdf/render/swapped.hpp"
#include "brdf/render/turned_sphere.hpp"
#include "tests/support/function_brdf.hpp"
#include "tests/support/message.hpp"

namespace sklar::brdf {
namespace {
using std::numbers::pi;

constexpr double kSigmas = 4;
constexpr double kSingle = 1e-6;  ///< relative, of a pixel

BrdfPtr lambert(double albedo) {
  return std::make_shared<const Lambert>(Rgb::Constant(albedo));
}

MeshPtr share(TriangleMesh mesh) {
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

EnvironmentPtr grey(double radiance) {
  return std::make_shared<const EnvironmentMap>(EnvironmentMap::constant(Rgb::Constant(radiance)));
}

/// A spot at the origin on a large horizontal plane, seen at an angle from the vertical. Every pixel has one
/// expectation.
Scene spot(BrdfPtr material, double view_angle, int size = 12) {
  Scene scene;
  scene.objects.push_back({"plane", share(rectangle({-50, 0, -50}, {0, 0, 100}, {100, 0, 0})), std::move(material)});
  scene.camera = {.position = {0, 3 * std::cos(view_angle), 3 * std::sin(view_angle)},
                  .target = {0, 0, 0},
                  .up = {0, std::sin(view_angle), -std::cos(view_angle)},
                  .field_of_view = 0.01};
  scene.width = scene.height = size;
  return scene;
}

struct Estimate {
  double mean;
  double sigma;  ///< of the mean, from the scatter of the pixels
};

/// Of one channel of a picture whose pixels are independent and have one expectation.
Estimate estimate(const Image& image, int channel = 1) {
  const int count = image.width * image.height;
  Eigen::ArrayXd values(count);
  for (int i = 0; i < count; ++i) values(i) = image.at(i / image.width, i % image.width, channel);
  const double variance = (values - values.mean()).square().sum() / (count - 1);
  return {values.mean(), std::sqrt(variance / count)};
}

/// The estimate must be right and precise enough that a wrong one would be seen.
void expect_near(const Estimate& found, double expected, double precision) {
  EXPECT_LE(found.sigma, precision * expected);
  EXPECT_NEAR(found.mean, expected, kSigmas * found.sigma + kSingle * expected);
}

double albedo(const Brdf& brdf, double theta_o) {
  const HemisphereNodes nodes = hemisphere_nodes(theta_o, {.polar = 64, .azimuth = 128});
  Directions wo(nodes.wi.rows(), 3);
  wo.rowwise() = Eigen::RowVector3d(std::sin(theta_o), 0, std::cos(theta_o)).array();
  return (brdf.eval(wo, nodes.wi).col(1) * nodes.weight).sum();
}

TEST(PathTracer, WhiteFurnaceShowsTheAlbedo) {
  constexpr double kPrecision = 0.005;
  for (const double theta_o : {0.0, 1.1}) {
    for (const BrdfPtr& material : {lambert(1), BrdfPtr(std::make_shared<const Ggx>(Rgb(0.2, 0.5, 1), 0.3)),
                                    BrdfPtr(std::make_shared<const Ggx>(Rgb(0.2, 0.5, 1), 0.05))}) {
      Scene scene = spot(material, theta_o);
      scene.environment = grey(1);
      expect_near(estimate(render_paths(scene, {.samples = 32})), albedo(*material, theta_o), kPrecision);
    }
  }
  Scene scene = spot(lambert(1), 0.5);
  scene.environment = grey(1);
  const Image image = render_paths(scene, {.samples = 1, .draw_lights = false});
  for (const float value : image.rgb) EXPECT_NEAR(value, 1, kSingle) << "cosine draws have no variance";
}

// Every wall of a closed box emits 1/2 and reflects 1/2: the radiance is 1 wherever one looks.
TEST(PathTracer, ClosedFurnaceIsUniform) {
  TriangleMesh inside = box({2, 3, 4});
  for (auto& triangle : inside.triangles) std::swap(triangle[1], triangle[2]);
  Scene scene;
  scene.objects.push_back({"walls", share(inside), lambert(0.5), Rgb::Constant(0.5)});
  scene.camera = {.position = {0.3, 0.2, 0.1}, .target = {1, 0.4, -1}, .field_of_view = 70};
  scene.width = scene.height = 12;
  scene.depth = 64;
  for (const bool draw_lights : {true, false}) {
    expect_near(estimate(render_paths(scene, {.samples = 16, .draw_lights = draw_lights})), 1, 0.02);
  }
  scene.depth = 0;
  EXPECT_EQ(estimate(render_paths(scene, {.samples = 1})).mean, 0.5) << "no reflection, no reflected light";
}

// The form factor of a rectangle above its corner: Howell, "A Catalog of Radiation Heat Transfer Configuration
// Factors", B-3.
TEST(PathTracer, RectangleLightsAPlane) {
  constexpr double kWidth = 1.5, kLength = 0.8, kHeight = 1.2;
  const double a = kWidth / kHeight, b = kLength / kHeight, p = std::hypot(1, a), q = std::hypot(1, b);
  const double factor = (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2 * pi);
  Scene scene = spot(lambert(0.7), 1.4);
  scene.objects.push_back({.name = "light",
                           .shape = share(rectangle({0, kHeight, 0}, {kWidth, 0, 0}, {0, 0, kLength})),
                           .emission = Rgb::Constant(3)});
  expect_near(estimate(render_paths(scene, {.samples = 16})), 0.7 * 3 * factor, 0.005);
  expect_near(estimate(render_paths(scene, {.samples = 64, .draw_lights = false})), 0.7 * 3 * factor, 0.02);
  scene.objects.push_back({"screen", share(rectangle({-1, 0.6, -1}, {3, 0, 0}, {0, 0, 3})), {}});
  EXPECT_EQ(estimate(render_paths(scene, {.samples = 4})).mean, 0) << "in the shadow, and seen under the screen";
  scene.objects.pop_back();
  scene.objects.back().shape = share(rectangle({0, kHeight, 0}, {0, 0, kLength}, {kWidth, 0, 0}));
  EXPECT_EQ(estimate(render_paths(scene, {.samples = 4})).mean, 0) << "the back of a light is black";
}

TEST(PathTracer, SphereLightsAPlane) {
  Scene scene = spot(lambert(0.7), 0.3);
  const Vec3 centre(1, 1.5, -0.5);
  scene.objects.push_back({.name = "lamp", .shape = Sphere{centre, 0.4}, .emission = Rgb::Constant(3)});
  const double expected = 0.7 * 3 * 0.16 / centre.squaredNorm() * centre.normalized().y();
  expect_near(estimate(render_paths(scene, {.samples = 16})), expected, 0.005);
  expect_near(estimate(render_paths(scene, {.samples = 64, .draw_lights = false})), expected, 0.03);
}

TEST(PathTracer, DirectionalLightFollowsTheCosine) {
  Scene scene = spot(lambert(0.7), 0.3, 2);
  scene.lights.push_back({{1, 2, -2}, Rgb(1, 3, 5)});
  const Image image = render_paths(scene, {.samples = 4});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(1, 0, c), 0.7 / pi * (1 + 2 * c) * 2 / 3, kSingle);
  scene.objects.push_back({"ball", Sphere{{1, 2, -2}, 0.1}, {}});
  EXPECT_EQ(render_paths(scene, {.samples = 4}).at(1, 0, 1), 0) << "in the shadow";
  scene.lights[0].direction = Vec3(0, -1, 0);
  EXPECT_EQ(render_paths(scene, {.samples = 4}).at(1, 0, 1), 0) << "from below";
}

// A glossy plane that mirrors an area light, beside a spherical one and under a constant sky.
TEST(PathTracer, AllStrategiesAgree) {
  const auto glossy = std::make_shared<const Ggx>(Rgb::Constant(0.6), 0.25);
  const auto by_cosine = std::make_shared<const test::FunctionBrdf>(
      [glossy](const Vec3& wo, const Vec3& wi) -> Rgb { return glossy->eval(wo, wi); });
  const auto lit = [](const BrdfPtr& material) {
    Scene scene = spot(material, 0.8, 16);
    scene.objects.push_back({.name = "light",
                             .shape = share(rectangle({-1, 1, -2}, {1.4, 0, 0}, {0, 1, 0})),
                             .emission = Rgb::Constant(4)});
    scene.objects.push_back({.name = "lamp", .shape = Sphere{{0.8, 0.6, 0.2}, 0.3}, .emission = Rgb::Constant(2)});
    scene.environment = grey(0.3);
    return scene;
  };
  const Estimate joined = estimate(render_paths(lit(glossy), {.samples = 64}));
  for (const auto& [material, draw_lights] :
       {std::pair<BrdfPtr, bool>(glossy, false), {by_cosine, true}, {by_cosine, false}}) {
    const Estimate other = estimate(render_paths(lit(material), {.samples = 64, .draw_lights = draw_lights}));
    EXPECT_LT(other.sigma, 0.03 * other.mean);
    EXPECT_LT(joined.sigma, other.sigma);
    EXPECT_NEAR(joined.mean, other.mean, kSigmas * std::hypot(joined.sigma, other.sigma));
  }
}

/// Largest difference of two pictures of spheres after averaging over blocks, over the mean; the outer tenth of the
/// sphere, where perspective moves the outline, left out.
double block_difference(const Image& a, const Image& b, int block) {
  double worst = 0, mean = 0;
  const int blocks = a.width / block;
  for (int cell = 0; cell < blocks * blocks; ++cell) {
    const int top = cell / blocks * block, left = cell % blocks * block;
    const double x = (left + 0.5 * block) / a.width * 2 - 1, y = (top + 0.5 * block) / a.width * 2 - 1;
    if (std::hypot(x, y) > 0.7) continue;
    double difference = 0, sum = 0;
    for (int i = 0; i < block * block; ++i) {
      difference += a.at(top + i / block, left + i % block, 0) - b.at(top + i / block, left + i % block, 0);
      sum += b.at(top + i / block, left + i % block, 0);
    }
    worst = std::max(worst, std::abs(difference) / (block * block));
    mean = std::max(mean, sum / (block * block));
  }
  return worst / mean;
}

TEST(PathTracer, SphereIsTheOneByQuadrature) {
  constexpr double kNoiseAndPerspective = 0.03;
  for (const BrdfPtr& material : {BrdfPtr(std::make_shared<const Ggx>(Rgb(0.9, 0.5, 0.2), 0.3)), brushed_metal()}) {
    Scene scene = spheres_scene(std::array{material});
    scene.width = scene.height = 40;
    SphereOptions options;
    options.size = 40;
    options.radius = 1 / 1.1;
    const Image expected =
        material->traits().isotropic ? render_sphere(*material, options) : render_turned_sphere(*material, options);
    EXPECT_LT(block_difference(render_paths(scene, {.samples = 64}), expected, 8), kNoiseAndPerspective);
  }
}

TEST(PathTracer, SmoothMeshesLookLikeWhatTheyStandFor) {
  std::vector<Vec2> half_circle;
  for (int k = 0; k <= 16; ++k) half_circle.emplace_back(std::sin(pi * k / 16), -std::cos(pi * k / 16));
  half_circle.back().x() = 0;
  Scene scene = spheres_scene(std::array<BrdfPtr, 1>{std::make_shared<const Ggx>(Rgb::Constant(0.8), 0.3)});
  scene.width = scene.height = 40;
  const Image ball = render_paths(scene, {.samples = 32});
  scene.objects[0].shape = share(revolution(half_circle));
  EXPECT_LT(block_difference(render_paths(scene, {.samples = 32}), ball, 4), 0.02);
}

Scene small_room(const BrdfPtr& material) {
  Scene scene = room_scene(std::array{material});
  scene.width = 20;
  scene.height = 17;
  return scene;
}

TEST(PathTracer, BytesDoNotDependOnThreads) {
  const Scene scene = small_room(std::make_shared<const Ggx>(Rgb::Constant(0.5), 0.2));
  const Image image = render_paths(scene, {.samples = 4});
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(render_paths(scene, {.samples = 4}).rgb, image.rgb) << threads;
  }
  EXPECT_NE(render_paths(scene, {.samples = 4, .seed = 2}).rgb, image.rgb);
}

TEST(PathTracer, SwappingDirectionsShowsReciprocity) {
  const auto pictures_agree = [](const BrdfPtr& material) {
    const Scene scene = small_room(material);
    Scene swapped = scene;
    for (Object& object : swapped.objects) {
      if (object.material) object.material = std::make_shared<const Swapped>(object.material);
    }
    return render_paths(scene, {.samples = 4}).rgb == render_paths(swapped, {.samples = 4}).rgb;
  };
  EXPECT_TRUE(pictures_agree(std::make_shared<const Ggx>(Rgb::Constant(0.5), 0.2)));
  EXPECT_TRUE(pictures_agree(brushed_metal()));
  EXPECT_FALSE(pictures_agree(std::make_shared<const test::FunctionBrdf>(
      [](const Vec3& wo, const Vec3&) -> Rgb { return Rgb::Constant(0.3 * wo.z()); })));
  EXPECT_THROW(Swapped(nullptr), std::invalid_argument);
}

TEST(PathTracer, CameraSeesLightsAndBackground) {
  Scene scene;
  scene.objects.push_back({.name = "lamp", .shape = Sphere{{0, 0, 0}, 0.5}, .emission = Rgb(1, 2, 3)});
  scene.environment = grey(0.25);
  scene.width = scene.height = 9;
  Image image = render_paths(scene, {.samples = 2});
  EXPECT_EQ(image.at(4, 4, 2), 3);
  EXPECT_EQ(image.at(0, 0, 2), 0.25F);
  scene.background = Rgb(0, 0, 1);
  image = render_paths(scene, {.samples = 2});
  EXPECT_EQ(image.at(0, 8, 2), 1);
  EXPECT_EQ(image.at(4, 4, 0), 1);
  scene.objects.clear();
  EXPECT_EQ(render_paths(scene, {.samples = 1}).at(4, 4, 2), 1) << "no objects";
}

TEST(PathTracer, PictureIsNeitherTurnedNorMirrored) {
  Scene scene;
  scene.environment = grey(0.1);
  scene.objects.push_back({.name = "upper right", .shape = Sphere{{1, 1, 0}, 0.3}, .emission = Rgb(9, 0, 0)});
  scene.width = 30;
  scene.height = 20;
  const Image image = render_paths(scene, {.samples = 1});
  const double up = 1 / 5.0 / std::tan(20 * pi / 180);  // of the half height
  EXPECT_EQ(image.at(static_cast<int>(10 - 10 * up), static_cast<int>(15 + 10 * up), 0), 9);
}

TEST(PathTracer, ProgressRisesAndInterrupts) {
  const Scene scene = small_room(lambert(0.5));
  double last = 0;
  (void)render_paths(scene, {.samples = 1, .progress = [&](double share) {
                               EXPECT_GT(share, last);
                               last = share;
                             }});
  EXPECT_EQ(last, 1);
  EXPECT_THROW((void)render_paths(scene, {.samples = 1, .progress = [](double) { throw std::runtime_error("stop"); }}),
               std::runtime_error);
}

TEST(PathTracer, BadScenesAreRefused) {
  const auto refused = [](const auto& change) {
    Scene scene = small_room(lambert(0.5));
    change(scene);
    return test::message_of<std::invalid_argument>([&] { (void)render_paths(scene, {.samples = 1}); });
  };
  EXPECT_EQ(refused([](Scene& s) { s.width = 0; }), "size must be at least 1 x 1 pixels, got 0 x 17");
  EXPECT_EQ(refused([](Scene& s) { s.width = s.height = 10000; }),
            "size must be at most 2^26 pixels, got 10000 x 10000");
  EXPECT_EQ(refused([](Scene& s) { s.depth = -1; }), "depth must not be negative, got -1");
  EXPECT_EQ(refused([](Scene& s) { s.exposure = 0; }), "exposure must be positive and finite, got 0");
  EXPECT_EQ(refused([](Scene& s) { s.camera.field_of_view = 180; }),
            "camera: field_of_view must be in (0,180) degrees, got 180");
  const std::string view = "camera: target must differ from position, and up from the direction of view";
  EXPECT_EQ(refused([](Scene& s) { s.camera.target = s.camera.position; }), view);
  EXPECT_EQ(refused([](Scene& s) { s.camera.up = s.camera.target - s.camera.position; }), view);
  EXPECT_EQ(refused([](Scene& s) { s.camera.up.x() = std::nan(""); }),
            "camera: up must be finite, with coordinates of at most 1e15");
  EXPECT_EQ(refused([](Scene& s) { s.objects[0].emission[1] = -2; }),
            "object 1 (floor, light tiles): emission must be finite and not negative, got 0, -2, 0");
  EXPECT_EQ(refused([](Scene& s) {
              s.objects[1].shape = Sphere{{0, 0, 0}, -1};
            }),
            "object 2 (floor, dark tiles): radius must be positive and at most 1e15, got -1");
  EXPECT_EQ(refused([](Scene& s) {
              s.objects = {{"", share(rectangle({1e16, 0, 0}, {1e16, 0, 0}, {0, 1e16, 0}))}};
            }),
            "object 1: vertex 1 must be finite, with coordinates of at most 1e15");
  EXPECT_EQ(refused([](Scene& s) { s.objects = {{"", MeshPtr()}}; }), "object 1: the mesh is missing");
  EXPECT_EQ(refused([](Scene& s) {
              s.objects = {{"", share(rectangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0}))}};
            }),
            "object 1: triangle 1 is degenerate: it has no area");
  EXPECT_EQ(refused([](Scene& s) {
              s.lights.push_back({{0, 1, 0}, {-1, 0, 0}});
            }),
            "light 1: irradiance must be finite and not negative, got -1, 0, 0");
  EXPECT_EQ(refused([](Scene& s) {
              s.lights.push_back({{0, 0, 0}, {1, 1, 1}});
            }),
            "light 1: direction must be finite and not 0");
  EXPECT_EQ(refused([](Scene& s) {
              for (Object& object : s.objects) object.emission = Rgb::Zero();
            }),
            "the scene has no light: it needs an environment, a light, or an object with emission");
  const Scene scene = small_room(lambert(0.5));
  EXPECT_THROW((void)render_paths(scene, {.samples = 0}), std::invalid_argument);
  EXPECT_THROW((void)room_scene({}), std::invalid_argument);
  EXPECT_THROW((void)spheres_scene({}), std::invalid_argument);
}

// Every elementary box of 1/64 holds one of 64 points: a (0,6,2)-net.
TEST(PixelPoints, AreNetsInEachDimension) {
  for (std::uint32_t dimension = 0; dimension < 6; ++dimension) {
    const PixelPoints points(7, 11);
    for (int across = 1; across <= 64; across *= 2) {
      std::set<int> boxes;
      for (std::uint32_t sample = 0; sample < 64; ++sample) {
        const Vec2 point = points.at(sample, dimension);
        EXPECT_GT(point.minCoeff(), 0);
        EXPECT_LT(point.maxCoeff(), 1);
        const int down = 64 / across;
        boxes.insert(static_cast<int>(point.x() * across) * down + static_cast<int>(point.y() * down));
      }
      EXPECT_EQ(boxes.size(), 64U) << dimension << ' ' << across;
    }
  }
}

TEST(PixelPoints, DependOnEveryArgument) {
  std::set<double> values;
  for (const std::uint64_t seed : {1, 2}) {
    for (const std::uint64_t pixel : {0, 1}) {
      for (const std::uint32_t sample : {0U, 1U}) {
        for (const std::uint32_t dimension : {0U, 1U}) {
          const Vec2 point = PixelPoints(seed, pixel).at(sample, dimension);
          values.insert(point.x());
          values.insert(point.y());
        }
      }
    }
  }
  EXPECT_EQ(values.size(), 32U);
}

// Points of different dimensions are independent: the products of their coordinates have the mean 1/4.
TEST(PixelPoints, DimensionsAreIndependent) {
  constexpr int kPixels = 4096;
  for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {0, 5}}) {
    double sum = 0;
    for (int pixel = 0; pixel < kPixels; ++pixel) {
      const PixelPoints points(3, static_cast<std::uint64_t>(pixel));
      for (std::uint32_t sample = 0; sample < 4; ++sample) {
        sum += (points.at(sample, static_cast<std::uint32_t>(a)).x() - 0.5) *
               (points.at(sample, static_cast<std::uint32_t>(b)).y() - 0.5);
      }
    }
    EXPECT_LT(std::abs(sum), kSigmas * std::sqrt(4.0 * kPixels) / 12) << a << ' ' << b;
  }
}

}  // namespace
}  // namespace sklar::brdf
