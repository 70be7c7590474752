#pragma once
/// All lights of a scene as one that can be drawn from.

#include <limits>
#include <span>

#include "brdf/render/ray_scene.hpp"
#include "brdf/render/scene.hpp"

namespace sklar::brdf {

/// A direction toward a light, drawn from a point.
struct LightDraw {
  Vec3 direction = Vec3::Zero();                              ///< unit, toward the light
  double distance = std::numeric_limits<double>::infinity();  ///< infinite for distant light
  Rgb radiance = Rgb::Zero();                                 ///< of a light of no extent its irradiance
  double pdf = 0;          ///< per solid angle; of a light of no extent its probability. 0 = nothing drawn
  bool has_extent = true;  ///< whether a direction drawn by a surface can meet it
};

/// One light is chosen, half in proportion to power, half uniformly, for what is near shines more than its power says;
/// then a point by area on meshes, a direction in the cone of a sphere, by luminance in the environment (Shirley, Wang
/// and Zimmerman 1996, "Monte Carlo Techniques for Direct Lighting Calculations"). Immutable and thread-safe.
class Lights {
 public:
  /// @param scene as require_scene accepts it; outlives this. @param radius of a sphere around all objects.
  Lights(const Scene& scene, double radius);

  /// Light at a point from three uniforms in (0,1).
  [[nodiscard]] LightDraw draw(const Vec3& from, double choice, const Vec2& uniforms) const;

  /// Density per solid angle at `from` with which draw gives the front of this object there. @param direction unit.
  [[nodiscard]] double pdf(const Vec3& from, const Vec3& direction, const Hit& hit) const;

  /// The same of the environment.
  [[nodiscard]] double environment_pdf(const Vec3& direction) const;

 private:
  enum class Kind { object, directional, environment };
  struct Light {
    Kind kind;
    std::size_t index;            ///< of the object or the directional light
    double power = 0;             ///< of the luminance sent to the scene
    double share = 0;             ///< probability of the choice
    double area = 0;              ///< of a mesh
    std::vector<double> areas{};  ///< running sum over its triangles
  };
  [[nodiscard]] Light object_light(std::size_t index) const;
  void add(Light light);
  [[nodiscard]] LightDraw draw_mesh(const Light& light, const Vec3& from, Vec2 uniforms) const;
  [[nodiscard]] LightDraw draw_sphere(const Light& light, const Vec3& from, const Vec2& uniforms) const;

  const Scene& scene_;
  std::vector<Light> lights_;
  std::vector<double> running_;       ///< sum of shares
  std::vector<int> light_of_object_;  ///< -1 = none
  double environment_share_ = 0;
};

}  // namespace sklar::brdf
