#pragma once
/// What a picture shows: camera, objects, lights. World space is right-handed, y up, lengths in any one unit.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "brdf/render/environment_map.hpp"
#include "brdf/render/mesh.hpp"

namespace sklar::brdf {

/// A pinhole camera.
struct Camera {
  Vec3 position{0, 0, 5};
  Vec3 target{0, 0, 0};
  Vec3 up{0, 1, 0};
  double field_of_view = 40;  ///< degrees, from the lower to the upper edge of the picture
};

/// A shape of its own, not of triangles.
struct Sphere {
  Vec3 centre = Vec3::Zero();
  double radius = 1;
};

/// A surface reflects and emits on its front alone; seen from behind it is black. The x axis of a material lies in the
/// horizontal plane, on a sphere along the circles of latitude.
struct Object {
  std::string name;  ///< for errors
  std::variant<Sphere, MeshPtr> shape;
  BrdfPtr material{};          ///< none = reflects nothing
  Rgb emission = Rgb::Zero();  ///< radiance, the same in all directions
};

/// A distant light without extent.
struct DirectionalLight {
  Vec3 direction{0, 1, 0};       ///< toward the light, any length
  Rgb irradiance = Rgb::Ones();  ///< on a plane that faces the light
};

struct Scene {
  Camera camera;
  std::vector<Object> objects;
  std::vector<DirectionalLight> lights;
  EnvironmentPtr environment;     ///< none = black
  std::optional<Rgb> background;  ///< what the camera sees beyond the objects; none = the environment
  int width = 256;                ///< pixels
  int height = 256;
  int depth = 8;        ///< reflections of a path, at most
  double exposure = 1;  ///< factor of a picture to look at (PNG); not of EXR
};

/// @throws std::invalid_argument naming the object and the value: a camera without a view, a size below 1 or of more
/// than 2^26 pixels, a depth below 0, an exposure or radius that is not positive, coordinates beyond 1e15, a mesh that
/// require_mesh refuses, a light that is negative or not finite, no light at all.
void require_scene(const Scene& scene);

}  // namespace sklar::brdf
