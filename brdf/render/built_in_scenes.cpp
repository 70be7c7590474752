#include "brdf/render/built_in_scenes.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "brdf/analytic/ggx.hpp"
#include "brdf/analytic/lambert.hpp"
#include "brdf/analytic/sum.hpp"
#include "brdf/render/sphere.hpp"

namespace sklar::brdf {
namespace {

void require_materials(const char* function, std::span<const BrdfPtr> materials) {
  if (materials.empty()) throw std::invalid_argument(std::string(function) + ": needs at least one material");
}

MeshPtr share(TriangleMesh mesh) {
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

BrdfPtr matt(const Rgb& albedo) {
  return std::make_shared<const Lambert>(albedo);
}

BrdfPtr metal(const Rgb& f0, double alpha) {
  return std::make_shared<const Ggx>(f0, alpha);
}

/// A diffuse surface below a clear coat.
BrdfPtr coated(const Rgb& albedo, double alpha) {
  const Rgb f0 = Rgb::Constant(0.04);
  return with_diffuse(albedo, std::make_shared<const Ggx>(f0, alpha), f0);
}

/// Every other tile of a floor of square tiles around the origin.
TriangleMesh tiles(int across, int deep, double side, int parity) {
  TriangleMesh mesh;
  for (int i = 0; i < across; ++i) {
    for (int j = 0; j < deep; ++j) {
      if ((i + j) % 2 != parity) continue;
      const Vec3 corner((i - 0.5 * across) * side, 0, (j - 0.5 * deep) * side);
      const int first = static_cast<int>(mesh.vertices.size());
      const TriangleMesh tile = rectangle(corner, {0, 0, side}, {side, 0, 0});
      mesh.vertices.insert(mesh.vertices.end(), tile.vertices.begin(), tile.vertices.end());
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
  return mesh;
}

constexpr double kHalfWidth = 1.85;  ///< of the room: x
constexpr double kBack = -1.8;       ///< z of the back wall
constexpr double kFront = 6;         ///< z of the wall behind the camera
constexpr double kHeight = 2.8;

void add_walls(Scene& scene) {
  const double width = 2 * kHalfWidth, length = kFront - kBack;
  const Vec3 up(0, kHeight, 0), right(width, 0, 0), toward(0, 0, length);
  const Vec3 corner(-kHalfWidth, 0, kBack);
  constexpr int kAcross = 12, kDeep = 24;
  const double side = width / kAcross;
  const Placement floor{.at = {0, 0, kBack + 0.5 * kDeep * side}};
  scene.objects.push_back(
      {"floor, light tiles", share(placed(tiles(kAcross, kDeep, side, 0), floor)), coated({0.55, 0.52, 0.47}, 0.2)});
  scene.objects.push_back(
      {"floor, dark tiles", share(placed(tiles(kAcross, kDeep, side, 1), floor)), coated({0.10, 0.085, 0.075}, 0.2)});
  scene.objects.push_back({"ceiling", share(rectangle(corner + up, right, toward)), matt({0.78, 0.77, 0.75})});
  scene.objects.push_back({"back wall", share(rectangle(corner, right, up)), matt({0.70, 0.67, 0.61})});
  scene.objects.push_back({"left wall", share(rectangle(corner, up, toward)), matt({0.60, 0.24, 0.15})});
  scene.objects.push_back({"right wall", share(rectangle(corner + right, toward, up)), matt({0.17, 0.33, 0.38})});
  scene.objects.push_back({"front wall", share(rectangle(corner + toward, up, right)), matt({0.70, 0.67, 0.61})});
}

void add_lights(Scene& scene) {
  scene.objects.push_back({.name = "ceiling light",
                           .shape = share(rectangle({-0.8, kHeight - 0.01, -0.5}, {1.6, 0, 0}, {0, 0, 1.2})),
                           .emission = {11, 9.9, 8.2}});
  scene.objects.push_back({.name = "window",
                           .shape = share(rectangle({-kHalfWidth + 0.01, 0.8, 1.7}, {0, 1.5, 0}, {0, 0, 1.8})),
                           .emission = {2.8, 3.5, 4.4}});
}

/// The objects that show a material.
void add_main_objects(Scene& scene, std::span<const BrdfPtr> materials) {
  const std::array<Vec2, 9> vase{Vec2(0, 0),       Vec2(0.17, 0.0),  Vec2(0.21, 0.06),
                                 Vec2(0.32, 0.34), Vec2(0.27, 0.60), Vec2(0.13, 0.78),
                                 Vec2(0.11, 0.88), Vec2(0.17, 0.97), Vec2(0.19, 0.985)};
  const auto material = [&](std::size_t k) { return materials[k % materials.size()]; };
  scene.objects.push_back({"sphere", Sphere{{0.68, 0.55, 0.2}, 0.55}, material(0)});
  scene.objects.push_back({"vase", share(placed(revolution(vase), {.at = {-0.78, 0.72, -0.55}})), material(1)});
  scene.objects.push_back({"torus", share(placed(torus(0.36, 0.13), {.at = {-0.48, 0.13, 0.95}})), material(2)});
}

void add_other_objects(Scene& scene) {
  scene.objects.push_back({"pedestal", share(placed(box({0.8, 0.72, 0.8}), {.turn = 0.4, .at = {-0.78, 0.36, -0.55}})),
                           coated({0.62, 0.60, 0.56}, 0.3)});
  scene.objects.push_back({"gold", Sphere{{-0.48, 0.16, 0.95}, 0.16}, metal({1.0, 0.77, 0.34}, 0.2)});
  scene.objects.push_back({"copper", Sphere{{1.22, 0.25, 1.05}, 0.25}, metal({0.95, 0.64, 0.54}, 0.25)});
  scene.objects.push_back({"lacquer", Sphere{{0.27, 0.16, 1.35}, 0.16}, coated({0.55, 0.03, 0.03}, 0.12)});
}

}  // namespace

Scene spheres_scene(std::span<const BrdfPtr> materials) {
  require_materials("spheres_scene", materials);
  constexpr double kStep = 2.2;
  constexpr double kDistance = 100;
  const SphereOptions alone;
  const auto count = static_cast<int>(materials.size());
  Scene scene;
  scene.width = 256 * count;
  scene.camera = {.position = {0, 0, kDistance},
                  .field_of_view = 2 * std::atan(0.5 * kStep / kDistance) * 180 / std::numbers::pi};
  for (int k = 0; k < count; ++k) {
    scene.objects.push_back({"sphere " + std::to_string(k + 1), Sphere{{(k - 0.5 * (count - 1)) * kStep, 0, 0}, 1},
                             materials[static_cast<std::size_t>(k)]});
  }
  scene.lights.push_back({alone.light_direction, alone.light_irradiance});
  scene.environment = std::make_shared<const EnvironmentMap>(EnvironmentMap::tabulated(alone.environment));
  scene.background = alone.background;
  return scene;
}

Scene room_scene(std::span<const BrdfPtr> materials) {
  require_materials("room_scene", materials);
  Scene scene;
  scene.width = 340;
  scene.camera = {.position = {0.3, 1.5, 5.2}, .target = {0.06, 0.82, 0}, .field_of_view = 33};
  add_walls(scene);
  add_lights(scene);
  add_main_objects(scene, materials);
  add_other_objects(scene);
  return scene;
}

}  // namespace sklar::brdf
