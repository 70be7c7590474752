#include "brdf/render/scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "copula/error.hpp"

namespace sklar::brdf {
namespace {

constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;

/// Where single precision, in which rays are traced, and squares of lengths in it are still finite.
constexpr double kFarthest = 1e15;

void require_near(const Vec3& point, const std::string& what) {
  if (point.cwiseAbs().maxCoeff() <= kFarthest) return;
  throw std::invalid_argument(what + " must be finite, with coordinates of at most 1e15");
}

void require_colour(const Rgb& rgb, const std::string& what) {
  if (rgb.allFinite() && rgb.minCoeff() >= 0) return;
  throw std::invalid_argument(what + " must be finite and not negative, got " + to_text(rgb[0]) + ", " +
                              to_text(rgb[1]) + ", " + to_text(rgb[2]));
}

void require_camera(const Camera& camera) {
  require_near(camera.position, "camera: position");
  require_near(camera.target, "camera: target");
  require_near(camera.up, "camera: up");
  const Vec3 view = camera.target - camera.position;
  if (!(view.cross(camera.up).norm() > 1e-9 * view.norm() * camera.up.norm())) {
    throw std::invalid_argument("camera: target must differ from position, and up from the direction of view");
  }
  if (!(camera.field_of_view > 0) || !(camera.field_of_view < 180)) {
    throw std::invalid_argument("camera: field_of_view must be in (0,180) degrees, got " +
                                to_text(camera.field_of_view));
  }
}

void require_shape(const Object& object) {
  if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
    require_near(sphere->centre, "centre");
    if (!(sphere->radius > 0) || !(sphere->radius <= kFarthest)) {
      throw std::invalid_argument("radius must be positive and at most 1e15, got " + to_text(sphere->radius));
    }
    return;
  }
  const MeshPtr& mesh = std::get<MeshPtr>(object.shape);
  if (!mesh) throw std::invalid_argument("the mesh is missing");
  require_mesh(*mesh);
  for (std::size_t i = 0; i < mesh->vertices.size(); ++i) {
    require_near(mesh->vertices[i], "vertex " + std::to_string(i + 1));
  }
}

void require_object(const Object& object, std::size_t index) {
  try {
    require_shape(object);
    require_colour(object.emission, "emission");
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("object " + std::to_string(index + 1) +
                                (object.name.empty() ? "" : " (" + object.name + ")") + ": " + error.what());
  }
}

bool has_light(const Scene& scene) {
  return (scene.environment && scene.environment->power() > 0) ||
         std::any_of(scene.objects.begin(), scene.objects.end(),
                     [](const Object& object) { return object.emission.maxCoeff() > 0; }) ||
         std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const DirectionalLight& light) { return light.irradiance.maxCoeff() > 0; });
}

}  // namespace

void require_scene(const Scene& scene) {
  if (scene.width < 1 || scene.height < 1) {
    throw std::invalid_argument("size must be at least 1 x 1 pixels, got " + std::to_string(scene.width) + " x " +
                                std::to_string(scene.height));
  }
  if (static_cast<std::int64_t>(scene.width) * scene.height > kMostPixels) {
    throw std::invalid_argument("size must be at most 2^26 pixels, got " + std::to_string(scene.width) + " x " +
                                std::to_string(scene.height));
  }
  if (scene.depth < 0) throw std::invalid_argument("depth must not be negative, got " + std::to_string(scene.depth));
  if (!(scene.exposure > 0) || !std::isfinite(scene.exposure)) {
    throw std::invalid_argument("exposure must be positive and finite, got " + to_text(scene.exposure));
  }
  require_camera(scene.camera);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) require_object(scene.objects[i], i);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const std::string name = "light " + std::to_string(i + 1);
    require_colour(scene.lights[i].irradiance, name + ": irradiance");
    if (!scene.lights[i].direction.allFinite() || !(scene.lights[i].direction.norm() > 0)) {
      throw std::invalid_argument(name + ": direction must be finite and not 0");
    }
  }
  if (scene.background) require_colour(*scene.background, "background");
  if (!has_light(scene)) {
    throw std::invalid_argument("the scene has no light: it needs an environment, a light, or an object with emission");
  }
}

}  // namespace sklar::brdf
