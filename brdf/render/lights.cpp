#include "brdf/render/lights.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/geometry/frame.hpp"
#include "brdf/luminance.hpp"

namespace sklar::brdf {
namespace {
using std::numbers::pi;

/// 1 - cos of the half angle of the cone in which a sphere is seen, 0 from inside.
double cone_height(const Sphere& sphere, const Vec3& from) {
  const double sine_squared = sphere.radius * sphere.radius / (sphere.centre - from).squaredNorm();
  return sine_squared < 1 ? sine_squared / (1 + std::sqrt(1 - sine_squared)) : 0;
}

double cone_pdf(double height) {
  return height > 0 ? 1 / (2 * pi * height) : 0;
}

std::size_t choose(std::span<const double> running, double target) {
  return static_cast<std::size_t>(std::upper_bound(running.begin(), running.end() - 1, target) - running.begin());
}

}  // namespace

Lights::Lights(const Scene& scene, double radius) : scene_(scene), light_of_object_(scene.objects.size(), -1) {
  const double disc = pi * std::max(radius * radius, std::numeric_limits<double>::min());
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (!(luminance(scene.objects[i].emission) > 0)) continue;
    light_of_object_[i] = static_cast<int>(lights_.size());
    add(object_light(i));
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    add({.kind = Kind::directional, .index = i, .power = disc * luminance(scene.lights[i].irradiance)});
  }
  if (scene.environment) add({.kind = Kind::environment, .index = 0, .power = disc * scene.environment->power()});
  double power = 0;
  for (const Light& light : lights_) power += light.power;
  for (Light& light : lights_) {
    light.share = 0.5 * (light.power / power + 1.0 / static_cast<double>(lights_.size()));
    running_.push_back((running_.empty() ? 0.0 : running_.back()) + light.share);
    if (light.kind == Kind::environment) environment_share_ = light.share;
  }
}

void Lights::add(Light light) {
  if (light.power > 0) lights_.push_back(std::move(light));
}

Lights::Light Lights::object_light(std::size_t index) const {
  const Object& object = scene_.objects[index];
  Light light{.kind = Kind::object, .index = index};
  if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
    light.area = 4 * pi * sphere->radius * sphere->radius;
  } else {
    const TriangleMesh& mesh = *std::get<MeshPtr>(object.shape);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      light.areas.push_back(light.area += 0.5 * area_vector(mesh, i).norm());
    }
  }
  light.power = pi * light.area * luminance(object.emission);
  return light;
}

LightDraw Lights::draw(const Vec3& from, double choice, const Vec2& uniforms) const {
  const Light& light = lights_[choose(running_, choice * running_.back())];
  if (light.kind == Kind::directional) {
    const DirectionalLight& distant = scene_.lights[light.index];
    return {.direction = distant.direction.normalized(),
            .radiance = distant.irradiance,
            .pdf = light.share,
            .has_extent = false};
  }
  if (light.kind == Kind::environment) {
    const EnvironmentMap::Draw drawn = scene_.environment->draw(uniforms);
    return {.direction = drawn.direction, .radiance = drawn.radiance, .pdf = light.share * drawn.pdf};
  }
  const bool is_mesh = !light.areas.empty();
  return is_mesh ? draw_mesh(light, from, uniforms) : draw_sphere(light, from, uniforms);
}

LightDraw Lights::draw_mesh(const Light& light, const Vec3& from, Vec2 uniforms) const {
  const Object& object = scene_.objects[light.index];
  const TriangleMesh& mesh = *std::get<MeshPtr>(object.shape);
  const double target = uniforms.x() * light.area;
  const std::size_t chosen = choose(light.areas, target);
  const double before = chosen > 0 ? light.areas[chosen - 1] : 0;
  uniforms.x() = (target - before) / (light.areas[chosen] - before);
  const double root = std::sqrt(uniforms.x());
  const auto& corners = mesh.triangles[chosen];
  const auto corner = [&](std::size_t k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(corners[k])]; };
  const Vec3 point = (1 - root) * corner(0) + root * (1 - uniforms.y()) * corner(1) + root * uniforms.y() * corner(2);
  const Vec3 way = point - from;
  const double distance = way.norm();
  if (!(distance > 0)) return {};
  const Vec3 direction = way / distance;
  const double cosine = -direction.dot(area_vector(mesh, chosen).normalized());
  if (!(cosine > 0)) return {};
  return {.direction = direction,
          .distance = distance,
          .radiance = object.emission,
          .pdf = light.share * distance * distance / (cosine * light.area)};
}

LightDraw Lights::draw_sphere(const Light& light, const Vec3& from, const Vec2& uniforms) const {
  const Object& object = scene_.objects[light.index];
  const Sphere& sphere = std::get<Sphere>(object.shape);
  const double height = cone_height(sphere, from);
  if (!(height > 0)) return {};
  const double fall = uniforms.x() * height;
  const double sine = std::sqrt(fall * (2 - fall));
  const double phi = 2 * pi * uniforms.y();
  const Vec3 way = sphere.centre - from;
  const double distance = way.norm();
  const Vec3 direction =
      Frame(way / distance).to_world({sine * std::cos(phi), sine * std::sin(phi), 1 - fall}).normalized();
  const double half_chord = std::sqrt(std::max(0.0, sphere.radius * sphere.radius - distance * distance * sine * sine));
  return {.direction = direction,
          .distance = distance * (1 - fall) - half_chord,
          .radiance = object.emission,
          .pdf = light.share * cone_pdf(height)};
}

double Lights::pdf(const Vec3& from, const Vec3& direction, const Hit& hit) const {
  const int index = light_of_object_[hit.object];
  const double cosine = -direction.dot(hit.face_normal);
  if (index < 0 || !(cosine > 0)) return 0;
  const Light& light = lights_[static_cast<std::size_t>(index)];
  if (const auto* sphere = std::get_if<Sphere>(&scene_.objects[hit.object].shape)) {
    return light.share * cone_pdf(cone_height(*sphere, from));
  }
  return light.share * (hit.point - from).squaredNorm() / (cosine * light.area);
}

double Lights::environment_pdf(const Vec3& direction) const {
  return environment_share_ > 0 ? environment_share_ * scene_.environment->pdf(direction) : 0;
}

}  // namespace sklar::brdf
